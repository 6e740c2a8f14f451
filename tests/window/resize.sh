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
for _ in 1 2; do
  key F11
  sleep 0.3
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

# A server that goes away.
exec 3> >(cat >server)
Xvfb -displayfd 3 -screen 0 640x480x24 -nolisten tcp 2>/dev/null &
server=$!
exec 3>&-
for _ in $(seq 100); do
  [ -s server ] && break
  sleep 0.1
done
DISPLAY=:$(cat server) "$tyndall" view scene.json --ui-log log 2>errors &
pid=$!
wait_for '^frame 1 '
kill "$server"
status=0
wait "$pid" || status=$?
[ "$status" = 3 ] || fail "exit code $status when the display went away"
[ "$(wc -l <errors)" = 1 ] || fail "not one line: $(cat errors)"
