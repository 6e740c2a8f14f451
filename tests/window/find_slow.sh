#!/usr/bin/env bash
# Finding things: the palette does what its lines say, by keys and by mouse, and brings up rows by words of other
# programs; what is selected in the picture is shown in the column; Esc closes the innermost thing first; types are chosen
# from a list.
. "$(dirname "$0")/_lib.sh"

write_scene scene.json 0.2
start scene.json
settle

# By name and Enter: the view changes; digits typed there are no shortcuts.
chord ctrl k
type_text 'nor'
key Return
wait_until has_value image.view.normal on
wait_until has_keyboard shortcuts
chord ctrl k
type_text 1
wait_until has_value palette 1
key Escape
wait_for '^gone palette$'
has_value image.view.normal on || fail 'a digit in the palette changed the view'
key 1
wait_until has_value image.view.beauty on

# Return without a match: the palette goes on. Words of other programs: a row in a folded section takes what is typed,
# though all of it comes at once; one that is not there says what to select.
find_and() { # WORDS: types them into the palette, and Return
  chord ctrl k
  type_text "$1"
  key Return
}
click section.Render
find_and qqq
chord ctrl a
type_text bounces
kill -STOP "$pid"
xdotool key --delay 5 Return 1 7 Return # GLFW drops a key that comes twice within a millisecond
kill -CONT "$pid"
wait_until has_value render.max_depth 17
lines=$(here)
find_and emission
wait_for '^message Power: select a lamp first$' "$lines"
find_and A/B
wait_until has_value render.split.on on
click render.split.off

# By mouse.
lines=$(here)
chord ctrl k
type_text 'add lamp'
wait_for '^widget palette.add_a_lamp ' "$lines"
click palette.add_a_lamp
wait_for '^widget picture .* Lamp 2$' "$lines"
chord ctrl z
wait_for '^gone Lamp_2.name' "$lines"
settle

# What is added comes where the mouse was when the list opened: no two in one place, and none at the origin.
# add_at X Y: the height of a ball that is added with the mouse at that part of the picture.
add_at() {
  local lines name
  point picture "$1" "$2"
  lines=$(here)
  chord ctrl k
  type_text 'add a sphere'
  key Return
  wait_for '^message added: .* .add a sphere.$' "$lines"
  name=$(last_of message | sed 's/^added: \(.*\) (.*/\1/; s/ /_/g')
  wait_for "^widget $name.center.y " "$lines"
  value "$name.center.y"
  chord ctrl z
  wait_for "^gone $name.center.y" "$lines"
}
high=$(add_at 50 10)
low=$(add_at 20 80)
compares "$high > $low + 0.5" || fail "balls were added at heights $high and $low"
settle

# The type of the ball from a list; Esc closes the list, not the selection.
click picture 50 45
wait_for '^widget picture .* Ball$'
settle
lines=$(here)
click Ball.type
wait_for '^widget Ball.type.dielectric ' "$lines"
key Escape
wait_for '^gone Ball.type.dielectric' "$lines"
has_value Ball.type metal || fail "the type is $(value Ball.type)"
lines=$(here)
click Ball.type
wait_for '^widget Ball.type.fog_within ' "$lines"
click Ball.type.fog_within
wait_until has_value Ball.type 'fog within'
wait_for '^widget objects.4 ' "$lines"
lines=$(here)
chord ctrl z
wait_for '^gone objects.4$' "$lines"
wait_until has_value Ball.type metal
settle
finish
