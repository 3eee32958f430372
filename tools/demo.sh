#!/usr/bin/env bash
# Installs what is needed, builds, and retargets the shipped piggyback. Results and a picture: out/.
set -euo pipefail
cd "$(dirname "$0")/.."
tools/setup.sh
tools/build.sh -DRETARGET_TESTS=OFF
hold=data/holds/piggyback
build/release/retarget --clip-a $hold/a.bvh --clip-b $hold/b.bvh --template $hold/template.yaml --out out
build/release/retarget render out
echo "The report: $PWD/out/report.html. The scene: out/scene.glb (any glTF viewer); a picture: out/scene.png."
