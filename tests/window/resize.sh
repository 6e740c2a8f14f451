#!/usr/bin/env bash
# Tiny, hidden, large and back; a display that cannot be used, or goes away and takes no edits along.
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

for display in 'DISPLAY=:4321' '-u DISPLAY -u WAYLAND_DISPLAY'; do
  status=0
  # shellcheck disable=SC2086
  env $display "$tyndall" view scene.json 2>errors || status=$?
  [ "$status" = 3 ] || fail "exit code $status without a display"
  [ "$(wc -l <errors)" = 1 ] || fail "not one line: $(cat errors)"
done

# The display goes away while the window is open.
coproc server { exec Xvfb -displayfd 1 -screen 0 1280x2700x24 -nolisten tcp 2>/dev/null; }
read -r number <&"${server[0]}"
export DISPLAY=:$number
start scene.json
type_value gold.fuzz.value 0.55
kill "$server_PID"
ends_with 3
[ "$(wc -l <errors)" = 2 ] || fail "not a line of the display and one of the edits: $(cat errors)"
grep -qs '"fuzz": 0.55' state/tyndall/unsaved-*.json || fail 'the edits went with the display'
