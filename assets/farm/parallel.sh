#!/usr/bin/env bash
# One picture on many machines by GNU parallel over ssh, then the merge on this machine:
#
#   MACHINES=one,two,: SHARDS=16 SAMPLES=1024 ./parallel.sh SCENE OUTPUT.exr [options of "tyndall render"]
#
# MACHINES: names that ssh knows; ":" is this one. The scene file is sent, and the parts come back, so the machines need to
# share nothing but tyndall itself (scenes with textures: in one folder with them, which all machines have). A shard that
# fails, or whose machine goes away, is tried again on another one, three times. Started again, it goes on with what is there.
set -euo pipefail
tyndall=${TYNDALL:-tyndall}
[ $# -ge 2 ] || { sed -n '2,9s/^# \{0,1\}//p' "$0"; exit 2; }
SHARDS=${SHARDS:-16} SAMPLES=${SAMPLES:-1024} scene=$1 output=$2
shift 2
[ "$SHARDS" -le "$SAMPLES" ] || { echo "found SHARDS=$SHARDS, expected at most SAMPLES=$SAMPLES" >&2; exit 2; }
mkdir -p "$output.parts"
files=()
[ ! -f "$scene" ] || files=(--transferfile "$scene")
parts=()
jobs=()
for ((shard = 0; shard < SHARDS; ++shard)); do
  part=$output.parts/$shard.exr
  parts+=("$part")
  jobs+=("$((shard * SAMPLES / SHARDS)):$(((shard + 1) * SAMPLES / SHARDS)) $part")
done
printf '%s\n' "${jobs[@]}" | parallel --colsep ' ' --sshlogin "${MACHINES:-:}" --jobs "${JOBS:-1}" --retries 3 --workdir . \
  "${files[@]}" --return '{2}' --joblog "$output.parts/jobs.log" \
  mkdir -p "$(printf '%q' "$output.parts")" '&&' "$(printf '%q ' "$tyndall" render "$scene")" --samples '{1}' -o '{2}' -q "$(printf '%q ' "$@")"
"$tyndall" merge "${parts[@]}" -o "$output"
# What was written is read again: it must be a whole film of this scene, with these settings and all samples.
"$tyndall" render "$scene" --samples "0:$SAMPLES" --resume -q -o "$output" "$@"
echo "$output: all $SAMPLES samples"
