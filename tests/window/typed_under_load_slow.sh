#!/usr/bin/env bash
# What is typed after a click goes where the click went, though the program sees both at once: it is stopped while they
# are sent, as a busy machine would hold it up.
. "$(dirname "$0")/_lib.sh"

write_scene scene.json 0.5
start scene.json
settle

at_once() { # COMMANDS of xdotool, which the program sees all at once
  kill -STOP "$pid"
  xdotool "$@"
  kill -CONT "$pid"
}
click_at() { # CONTROL COMMANDS...: a click and the commands, at once
  local x y
  read -r x y < <(at "$1" 50 45)
  at_once mousemove "$x" "$y" click 1 "${@:2}"
}

# Into number boxes: a click on another one ends the first; Tab goes on to the next.
for text in 0.25 0.375; do
  click_at gold.fuzz.value type --delay 0 "$text"
  wait_until has_keyboard control
  xdotool key Return
  wait_until has_value gold.fuzz "$text"
done
click_at gold.fuzz.value type --delay 0 0.125
click_at camera.vfov.value type --delay 0 35
wait_until has_value gold.fuzz 0.125
xdotool key Return
wait_until has_value camera.vfov 35
click_at camera.look_from.x type --delay 0 $'0.5\t1.25'
wait_until has_value camera.look_from.x 0.5
xdotool key Return
wait_until has_value camera.look_from.y 1.25
settle
[ "$(last_of view)" = "" ] || fail "a digit went to the views"

# A click beside the controls, then a shortcut: it is one.
click_at picture key f
wait_until has_value camera.look_at.y 0.8
settle

# Each press has the modifiers that it had, though they are let go before the window has drawn: Ctrl + A selects all,
# Shift + Home to the start, Ctrl + X cuts, Ctrl + V twice, and the last of three a's goes.
hold Control_L
xdotool keyup Control_L
key F2
type_text abc
hold Control_L
at_once keydown a keyup a keyup Control_L
at_once type --delay 0 x
at_once key Return
wait_for '^widget picture .* X$'
at_once key F2 type --delay 5 aaab
at_once key --delay 5 Left shift+Home ctrl+x End ctrl+v ctrl+v Left BackSpace Return # GLFW drops what comes twice in 1 ms
wait_for '^widget picture .* Baaaaa$'

# So it is with the mouse: the field of view by Ctrl + wheel, the focus by Shift + click; and a key of flight that is
# tapped within one drawing flies.
changes() { # CONTROL COMMANDS...
  local before
  settle
  before=$(value "$1")
  at_once "${@:2}"
  wait_until has_other_value "$1" "$before"
}
point picture 20 80
changes camera.vfov keydown Control_L click 4 keyup Control_L
changes camera.look_from.z key w
point picture 50 45
changes camera.focus_distance keydown Shift_L click 1 keyup Shift_L
finish
