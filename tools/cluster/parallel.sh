#!/usr/bin/env bash
# A batch by GNU parallel, on this machine or on several: parallel.sh MANIFEST OUT SHARDS [option...]
# Options are those of parallel: --sshloginfile NODES, -j 2. To call it again goes on.
set -euo pipefail
if (($# < 3)) || [[ ! $3 =~ ^[1-9][0-9]*$ ]]; then
  echo "usage: parallel.sh MANIFEST OUT SHARDS [option of parallel...]" >&2
  exit 2
fi
manifest=$(realpath "$1")
mkdir -p "$2"
out=$(realpath "$2")
shards=$3
shift 3
program=${RETARGET:-$(command -v retarget)}
# A shard that ends with 3 has run all its pairs; the merge says which were not met.
seq 0 $((shards - 1)) | parallel --quote "$@" \
  "$program" batch "$manifest" --out "$out" --resume --jobs=1 --shard={}/"$shards" || true
exec "$program" batch "$manifest" --merge --out "$out"
