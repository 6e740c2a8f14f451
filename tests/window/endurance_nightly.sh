#!/usr/bin/env bash
# Half an hour of random input after ten minutes of it: the window lives, and its memory does not grow.
# TYNDALL_ENDURANCE_MINUTES changes the time. With a sanitizer, which takes memory of its own: only the ten minutes, without
# a report.
. "$(dirname "$0")/_lib.sh"

write_scene scene.json 0.2 8
cp scene.json original
minutes=${TYNDALL_ENDURANCE_MINUTES:-30}
if [[ $(ldd "$tyndall") == *lib[at]san* ]]; then
  minutes=0
else
  ulimit -v 6000000 # kB: where random input asks for a huge picture, this machine is to stay usable
fi
start scene.json -t 1
sends 1 '^size 1000 900$' xdotool windowsize "$window" 1000 900
python3 -B "$root/tests/window/endurance.py" "$pid" "$window" original scene.json "$scratch/log" "$minutes" ||
  fail 'see above'
kill -TERM "$pid"
wait "$pid" || true
trap - EXIT
! grep -E "Sanitizer|runtime error" errors || fail "a sanitizer has something to report"
