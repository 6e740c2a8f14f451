#!/usr/bin/env bash
# Vary in the menu of a row: nine small pictures, the present value marked, taken over by a click and by arrow keys, which
# is one step to undo; a second value; Esc closes the strip.
. "$(dirname "$0")/_lib.sh"

write_scene scene.json 0.2
open_window scene.json
sends 1 '^size 1280 800$' xdotool windowsize "$window" 1280 800
settle

# vary ROW: its menu, and Vary in it.
vary() {
  point "$1" 60
  local from
  from=$(here)
  press 3
  release 3
  wait_for "^widget $1.vary " "$from"
  click "$1.vary"
}

vary gold.fuzz
wait_for '^widget strip.8 .* 1 spp [1-9]'
has_value strip.0 '0 spp 8' || wait_for '^widget strip.0 .* 0 spp [1-9]'
grep -qE '^widget strip.[0-9] .* 0.2 spp' log || fail 'the present value is not among the pictures'
grep -qE '^widget strip.9 ' log && fail 'there are more than nine pictures'
wait_for '^widget strip.4 .* 0.5 spp (32|128|512)$' # they sharpen

# What is taken over, and undone as one step.
click strip.4
wait_until has_value gold.fuzz 0.5
key Right
wait_until has_value gold.fuzz 0.625
key Right
wait_until has_value gold.fuzz 0.75
chord ctrl z
wait_until has_value gold.fuzz 0.2
chord ctrl shift z
wait_until has_value gold.fuzz 0.75

# The pictures follow other edits, and stay when the value itself changes.
lines=$(here)
type_value gold.fuzz.value 0.3
wait_until has_value gold.fuzz 0.3
sleep 1
logged '^widget strip.0 .* spp 8$' "$lines" && fail 'the pictures began anew though only the value has changed'
lines=$(here)
type_value camera.vfov.value 35
wait_for '^widget strip.0 .* 0 spp 8$' "$lines"

# A second value; the same row again takes it away; Esc closes.
vary camera.vfov
wait_for '^widget strip.26 .* 1, 120 spp [1-9]|^widget strip.26 .* 1, 120° spp [1-9]'
lines=$(here)
click strip.13
wait_until has_value gold.fuzz 0.5
vary camera.vfov
lines=$(here)
wait_for '^gone strip.26' 1
key Escape
wait_for '^gone strip.0$' "$lines"
finish
