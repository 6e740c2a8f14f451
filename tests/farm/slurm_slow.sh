#!/usr/bin/env bash
# assets/farm/slurm.sh on a farm of one machine: slurmctld, two slurmd and munged are started here, with all that they write in
# the scratch folder. 16 shards, one of which is killed and queued again, one machine is drained: the same bits as one render.
# The folder and the picture have names that shells and Slurm stumble over.
. "$(dirname "$0")/../app/_common.sh"
skip() { echo "skipped: $*"; exit 77; }
[ "$(id -u)" = 0 ] || skip 'only root can start slurmd'
for program in slurmctld slurmd munged mungekey sbatch; do
  PATH=$PATH:/usr/sbin command -v $program >/dev/null || skip "$program is missing (slurm-wlm, munge)"
done
export PATH=$PATH:/usr/sbin
here=$PWD
host=$(hostname -s)
mkdir -m 755 munge state spool1 spool2 && mkdir -m 700 key
# Unix sockets have short names, and munged asks that nobody else may write to the folders above them.
sockets=$(mktemp -d /run/tyndall-farm.XXXXXX) && chmod 755 "$sockets"
started=()
stop_all() {
  for process in "${started[@]}"; do kill "$process" 2>/dev/null; done
  for process in "${started[@]}"; do wait "$process" 2>/dev/null; done
  pkill -P $$ 2>/dev/null
  rm -rf "$sockets"
}
trap stop_all EXIT
dd if=/dev/urandom of="$sockets/key" bs=128 count=1 2>probe && chmod 600 "$sockets/key"
munged --foreground --force --key-file="$sockets/key" --socket="$sockets/munge" --pid-file="$sockets/munge.pid" \
  --log-file="$sockets/munge.log" --seed-file="$sockets/seed" >munged.log 2>&1 &
started+=($!)

port=$((20000 + $$ % 10000)) # and the next two: below those that the system gives to connections
cat >slurm.conf <<MSG
ClusterName=tyndall
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=$port
AuthType=auth/munge
AuthInfo=socket=$sockets/munge
CredType=cred/munge
SlurmUser=root
StateSaveLocation=$here/state
SlurmdSpoolDir=$here/spool-%n
SlurmctldPidFile=$here/slurmctld.pid
SlurmdPidFile=$here/slurmd-%n.pid
ProctrackType=proctrack/pgid
TaskPlugin=task/none
SchedulerType=sched/builtin
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
MpiDefault=none
ReturnToService=2
KillWait=5
SchedulerParameters=requeue_setup_env_fail
MessageTimeout=60
NodeName=one NodeHostname=$host NodeAddr=127.0.0.1 Port=$((port + 1)) CPUs=2 State=UNKNOWN
NodeName=two NodeHostname=$host NodeAddr=127.0.0.1 Port=$((port + 2)) CPUs=2 State=UNKNOWN
PartitionName=render Nodes=one,two Default=YES MaxTime=INFINITE State=UP OverSubscribe=FORCE:4
MSG
export SLURM_CONF=$here/slurm.conf
slurmctld -D -c >slurmctld.log 2>&1 &
started+=($!)
for node in one two; do
  slurmd -D -N $node -f "$SLURM_CONF" >"slurmd-$node.log" 2>&1 &
  started+=($!)
done
# until SECONDS COMMAND...: waits until the command succeeds.
until_true() {
  local end=$((SECONDS + $1))
  shift
  until "$@" >probe 2>&1; do
    [ $SECONDS -lt $end ] || return 1
    sleep 0.3
  done
}
idle() { [ "$(sinfo -h -o %T -N | sort -u)" = idle ]; }
until_true 120 idle || { tail -5 slurmctld.log slurmd-*.log; fail "the farm does not start: $(cat probe)"; finish; }

scene=cornell-smoke size=64x64 samples=256 shards=16 film=$'-it\'s 100 %a "film"\n$HOME\\n.exr'
mkdir $'work %a \\ it\'s\n"$HOME"' && cd ./work* || exit 1
TYNDALL=$tyndall SHARDS=$shards SAMPLES=$samples "$source_root/assets/farm/slurm.sh" $scene "$film" --size $size --checkpoint 0.2 >jobs ||
  fail 'sbatch'
job=$(sed -n 's/^shards: job //p' jobs) merge=$(sed -n 's/^merge: job //p' jobs)
state_of() { squeue -h -r -j "$1" -o %T 2>/dev/null; }
running() { [ -n "$(squeue -h -r -j "$job" -t RUNNING -o %K)" ]; }
until_true 120 running || fail "no shard runs: $(squeue)"
# One that runs is killed without a warning and queued again, as Slurm does when its machine dies; one machine takes no more.
victim=$(squeue -h -r -j "$job" -t RUNNING -o %K | head -1)
scontrol requeue "${job}_$victim" || fail 'requeue'
scontrol update NodeName=two State=DRAIN Reason=test || fail 'drain'
restarts=$(scontrol show job "${job}_$victim" | sed -n 's/.*Restarts=\([0-9]*\).*/\1/p')
echo "killed and queued again: shard $victim; drained: two"
merged() { [ -z "$(state_of "$merge")" ]; }
until_true 900 merged || fail "the merge does not end: $(squeue) $(tail -n 2 "./$film.parts"/*.log)"
grep -q "all $samples samples" "./$film.parts"/merge.log || fail "the merge: $(cat "./$film.parts"/merge.log)"
same 'shards' $shards "$(find "./$film.parts" -name '*.exr' -printf . | wc -c)"
[ "$restarts" = 1 ] || fail "shard $victim was started again $restarts times"
same 'machine two' drained "$(sinfo -h -n two -o %T)"
"$tyndall" render $scene --size $size --samples 0:$samples --resume -q -o "./$film" --stats farm.json 2>>log
same 'hash' "$(image_hash $scene --size $size --samples 0:$samples)" "$(json farm.json image_hash)"
echo "$shards shards, $samples samples: $(json farm.json image_hash)"
finish
