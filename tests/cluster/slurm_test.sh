#!/usr/bin/env bash
# A real Slurm of a controller and two nodes on this machine runs a batch as an array; one node is
# killed in the middle, its task is requeued: slurm_test.sh SOURCE PROGRAM
source "$(dirname "$0")/common.sh"
for program in slurmctld slurmd sbatch munged; do
  command -v $program >/dev/null || [[ -x /usr/sbin/$program ]] || skip "no $program"
done
[[ $(id -u) == 0 ]] || skip "Slurm's daemons need root"
PATH=$PATH:/usr/sbin
count=24
tasks=2
host=$(hostname -s)
base=$((20000 + $$ % 10000))
export SLURM_CONF=$WORK/slurm.conf

# Ends what this test has started: daemons by their files, and what runs for its nodes.
kill_node() {  # kill_node NAME: its daemon, the steps it has started, and what these run
  local daemon task batch dead
  daemon=$(cat "$WORK/slurmd.$1.pid" 2>/dev/null) || return 0
  dead=("$daemon")
  for task in $(squeue -h -t R -w "$1" -o %K 2>/dev/null || true); do
    # The batch of a task is known by the folder of this test, which no one else has.
    for batch in $(pgrep -f -- "--out $WORK/out --resume --shard=$task/" || true); do
      # shellcheck disable=SC2207
      dead+=("$batch" $(ps -o ppid= -p "$batch" | grep -vx " *1" || true) $(pgrep -P "$batch" || true))
    done
  done
  kill -KILL "${dead[@]}" 2>/dev/null || true
  rm -f "$WORK/slurmd.$1.pid"
}
finish() {
  scancel --quiet --user=root 2>/dev/null || true
  kill_node n0
  kill_node n1
  for name in slurmctld munged; do
    [[ -s $WORK/$name.pid ]] && kill -KILL "$(cat "$WORK/$name.pid")" 2>/dev/null || true
  done
  rm -rf "$WORK"
}
trap finish EXIT

head -c 1024 /dev/urandom >"$WORK/munge.key"
chmod 600 "$WORK/munge.key"
chmod 755 "$WORK"
munged --force --num-threads=1 --socket="$WORK/munge.sock" --key-file="$WORK/munge.key" \
  --pid-file="$WORK/munged.pid" --seed-file="$WORK/munge.seed" --log-file="$WORK/munged.log"
mkdir "$WORK/state"
cat >"$SLURM_CONF" <<CONF
ClusterName=test
SlurmctldHost=$host(127.0.0.1)
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket=$WORK/munge.sock
CryptoType=crypto/munge
SlurmctldPort=$base
SlurmctldPidFile=$WORK/slurmctld.pid
SlurmctldLogFile=$WORK/slurmctld.log
SlurmdLogFile=$WORK/slurmd.%n.log
SlurmdPidFile=$WORK/slurmd.%n.pid
SlurmdSpoolDir=$WORK/spool.%n
StateSaveLocation=$WORK/state
ProctrackType=proctrack/pgid
TaskPlugin=task/none
SchedulerType=sched/builtin
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
ReturnToService=2
SlurmdTimeout=5
JobRequeue=1
MpiDefault=none
NodeName=n0 NodeHostname=$host NodeAddr=127.0.0.1 Port=$((base + 1)) CPUs=1
NodeName=n1 NodeHostname=$host NodeAddr=127.0.0.1 Port=$((base + 2)) CPUs=1
PartitionName=all Nodes=n0,n1 Default=YES State=UP
CONF
slurmctld
sleep 1
slurmd -N n0
slurmd -N n1
for _ in $(seq 60); do
  [[ $(sinfo -h -t idle -o %D 2>/dev/null) == 2 ]] && break
  sleep 0.5
done
sinfo -h -t idle | grep -q . || { tail "$WORK"/slurm*.log; fail "the nodes did not come up"; }

manifest "$WORK/m.csv" $count 6
out=$WORK/out
read -r array merge < <("$SOURCE/tools/cluster/slurm.sh" "$WORK/m.csv" "$out" $tasks)

# A node dies while both work.
for _ in $(seq 600); do
  [[ $(finished "$out" | wc -l) -ge 4 ]] && break
  sleep 0.1
done
kill_node n1
finished "$out" >"$WORK/before.txt"
before=$(wc -l <"$WORK/before.txt")
((before >= 4)) || { tail "$WORK"/slurm*.log; fail "nothing was finished before the node died"; }
((before < count)) || fail "the node died too late to try anything"

# Slurm sees it, and gives its task to who is there.
for _ in $(seq 240); do
  squeue -h -j "$array,$merge" 2>/dev/null | grep -q . || break
  # A requeued task waits two minutes by itself.
  for job in $(squeue -h -t PD -j "$array" -o %A 2>/dev/null); do
    scontrol update "jobid=$job" starttime=now 2>/dev/null || true
  done
  sleep 1
done
squeue -h -j "$array,$merge" 2>/dev/null | grep . && fail "jobs are left"
expect_whole "$out" $count
comm -23 "$WORK/before.txt" <(finished "$out") | grep . && fail "pairs were run again"
requeued=$(grep -c -i 'requeue' "$WORK/slurmctld.log" || true)
((requeued > 0)) || fail "no task was requeued; the test has tried nothing"
echo "slurm: $before of $count pairs before the node died, each done once"
