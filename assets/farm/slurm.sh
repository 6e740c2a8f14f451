#!/usr/bin/env bash
# One picture on many machines by Slurm: an array of shards, then their merge. Call it, do not sbatch it:
#
#   SHARDS=16 SAMPLES=1024 ./slurm.sh SCENE OUTPUT.exr [options of "tyndall render", such as --size 3840x2160]
#
# SHARDS: number of jobs; SAMPLES: samples per pixel of all together; SBATCH_OPTIONS: added for each job, such as
# "--partition=render --time=2:00:00". Runs in the current folder, which all machines must share; the parts go into
# OUTPUT.parts. A job that is preempted, or reaches its time, gets USR1 a minute before: it writes its film, is queued again
# and goes on from there. The merge runs when all parts are done, and is, bit for bit, one render of all samples.
# Names of files may hold anything.
set -euo pipefail
tyndall=${TYNDALL:-tyndall}
if [ "${TYNDALL_FARM_STEP:-}" = shard ]; then
  # One shard. The film that is there, unfinished, is gone on with; a finished one is "already complete".
  first=$((SLURM_ARRAY_TASK_ID * SAMPLES / SHARDS)) last=$(((SLURM_ARRAY_TASK_ID + 1) * SAMPLES / SHARDS))
  scene=$1 output=$2
  shift 2
  exec >>"$output.parts/$SLURM_ARRAY_TASK_ID.log" 2>&1
  "$tyndall" render "$scene" --samples "$first:$last" -o "$output.parts/$SLURM_ARRAY_TASK_ID.exr" --progress plain \
    --threads "${SLURM_CPUS_PER_TASK:-1}" "$@" &
  renderer=$!
  queue_again() {
    kill -TERM "$renderer" 2>/dev/null || true
    wait "$renderer" || true
    scontrol requeue "${SLURM_ARRAY_JOB_ID}_$SLURM_ARRAY_TASK_ID"
    exit 0
  }
  trap queue_again USR1
  status=0
  wait "$renderer" || status=$?
  exit "$status"
fi
if [ "${TYNDALL_FARM_STEP:-}" = merge ]; then
  scene=$1 output=$2
  shift 2
  exec >>"$output.parts/merge.log" 2>&1
  parts=()
  for ((shard = 0; shard < SHARDS; ++shard)); do parts+=("$output.parts/$shard.exr"); done
  "$tyndall" merge "${parts[@]}" -o "$output"
  # What was written is read again: it must be a whole film of this scene, with these settings and all samples.
  "$tyndall" render "$scene" --samples "0:$SAMPLES" --resume -q -o "$output" "$@"
  printf '%q: all %s samples\n' "${output#./}" "$SAMPLES"
  exit
fi
[ $# -ge 2 ] || { sed -n '2,13s/^# \{0,1\}//p' "$0"; exit 2; }
export SHARDS=${SHARDS:-16} SAMPLES=${SAMPLES:-1024} TYNDALL=$tyndall
[ "$SHARDS" -le "$SAMPLES" ] || { echo "found SHARDS=$SHARDS, expected at most SAMPLES=$SAMPLES" >&2; exit 2; }
script=$(realpath -- "$0") scene=$1 output=$2
shift 2
[ "$scene" != - ] || { echo 'found the scene -, standard input, expected one that every shard can read' >&2; exit 2; }
[[ $scene != -* ]] || scene=./$scene # a dash in front would begin an option
[[ $output == /* ]] || output=./$output
mkdir -p "$output.parts"
read -ra more <<<"${SBATCH_OPTIONS:-}"
words=("$script" "$scene" "$output" "$@")
# Jobs write their logs themselves, and Slurm adds what it has to say. In the name of a log it takes % for the beginning of a
# symbol, %% for a %, and a \ for the end of all symbols: then its own words are lost.
logs=$output.parts
[[ $logs == /* ]] || logs=$PWD/$logs
logs=${logs//%/%%}
# submit STEP LOG [sbatch's options]: queues this script, and prints the job's number.
submit() {
  local log=$logs/$2
  [[ $log != *\\* ]] || log=/dev/null
  TYNDALL_FARM_STEP=$1 sbatch --parsable --open-mode=append --output="$log" "${@:3}" "${more[@]}" "${words[@]}"
}
job=$(submit shard %a.log --job-name=tyndall --array="0-$((SHARDS - 1))" --requeue --signal=B:USR1@60)
echo "shards: job $job"
merge=$(submit merge merge.log --job-name=tyndall-merge --dependency="afterok:$job")
echo "merge: job $merge"
