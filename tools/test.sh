#!/usr/bin/env bash
# Installs what is needed, builds, and passes all tests; counts them, so that a test that no longer
# runs is noticed (tests/expected_counts). With --may-skip too few tests are said, but no failure:
# for machines without npm's registry or a browser.
set -euo pipefail
cd "$(dirname "$0")/.."
tools/setup.sh --tests
tools/build.sh -DRETARGET_TESTS=ON
# Khronos' glTF validator, for the tests of what is written, and playwright-core, which drives the
# browser in those of the report page.
if ! cmp -s tests/tools/package.json build/node/installed.json; then
  mkdir -p build/node
  cp tests/tools/package.json build/node/
  if (cd build/node && npm install --ignore-scripts --no-audit --no-fund --loglevel=error); then
    cp tests/tools/package.json build/node/installed.json
  else
    echo "test: gltf-validator and playwright-core are not available; their tests are skipped" >&2
  fi
fi
# Format and lint of the pages.
npm ci --prefix tests/web/style --ignore-scripts --no-audit --no-fund --loglevel=error ||
  echo "test: prettier and eslint are not available; test Web.Style is skipped" >&2
export RETARGET_NODE_MODULES=$PWD/build/node
status=0
ctest --preset release -j "$(nproc)" --output-junit "$PWD/build/release/tests.xml" || status=$?
tools/count_tests.sh build/release || { [[ ${1:-} == --may-skip ]] || status=1; }
exit $status
