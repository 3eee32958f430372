#!/usr/bin/env bash
# Builds and runs all benchmarks; results go to the terminal and to build/bench. Takes some minutes.
# JOBS: parallel compilations (default: all cores). BUILD: another build folder.
set -euo pipefail
cd "$(dirname "$0")/../.."
build=${BUILD:-build/bench}
hold=data/holds/bear_hug
tools/setup.sh --bench
cmake -S . -B "$build" -G Ninja -DRETARGET_BENCH=ON -DRETARGET_TESTS=OFF >/dev/null
cmake --build "$build" -j "${JOBS:-$(nproc)}"

echo "== retarget on the example played forwards and backwards"
mkdir -p "$build/clips"
for frames in 300 3000; do
  for figure in a b; do
    "$build/tools/bench/pingpong" $hold/$figure.bvh $frames "$build/clips/$figure$frames.bvh"
  done
  # A missed requirement (3) or a limit (4) is a result too.
  code=0
  "$build/retarget" --clip-a "$build/clips/a$frames.bvh" \
    --clip-b "$build/clips/b$frames.bvh" --template $hold/template.yaml \
    --out "$build/out$frames" --force >"$build/out$frames.txt" 2>&1 || code=$?
  case $code in 0 | 3 | 4) ;; *) cat "$build/out$frames.txt"; exit $code ;; esac
done
python3 tools/bench/summary.py reports "$build/out300/report.json" "$build/out3000/report.json"

echo "== kernels"
"$build/tools/bench/kernels_bench" --benchmark_out="$build/kernels.json" --benchmark_out_format=json
python3 tools/bench/summary.py kernels "$build/kernels.json"

echo "== solves"
"$build/tools/bench/solve_bench" | tee "$build/solve.txt"

echo "== posing"
"$build/tools/bench/pose_bench" | tee "$build/pose.txt"

echo "== drags in the studio, over HTTP"
"$build/tools/bench/studio_bench" | tee "$build/studio.txt"
