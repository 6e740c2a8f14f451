#!/usr/bin/env bash
# Ten tasks of somebody who sees the window for the first time, with what is on the screen and nothing else: no key that the
# screen does not name. Change glass to gold, move the ball behind the fog, add a lamp, focus on it, compare two settings, find
# the noisiest pixel, save, come back, make a 4K PNG, undo it all.
. "$(dirname "$0")/_lib.sh"

tyndall_scene() { "$tyndall" convert showroom -o showroom.json; }
tyndall_scene
start showroom.json --spp 16
settle

# Runs an action by its name, from the button for all actions.
action() {
  local lines
  lines=$(here)
  click tab.actions
  wait_for '^widget palette ' "$lines"
  type_text "$1"
  lines=$(here)
  key Return
  wait_for "^did $1\$" "$lines"
}
# Selects an object by its line in the list.
select_object() { # TITLE NUMBER
  click tab.Objects
  wait_for "^widget objects.$2 "
  click "objects.$2"
  wait_for "^widget picture .* $1\$"
  click tab.Object
}
is() { compares "$(value "$1") $2 $3"; }

echo '1: change glass to gold'
select_object Glass 1
click Glass.material
wait_for '^widget Glass.material.gold '
click Glass.material.gold
wait_until has_value Glass.material gold
settle

echo '2: move the ball behind the fog'
select_object Ball 3
point handle.z 50
press 1
read -r x y <<<"$(last_of mouse)"
move $((x - 90)) $((y - 90))
release 1
wait_until is Ball.center.z '<' -0.8
settle

echo '3: add a lamp'
point picture 25 35
sends 1 '^buttons 0 1 0' xdotool mousedown 3
sends 1 '^buttons 0 0 0' xdotool mouseup 3
wait_for '^widget menu.add_a_lamp '
click menu.add_a_lamp
wait_for '^widget picture .* Lamp 2$'
settle

echo '4: focus on it'
action 'this table' # the table tells how
wait_until has_keyboard shortcuts
key Escape
read -r x y <<<"$(at handle.move 50)"
before=$(value camera.focus_distance)
move "$x" "$((y + 1))"
xdotool keydown shift
press 1
release 1
xdotool keyup shift
wait_until has_other_value camera.focus_distance 'none'
echo "   focus $before to $(value camera.focus_distance)"
settle

echo '5: compare two settings'
click tab.Render
click render.split.on
wait_until has_value render.split.on on
click render.integrator.path
wait_for '^halves'
settle
click render.split.off
wait_for '^widget dialog.b '
click dialog.b
wait_until has_value render.integrator.path on
settle

echo '6: find the noisiest pixel'
click tab.Image
click image.view.noise
wait_until has_value image.view.noise on
settle
brightest=$(python3 - "$screen/Xvfb_screen0" "$(at picture 0 0)" "$(at picture 100 100)" <<'PY'
import struct, sys
data = open(sys.argv[1], "rb").read()
x0, y0 = map(int, sys.argv[2].split())
x1, y1 = map(int, sys.argv[3].split())
header = struct.unpack(">25I", data[:100])
stride, start = header[12], header[0] + 12 * header[19]
best = (-1, 0, 0)
for y in range(y0 + 2, y1 - 2):
    row = data[start + y * stride : start + (y + 1) * stride]
    for x in range(x0 + 2, x1 - 2):
        best = max(best, (row[4 * x] + row[4 * x + 1] + row[4 * x + 2], x, y))
print(*best)
PY
)
read -r light x y <<<"$brightest"
[ "$light" -gt 0 ] || fail 'the view of noise is black'
move "$x" "$y"
echo "   at $x $y"
click image.view.beauty
settle

echo '7: save'
action 'save as'
wait_until has_keyboard control
xdotool key ctrl+a
type_text "$scratch/mine"
enter
wait_for '^saved .*/mine.json'
settle_without_message
finish

echo '8: come back'
start --spp 16
settle_without_message
click tab.Scenes
wait_for '^widget scenes.recent.0 '
lines=$(here)
click scenes.recent.0
wait_for '^message opened mine.json' "$lines"
settle_without_message
has_value render.integrator.path on || fail 'what came back is not what was saved'

echo '9: make a 4K PNG'
click tab.Render
type_value render.spp.value 1
type_value render.size.width 3840
type_value render.size.height 2160
wait_until has_value render.size.height 2160
settle
lines=$(here)
action snapshot
wait_for '^saved .*mine-001' "$lines"
python3 -c "
import struct
print(struct.unpack('>II', open('$scratch/mine-001.png', 'rb').read()[16:24]))
assert struct.unpack('>II', open('$scratch/mine-001.png', 'rb').read()[16:24]) == (3840, 2160)"
settle_without_message

echo '10: undo it all'
while ! logged '^message nothing to undo' 1; do action undo; done
settle
finish
