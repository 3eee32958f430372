#!/usr/bin/env bash
# Installs what is needed, builds, and retargets the shipped bear hug. Results and a picture: out/.
set -euo pipefail
cd "$(dirname "$0")/.."
tools/setup.sh
tools/build.sh -DRETARGET_TESTS=OFF
hold=data/holds/bear_hug
build/release/retarget --clip-a $hold/a.bvh --clip-b $hold/b.bvh --template $hold/template.yaml --out out
build/release/retarget render out
echo "Open out/scene.glb in any glTF viewer, or look at out/scene.png."
