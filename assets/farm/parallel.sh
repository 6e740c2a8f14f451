#!/usr/bin/env bash
# One picture on many machines by GNU parallel over ssh, then the merge on this machine:
#
#   MACHINES=one,two,: SHARDS=16 SAMPLES=1024 ./parallel.sh SCENE OUTPUT.exr [options of "tyndall render"]
#
# MACHINES: names that ssh knows; ":" is this one. The scene file is sent, and the parts come back, so the machines need to
# share nothing but tyndall itself (scenes with textures: in one folder with them, which all machines have). A shard that
# fails, or whose machine goes away, is tried again on another one, three times. Started again, it goes on with what is there.
# Names of files may hold anything.
#
#   MACHINES=one,two,: FRAMES=240 SHARDS=16 ./parallel.sh SCENE 'f/%04d.exr' [options of "tyndall animate"]
#
# renders the frames 0 to 239 of a film, in a folder that all machines share. Nothing is merged.
set -euo pipefail
tyndall=${TYNDALL:-tyndall}
[ $# -ge 2 ] || { sed -n '2,14s/^# \{0,1\}//p' "$0"; exit 2; }
SHARDS=${SHARDS:-16} SAMPLES=${SAMPLES:-1024} scene=$1 output=$2
shift 2
[ -n "${FRAMES:-}" ] || [ "$SHARDS" -le "$SAMPLES" ] || { echo "found SHARDS=$SHARDS, expected at most SAMPLES=$SAMPLES" >&2; exit 2; }
[ "$scene" != - ] || { echo 'found the scene -, standard input, expected one that every shard can read' >&2; exit 2; }
# In front of these names a dash would begin an option, and what stands before a colon would be a machine's name for rsync.
[[ $scene != -* && ($scene != *:* || $scene == /* || ! -f $scene) ]] || scene=./$scene
[[ $output == /* ]] || output=./$output
if [ -n "${FRAMES:-}" ]; then
  [ "$SHARDS" -le "$FRAMES" ] || { echo "found SHARDS=$SHARDS, expected at most FRAMES=$FRAMES" >&2; exit 2; }
  fixed=("$scene" "$output" "$tyndall" "$FRAMES" "$@")
  options=()
  for ((i = 5; i <= ${#fixed[@]}; ++i)); do options+=("{$i}"); done
  for ((shard = 0; shard < SHARDS; ++shard)); do
    printf '%s\0' "${fixed[@]}" "$((shard * FRAMES / SHARDS)):$(((shard + 1) * FRAMES / SHARDS))"
  done | parallel --null -N "$((${#fixed[@]} + 1))" --sshlogin "${MACHINES:-:}" --jobs "${JOBS:-1}" --retries 3 --workdir . \
    '{3}' animate '{1}' --frames '{4}' --frame-range "{$((${#fixed[@]} + 1))}" -o '{2}' -q "${options[@]}"
  exit
fi
mkdir -p "$output.parts"
send=()
[ ! -f "$scene" ] || send=(--transferfile '{1}')
parts=()
# What parallel reads it quotes for the shell, whatever it holds; what stands in its command line it takes for a template.
# So all names and options are read: for each job these, ended by zeros, and {1}, {2}, ... stand for them.
fixed=("$scene" "$output.parts" "$tyndall" "$@")
options=()
for ((i = 4; i <= ${#fixed[@]}; ++i)); do options+=("{$i}"); done
range="{$((${#fixed[@]} + 1))}" part="{$((${#fixed[@]} + 2))}"
for ((shard = 0; shard < SHARDS; ++shard)); do parts+=("$output.parts/$shard.exr"); done
for ((shard = 0; shard < SHARDS; ++shard)); do
  printf '%s\0' "${fixed[@]}" "$((shard * SAMPLES / SHARDS)):$(((shard + 1) * SAMPLES / SHARDS))" "${parts[shard]}"
done | parallel --null -N "$((${#fixed[@]} + 2))" --sshlogin "${MACHINES:-:}" --jobs "${JOBS:-1}" --retries 3 --workdir . \
  "${send[@]}" --return "$part" --joblog "$output.parts/jobs.log" \
  mkdir -p '{2}' '&&' '{3}' render '{1}' --samples "$range" -o "$part" -q "${options[@]}"
"$tyndall" merge "${parts[@]}" -o "$output"
# What was written is read again: it must be a whole film of this scene, with these settings and all samples.
"$tyndall" render "$scene" --samples "0:$SAMPLES" --resume -q -o "$output" "$@"
printf '%q: all %s samples\n' "${output#./}" "$SAMPLES"
