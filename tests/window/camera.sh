#!/usr/bin/env bash
# Mouse and keys in the picture: orbit, pan, dolly, field of view, fly, select, focus, frame, undo, reset, panels, help.
. "$(dirname "$0")/_lib.sh"

write_scene scene.json 0.2
start scene.json
wait_for '^state finished'

drag() { # BUTTON FROM_X FROM_Y TO_X TO_Y, in percent of the picture
  point picture "$2" "$3"
  xdotool mousedown "$1"
  sleep 0.08
  point picture $((($2 + $4) / 2)) $((($3 + $5) / 2))
  point picture "$4" "$5"
  xdotool mouseup "$1"
  sleep 0.3
}
changed() { # NAME BEFORE
  [ "$(value "$1")" != "$2" ] || fail "$1 is still $2"
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
sleep 0.3
z=$(value camera.look_from.z)
drag 3 50 40 50 60
changed camera.look_from.z "$z"
chord ctrl z
sleep 0.3
[ "$(value camera.look_from.z)" = "$z" ] || fail "undo: $(value camera.look_from.z) instead of $z"
point picture 50 50
xdotool click 4
sleep 0.8
changed camera.look_from.z "$z"
fov=$(value camera.vfov)
xdotool keydown ctrl
sleep 0.1
xdotool click 4
sleep 0.1
xdotool keyup ctrl
sleep 0.8
changed camera.vfov "$fov"
z=$(value camera.look_from.z)
xdotool keydown w
sleep 0.5
xdotool keyup w
sleep 0.3
changed camera.look_from.z "$z"
key Home
sleep 0.3
[ "$(value camera.vfov)" = "$fov" ] || fail "Home: field of view $(value camera.vfov)"
[ "$(value camera.look_at.z)" = 0 ] || fail "Home: target $(value camera.look_at.z)"

click picture 50 45
wait_for '^widget picture .* Ball$'
key f
sleep 0.3
[ "$(value camera.look_at.y)" = 0.8 ] || fail "F: target $(value camera.look_at.y)"
key Escape
wait_for '^gone Ball.center.x'
xdotool keydown shift
sleep 0.1
click picture 50 45
xdotool keyup shift
sleep 0.3
python3 -c "import sys; d = $(value camera.focus_distance); z = $(value camera.look_from.z); sys.exit(not z - 1.2 < d < z)" ||
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
