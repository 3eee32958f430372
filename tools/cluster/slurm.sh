#!/usr/bin/env bash
# A batch as a Slurm job array, and its index when all tasks are over:
#   slurm.sh MANIFEST OUT TASKS [option of sbatch...]
# OUT is in a file system that all nodes share. A task that is requeued, after its node failed or it
# was preempted, goes on where it was; to submit again does the same. Prints the numbers of both jobs.
set -euo pipefail
if (($# < 3)) || [[ ! $3 =~ ^[1-9][0-9]*$ ]]; then
  echo "usage: slurm.sh MANIFEST OUT TASKS [option of sbatch...]" >&2
  exit 2
fi
manifest=$(realpath "$1")
mkdir -p "$2"
out=$(realpath "$2")
tasks=$3
shift 3
program=${RETARGET:-$(command -v retarget)}
quoted() { printf '%q ' "$@"; }

# --jobs as the task has processors; the shard is the task's by default.
array=$(sbatch --parsable --job-name=retarget --array="0-$((tasks - 1))" --requeue \
  --open-mode=append --output="$out/slurm-%A_%a.log" "$@" \
  --wrap="exec $(quoted "$program" batch "$manifest" --out "$out" --resume)\
--shard=\$SLURM_ARRAY_TASK_ID/$tasks --jobs=\${SLURM_CPUS_PER_TASK:-1}")
merge=$(sbatch --parsable --job-name=retarget-merge --dependency="afterany:$array" --requeue \
  --open-mode=append --output="$out/slurm-merge.log" "$@" \
  --wrap="exec $(quoted "$program" batch "$manifest" --merge --out "$out")")
echo "$array $merge"
