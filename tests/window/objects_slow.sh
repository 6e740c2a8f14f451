#!/usr/bin/env bash
# Objects as a person handles them: moved by handles and by G, sized, added, duplicated, named, deleted, each one step to
# undo; what lies behind is selected by clicking again; the saved file holds what was done and nothing else.
. "$(dirname "$0")/_lib.sh"

write_scene scene.json 0.2
start scene.json
settle

pull() { # HANDLE DX DY: drags a handle of the selection
  point "handle.$1" 50
  press 1
  # shellcheck disable=SC2086
  set -- $1 $2 $3 $(last_of mouse)
  move $(($4 + $2)) $(($5 + $3))
  release 1
  settle
}
is_above() { compares "$(value "$1") > $2"; } # NAME NUMBER
undo() { # NAME VALUE: undoes, until the control has that value
  local lines
  lines=$(here)
  chord ctrl z
  wait_until has_value "$1" "$2"
}

# Handles: along X only x changes; in the camera's plane the ball goes along with the mouse; size; each one step.
click picture 50 45
wait_for '^widget picture .* Ball$'
settle
pull x 100 30
wait_until is_above Ball.center.x 0.5
has_value Ball.center.y 0.8 || fail "y is $(value Ball.center.y)"
has_value camera.look_from.x 0 || fail 'the camera moved'
undo Ball.center.x 0
pull move 60 -60
wait_until is_above Ball.center.y 1
undo Ball.center.y 0.8
pull size.radius 40 40
wait_until is_above Ball.radius 0.9
undo Ball.radius 0.8

# A drag elsewhere still orbits.
point picture 20 80
press 1
point picture 25 80
release 1
settle
has_other_value camera.look_from.x 0 || fail 'a drag beside the ball did not orbit'
undo camera.look_from.x 0

# G, an axis, a number, Enter; then Esc takes a movement back.
key g
key x
for character in 1 period 5; do key $character; done
key Return
wait_until has_value Ball.center.x 1.5
undo Ball.center.x 0
key g
point picture 60 60
wait_until has_other_value Ball.center.x 0
key Escape
wait_until has_value Ball.center.x 0
settle

# Insert: the menu adds where the cursor is. The lamp is selected, named, duplicated and deleted.
point picture 30 80
lines=$(here)
key Insert
wait_for '^widget menu.add_a_lamp ' "$lines"
click menu.add_a_lamp
wait_for '^widget picture .* Lamp 2$' "$lines"
settle
key F2
type_text sun
enter
wait_for '^widget picture .* Sun$' "$lines"
chord ctrl d
wait_for '^widget picture .* Sun 2$' "$lines"
lines=$(here)
key Delete
wait_for '^message deleted Sun 2' "$lines"

# The menu of a right click is about what is under the cursor; Ctrl+click adds to the selection.
point picture 50 45
lines=$(here)
press 3
release 3
wait_for '^widget menu.duplicate ' "$lines"
key Escape
wait_for '^gone menu.duplicate' "$lines"
hold ctrl
click picture 79 40
xdotool keyup ctrl
wait_for '^widget picture .* Fog$' "$lines"
settle
pull x 50 0
has_other_value Fog.center.x 2 || fail 'the fog did not move'
lines=$(here)
key Escape
wait_for '^widget picture [0-9 ]*$' "$lines"
click picture 50 45
wait_for '^widget picture .* Ball$' "$lines"
settle
has_other_value Ball.center.x 0 || fail 'the ball did not go along'
chord ctrl z
wait_until has_value Ball.center.x 0

# Again at the same place: what lies behind the ball.
lines=$(here)
click picture 50 55
click picture 50 55
wait_for '^widget picture .* Floor' "$lines"
settle

# Saved: the file differs by the lamp and its name alone, in normal form, with the order kept.
"$tyndall" convert scene.json -o before.json
chord ctrl s
wait_for '^widget dialog.save '
click dialog.save
wait_for '^saved '
without_commas() { sed 's/,$//' "$1"; }
diff <(without_commas before.json) <(without_commas scene.json) >difference && fail 'nothing was saved'
grep -q '^<' difference && fail "more than the new lamp differs: $(cat difference)"
grep -q '"name": "sun"' scene.json || fail 'the new lamp is not in the file'
finish
