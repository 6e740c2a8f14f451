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
click_at() { echo mousemove "$1" "$2" click 1; }

# Into a number box, twice: the second click ends the first box.
for text in 0.25 0.375; do
  # shellcheck disable=SC2046
  at_once $(click_at $(at gold.fuzz.value 50)) type --delay 0 "$text"
  wait_until has_keyboard control
  xdotool key Return
  wait_until has_value gold.fuzz "$text"
done
settle
[ "$(last_of view)" = "" ] || fail "a digit went to the views"

# Two boxes in one go: the click on the second one ends the first.
# shellcheck disable=SC2046
at_once $(click_at $(at gold.fuzz.value 50)) type --delay 0 "0.125"
# shellcheck disable=SC2046
at_once $(click_at $(at camera.vfov.value 50)) type --delay 0 "35"
wait_until has_value gold.fuzz 0.125
xdotool key Return
wait_until has_value camera.vfov 35

# Click, number, Tab and number at once.
# shellcheck disable=SC2046
at_once $(click_at $(at camera.look_from.x 50)) type --delay 0 $'0.5\t1.25'
wait_until has_value camera.look_from.x 0.5
xdotool key Return
wait_until has_value camera.look_from.y 1.25
settle

# A click beside the controls, then a shortcut: it is one.
# shellcheck disable=SC2046
at_once $(click_at $(at picture 50 45)) key f
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
settle
vfov=$(value camera.vfov)
point picture 20 80
at_once keydown Control_L click 4 keyup Control_L
wait_until has_other_value camera.vfov "$vfov"
at=$(value camera.look_from.z)
at_once key w
wait_until has_other_value camera.look_from.z "$at"
settle
focus=$(value camera.focus_distance)
point picture 50 45
at_once keydown Shift_L click 1 keyup Shift_L
wait_until has_other_value camera.focus_distance "$focus"
finish
