#!/usr/bin/env bash
# Mouse and keys in the picture: orbit, pan, dolly, field of view, fly, select, focus, frame, undo, reset, panels, help.
. "$(dirname "$0")/_lib.sh"

write_scene scene.json 0.2
start scene.json
settle

drag() { # BUTTON FROM_X FROM_Y TO_X TO_Y, in percent of the picture
  point picture "$2" "$3"
  press "$1"
  point picture $((($2 + $4) / 2)) $((($3 + $5) / 2))
  point picture "$4" "$5"
  release "$1"
  settle
}
changed() { # NAME BEFORE
  has_other_value "$1" "$2" || fail "$1 is still $2"
}

x=$(value camera.look_from.x)
drag 1 40 50 60 50
changed camera.look_from.x "$x"
[ "$(value camera.look_at.x)" = 0 ] || fail "orbit moved the target"
lines=$(here)
chord ctrl z
wait_for '^widget camera.look_from.x .* 0$' "$lines"
drag 2 40 50 60 60
changed camera.look_at.x 0
chord ctrl z
settle
z=$(value camera.look_from.z)
drag 3 50 40 50 60
changed camera.look_from.z "$z"
chord ctrl z
settle
[ "$(value camera.look_from.z)" = "$z" ] || fail "undo: $(value camera.look_from.z) instead of $z"
point picture 50 50
roll
roll
roll
settle
changed camera.look_from.z "$z"
chord ctrl z
settle
[ "$(value camera.look_from.z)" = "$z" ] || fail "a turn of the wheel is not undone as one: $(value camera.look_from.z)"
roll
settle
changed camera.look_from.z "$z"
fov=$(value camera.vfov)
hold ctrl
roll
xdotool keyup ctrl
settle
changed camera.vfov "$fov"
z=$(value camera.look_from.z)
hold w
wait_until has_other_value camera.look_from.z "$z"
xdotool keyup w
settle # it flies as long as the key is held
key Home
settle
[ "$(value camera.vfov)" = "$fov" ] || fail "Home: field of view $(value camera.vfov)"
[ "$(value camera.look_at.z)" = 0 ] || fail "Home: target $(value camera.look_at.z)"

click picture 50 45
wait_for '^widget picture .* Ball$'
key f
settle
[ "$(value camera.look_at.y)" = 0.8 ] || fail "F: target $(value camera.look_at.y)"
key Escape
wait_for '^gone Ball.center.x'
hold shift
click picture 50 45
xdotool keyup shift
settle
z=$(value camera.look_from.z)
compares "$z - 1.2 < $(value camera.focus_distance) < $z" ||
  fail "focus: $(value camera.focus_distance)"

key Tab
wait_for '^gone camera.vfov$'
lines=$(here)
key Tab
wait_for '^widget camera.vfov' "$lines"
key F1
wait_for '^help open'
key Escape
key space
wait_for '^state paused'
key space
lines=$(here)
key r
wait_for '^frame [0-9]+ 16 ' "$lines"
lines=$(here)
click scenes.cover 20
wait_for '^message opened cover' "$lines"
finish
