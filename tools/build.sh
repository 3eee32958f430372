#!/usr/bin/env bash
# Builds to build/release. Arguments go to CMake.
set -euo pipefail
cd "$(dirname "$0")/.."
cmake --preset release -G Ninja "$@" >/dev/null
cmake --build build/release
