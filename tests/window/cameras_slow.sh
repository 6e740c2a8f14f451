#!/usr/bin/env bash
# Cameras that are put aside: stored, looked through by a click or by the palette, each one step to undo, forgotten. And
# the picture rendered at the window's size or at the file's.
. "$(dirname "$0")/_lib.sh"

write_scene scene.json 0.2
start scene.json
settle

orbit() {
  point picture 40 60
  press 1
  point picture "$1" 60
  release 1
  settle
}

home=$(value camera.look_from.x)
click camera.store
wait_until has_value camera.slot.1 on
orbit 60
side=$(value camera.look_from.x)
[ "$side" != "$home" ] || fail 'the camera did not move'
has_value camera.slot.1 off || fail 'the camera moved, and its slot is still marked'
chord ctrl k
type_text 'store the camera'
key Return
wait_until has_value camera.slot.2 on
wait_until has_keyboard shortcuts

click camera.slot.1
wait_until has_value camera.look_from.x "$home"
settle
chord ctrl k
type_text 'next stored'
key Return
wait_until has_value camera.look_from.x "$side"
wait_until has_keyboard shortcuts
chord ctrl z
wait_until has_value camera.look_from.x "$home"
chord ctrl z
wait_until has_value camera.look_from.x "$side"
lines=$(here)
point camera.slot.1 50
press 3
release 3
wait_for '^gone camera.slot.2$' "$lines"
settle

# Rendered at the window's size the picture has as many pixels as the window shows, and the file keeps its own.
point picture 50 45
key i
lines=$(here)
click render.at.window
wait_for '^submit ' "$lines"
settle
point picture 99 99
wait_until grep -qE '^widget inspector .*pixel    [89][0-9][0-9], 5[0-9][0-9] ' log
lines=$(here)
click picture 50 45
wait_for '^widget picture .* Ball$' "$lines"
click render.at.file
settle
point picture 99 99
wait_until grep -qE '^widget inspector .*pixel    31[0-9], 19[0-9] ' log
chord ctrl s
wait_for '^widget dialog.save ' "$lines"
click dialog.save
wait_for '^saved '
grep -q '"width": 320' scene.json || fail 'the file has another size now'
finish
