#!/usr/bin/env bash
# Tiny, hidden, large and back; another density of the screen; a display that cannot be used or goes away.
. "$(dirname "$0")/_lib.sh"

write_scene scene.json 0.2
start scene.json
wait_for '^state finished'
for size in "1 1" "160 120" "40 700" "1200 30" "373 31" "1280 800" "900 600"; do
  # shellcheck disable=SC2086
  xdotool windowsize "$window" $size
  sleep 0.3
  kill -0 "$pid" || fail "size $size"
done
xdotool windowunmap "$window"
sleep 0.5
xdotool windowmap "$window"
sleep 0.5
lines=$(here)
xdotool mousemove 100 100
wait_for '^drawn' "$lines"
type_value gold.fuzz.value 0.9
wait_for '^submit 2'
finish

DISPLAY=:4321 "$tyndall" view scene.json 2>errors && fail "opened on no display"
[ "$(wc -l <errors)" = 1 ] || fail "not one line: $(cat errors)"
status=0
env -u DISPLAY -u WAYLAND_DISPLAY "$tyndall" view scene.json 2>errors || status=$?
[ "$status" = 3 ] || fail "exit code $status without a display"
[ "$(wc -l <errors)" = 1 ] || fail "not one line: $(cat errors)"
