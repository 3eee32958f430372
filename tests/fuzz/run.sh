#!/usr/bin/env bash
# Builds the fuzz targets with clang and runs each for some seconds (60), one after the other:
#   tests/fuzz/run.sh [SECONDS] [TARGET...]
# Findings are left in build/fuzz/findings/TARGET; new inputs in build/fuzz/corpus/TARGET.
set -euo pipefail
cd "$(dirname "$0")/../.."
seconds=${1:-60}
shift || true
targets=("$@")

if ! command -v clang++ >/dev/null; then
  echo "fuzz: install clang and libclang-rt-14-dev" >&2
  exit 1
fi
cmake --preset fuzz -G Ninja >/dev/null
cmake --build build/fuzz --target fuzz
((${#targets[@]})) || for source in tests/fuzz/*_fuzz.cc; do
  targets+=("$(basename "$source" .cc)")
done

export UBSAN_OPTIONS=print_stacktrace=1
for target in "${targets[@]}"; do
  mkdir -p "build/fuzz/corpus/$target" "build/fuzz/findings/$target"
  options=(-max_total_time="$seconds" -timeout=10 -rss_limit_mb=2048 -print_final_stats=1
           -artifact_prefix="build/fuzz/findings/$target/")
  [[ -f tests/fuzz/$target.dict ]] && options+=(-dict="tests/fuzz/$target.dict")
  echo "== $target, $seconds s"
  seeds=tests/fuzz/seeds/$target
  if [[ $target == gltf_fuzz ]]; then  # its seeds are made, not kept
    seeds=build/fuzz/seeds/$target
    mkdir -p "$seeds"
    build/fuzz/tests/fuzz/gltf_seeds "$seeds"
  fi
  "build/fuzz/tests/fuzz/$target" "${options[@]}" "build/fuzz/corpus/$target" \
    "$seeds" 2>&1 | grep -v -E '^(#[0-9]+.*(REDUCE|NEW|RELOAD|pulse)|"|######)' || exit 1
done
