#!/usr/bin/env bash
# Installs what is needed, builds, and passes all tests.
set -euo pipefail
cd "$(dirname "$0")/.."
tools/setup.sh --tests
tools/build.sh -DRETARGET_TESTS=ON
# Khronos' glTF validator, for the tests of what is written.
if [[ ! -d build/node/node_modules/gltf-validator ]]; then
  mkdir -p build/node
  cp tests/tools/package.json build/node/
  (cd build/node && npm install --no-audit --no-fund --loglevel=error) ||
    echo "test: gltf-validator is not available; its tests are skipped" >&2
fi
export RETARGET_NODE_MODULES=$PWD/build/node
ctest --test-dir build/release --output-on-failure -j "$(nproc)"
