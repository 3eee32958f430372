#!/usr/bin/env bash
# A real GNU parallel runs a batch, is killed in the middle, and goes on:
# parallel_test.sh SOURCE PROGRAM
source "$(dirname "$0")/common.sh"
trap 'rm -rf "$WORK"' EXIT
command -v parallel >/dev/null && parallel --version 2>/dev/null | grep -q 'GNU parallel' ||
  skip "no GNU parallel"
export PARALLEL_HOME=$WORK/parallel
mkdir -p "$PARALLEL_HOME" && touch "$PARALLEL_HOME/will-cite"
count=8
manifest "$WORK/m.csv" $count 6
out=$WORK/out

setsid "$SOURCE/tools/cluster/parallel.sh" "$WORK/m.csv" "$out" 3 -j2 >"$WORK/first.txt" 2>&1 &
group=$!
for _ in $(seq 400); do
  [[ $(finished "$out" | wc -l) -ge 2 ]] && break
  sleep 0.05
done
# parallel and what it has started, which are groups of their own.
# shellcheck disable=SC2046
kill -KILL -- "-$group" $(pgrep -f -- "batch $WORK/m.csv --out $out") 2>/dev/null || true
wait "$group" 2>/dev/null || true
finished "$out" >"$WORK/before.txt"
[[ -s $WORK/before.txt ]] || fail "nothing was finished before the kill"
before=$(wc -l <"$WORK/before.txt")
((before < count)) || fail "the kill came too late to try anything"

code=0
"$SOURCE/tools/cluster/parallel.sh" "$WORK/m.csv" "$out" 3 -j2 >"$WORK/second.txt" 2>&1 || code=$?
((code == 0 || code == 3)) || { cat "$WORK/second.txt"; fail "ended with $code"; }
expect_whole "$out" $count
# What was finished before the kill was not run again.
comm -23 "$WORK/before.txt" <(finished "$out") | grep . && fail "pairs were run again"
echo "parallel: $before of $count pairs before the kill, each done once"
