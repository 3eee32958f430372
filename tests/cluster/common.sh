# What the tests of clusters share. Sourced; sets SOURCE, PROGRAM and a folder that goes away.
set -euo pipefail
SOURCE=$(realpath "$1")
PROGRAM=$(realpath "$2")
export RETARGET=$PROGRAM
skip() { echo "skipped: $*"; exit 77; }
fail() { echo "FAILED: $*" >&2; exit 1; }
WORK=$(mktemp -d)

# manifest FILE COUNT FRAMES: pairs of the shipped holds that begin at different frames.
manifest() {
  local k hold first holds=("$SOURCE"/data/holds/*/)
  echo "id,clip_a,clip_b,template,frames,template_at,no_page" >"$1"
  for ((k = 0; k < $2; ++k)); do
    hold=${holds[k % ${#holds[@]}]%/}
    first=$((3 * (k / ${#holds[@]})))
    echo "p$k,$hold/a.bvh,$hold/b.bvh,$hold/template.yaml,$first:$((first + $3)),$(awk "BEGIN {print $first / 30}"),true"
  done >>"$1"
}

# finished FOLDER: "id ended" of each pair that is finished, sorted.
finished() {
  local folder=$1
  cat "$folder"/status.*jsonl 2>/dev/null | python3 -c '
import json, os, sys
last = {}
for line in sys.stdin:
    try:
        record = json.loads(line)
    except ValueError:
        continue
    if os.path.exists(os.path.join(sys.argv[1], record["id"], "report.json")):
        last[record["id"]] = max(last.get(record["id"], ""), record["ended"])
print("\n".join(f"{i} {e}" for i, e in sorted(last.items())))' "$folder"
}

# expect_whole FOLDER COUNT: every pair once, none half written, the index of them all.
expect_whole() {
  local folder=$1 count=$2
  [[ $(wc -l <"$folder/status.jsonl") == "$count" ]] || fail "status.jsonl has not $count lines"
  [[ $(python3 -c 'import json,sys; print(len({json.loads(l)["id"] for l in open(sys.argv[1])}))' \
    "$folder/status.jsonl") == "$count" ]] || fail "an id is there twice"
  [[ $(find "$folder" -mindepth 2 -maxdepth 2 -name report.json -not -path '*/.unfinished/*' | wc -l) == "$count" ]] ||
    fail "not $count folders with a report"
  [[ -z $(find "$folder" -mindepth 1 -maxdepth 1 -type d -name 'p*' '!' -exec test -s {}/scene.glb ';' -print) ]] ||
    fail "a folder is half written"
  [[ $(wc -l <"$folder/index.csv") == $((count + 1)) ]] || fail "index.csv has not $count pairs"
  ! grep -q 'not run yet' "$folder/index.html" || fail "the index says that pairs were not run"
}
