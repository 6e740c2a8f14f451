#!/usr/bin/env bash
# Tiny, hidden, large and back; another density of the screen; a display that cannot be used or goes away.
. "$(dirname "$0")/_lib.sh"

write_scene scene.json 0.2
start scene.json
settle
for size in "1 1" "160 120" "40 700" "1200 30" "373 31" "1280 800" "900 600"; do
  # shellcheck disable=SC2086
  sends 1 "^size $size\$" xdotool windowsize "$window" $size
done
sends 1 '^size 1280 2700$' key F11 # all of the screen
sends 1 '^size 900 600$' key F11
settle
xdotool windowunmap --sync "$window"
xdotool windowmap --sync "$window"
move 100 100
type_value gold.fuzz.value 0.9
wait_for '^submit 2'
finish

DISPLAY=:4321 "$tyndall" view scene.json 2>errors && fail "opened on no display"
[ "$(wc -l <errors)" = 1 ] || fail "not one line: $(cat errors)"
status=0
env -u DISPLAY -u WAYLAND_DISPLAY "$tyndall" view scene.json 2>errors || status=$?
[ "$status" = 3 ] || fail "exit code $status without a display"
[ "$(wc -l <errors)" = 1 ] || fail "not one line: $(cat errors)"

# The display goes away while the window is open.
exec 3> >(cat >server)
Xvfb -displayfd 3 -screen 0 640x480x24 -nolisten tcp 2>/dev/null &
server=$!
exec 3>&-
pid=$server
has_display() { [ -s server ]; }
wait_until has_display
: >log
DISPLAY=:$(cat server) "$tyndall" view scene.json --ui-log log 2>errors &
pid=$!
wait_for '^frame 1 '
kill "$server"
ends_with 3
[ "$(wc -l <errors)" = 1 ] || fail "not one line: $(cat errors)"
