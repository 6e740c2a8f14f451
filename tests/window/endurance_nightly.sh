#!/usr/bin/env bash
# Half an hour of random input: the window lives, and its memory does not grow. TYNDALL_ENDURANCE_MINUTES changes the time.
. "$(dirname "$0")/_lib.sh"

write_scene scene.json 0.2 8
cp scene.json original
ulimit -v 6000000 # kB: where random input asks for a huge picture, this machine is to stay usable
start scene.json -t 1
sends 1 '^size 1000 900$' xdotool windowsize "$window" 1000 900
python3 -B "$root/tests/window/endurance.py" "$pid" "$window" original scene.json "$scratch/log" "${TYNDALL_ENDURANCE_MINUTES:-30}" ||
  fail 'see above'
kill -TERM "$pid"
wait "$pid" || true
trap - EXIT
