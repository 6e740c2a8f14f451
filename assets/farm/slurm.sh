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
#
#   FRAMES=240 SHARDS=16 ./slurm.sh SCENE 'f/%04d.exr' [options of "tyndall animate"]
#
# renders the frames 0 to 239 of a film, each job a range of them. Nothing is merged; logs go into SCENE.film-logs.
set -euo pipefail
tyndall=${TYNDALL:-tyndall}
if [ "${TYNDALL_FARM_STEP:-}" = shard ]; then
  # One shard. The film that is there, unfinished, is gone on with; a finished one is "already complete". Frames that are whole
  # stay.
  all=${FRAMES:-$SAMPLES}
  first=$((SLURM_ARRAY_TASK_ID * all / SHARDS)) last=$(((SLURM_ARRAY_TASK_ID + 1) * all / SHARDS))
  scene=$1 output=$2
  shift 2
  if [ -n "${FRAMES:-}" ]; then
    exec >>"$scene.film-logs/$SLURM_ARRAY_TASK_ID.log" 2>&1
    work=(animate "$scene" --frames "$FRAMES" --frame-range "$first:$last" -o "$output")
  else
    exec >>"$output.parts/$SLURM_ARRAY_TASK_ID.log" 2>&1
    work=(render "$scene" --samples "$first:$last" -o "$output.parts/$SLURM_ARRAY_TASK_ID.exr")
  fi
  "$tyndall" "${work[@]}" --progress plain --threads "${SLURM_CPUS_PER_TASK:-1}" "$@" &
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
[ $# -ge 2 ] || { sed -n '2,17s/^# \{0,1\}//p' "$0"; exit 2; }
export SHARDS=${SHARDS:-16} SAMPLES=${SAMPLES:-1024} FRAMES=${FRAMES:-} TYNDALL=$tyndall
[ "$SHARDS" -le "${FRAMES:-$SAMPLES}" ] || {
  echo "found SHARDS=$SHARDS, expected at most $([ -n "$FRAMES" ] && echo FRAMES || echo SAMPLES)=${FRAMES:-$SAMPLES}" >&2
  exit 2
}
script=$(realpath -- "$0") scene=$1 output=$2
shift 2
[ "$scene" != - ] || { echo 'found the scene -, standard input, expected one that every shard can read' >&2; exit 2; }
[[ $scene != -* ]] || scene=./$scene # a dash in front would begin an option
[[ $output == /* ]] || output=./$output
parts=${FRAMES:+$scene.film-logs}
parts=${parts:-$output.parts}
mkdir -p "$parts"
read -ra more <<<"${SBATCH_OPTIONS:-}"
words=("$script" "$scene" "$output" "$@")
# Jobs write their logs themselves, and Slurm adds what it has to say. In the name of a log it takes % for the beginning of a
# symbol, %% for a %, and a \ for the end of all symbols: then its own words are lost.
logs=$parts
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
[ -z "$FRAMES" ] || exit 0
merge=$(submit merge merge.log --job-name=tyndall-merge --dependency="afterok:$job")
echo "merge: job $merge"
