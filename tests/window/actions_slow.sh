#!/usr/bin/env bash
# Every action of the table, by its key, by the palette and, where it is there, by the menu of a right click. The window
# tells of its table in the log; an action that this test does not know fails it.
. "$(dirname "$0")/_lib.sh"

write_scene scene.json 0.2 4
start scene.json
click section.Render # so that all of the column is on the screen with larger texts, too
settle

# What comes of an action, as a line of the log; none: nothing but that it was carried out.
effect_of() {
  case $1 in
    deselect) echo '^gone Ball.name$' ;;
    add_an_object) echo '^widget menu.add_a_sphere ' ;;
    duplicate) echo '^widget picture .* Ball 2$' ;;
    delete) echo '^gone Ball.name$' ;;
    rename) echo '^widget Ball.name .* typing$' ;;
    add_a_sphere) echo '^widget picture .* Ball 2$' ;;
    add_a_hollow_ball) echo '^widget picture .* Shell' ;;
    add_a_box) echo '^widget picture .* Box' ;;
    add_a_quad) echo '^widget picture .* Quad' ;;
    add_a_triangle) echo '^widget picture .* Triangle' ;;
    add_a_disk) echo '^widget picture .* Disk' ;;
    add_a_lamp) echo '^widget picture .* Lamp 2$' ;;
    add_fog) echo '^widget picture .* Fog 2$' ;;
    pause_or_go_on) echo '^state ' ;;
    start_over) echo '^frame ' ;;
    save_the_scene) echo '^widget dialog.save ' ;;
    open_a_file) echo '^widget dialog.name ' ;;
    save_as) echo '^widget dialog.name ' ;;
    snapshot) echo '^message saved ' ;;
    clean_view_on_or_off | clean_beside_raw) echo '^widget image.clean.* on$' ;;
    hide_the_panels) echo '^(gone|widget) tab.Object' ;;
    full_screen) echo '^size ' ;;
    larger_text | smaller_text) echo '^widget window.text.* on$' ;;
    inspect_pixels) echo '^widget inspector ' ;;
    why_noisy) echo '^widget path.1 ' ;;
    actual_size) echo '^widget zoom ' ;;
    refine_a_rectangle_first) echo '^message drag over' ;;
    store_the_camera) echo '^widget camera.slot.1 .* on$' ;;
    split_view) echo '^widget split.b ' ;;
    reference_picture) echo '^widget dialog.load ' ;;
    export_the_chart) echo '^message saved ' ;;
    dark_or_light_theme) echo '^widget window.theme.* on$' ;;
    all_actions_by_name) echo '^widget palette ' ;;
    this_table) echo '^drawn' ;;
    play_or_stop_the_film | film_through_the_stored_cameras) echo '^did' ;;
    close_the_window | move_the_selection | frame_the_selection | make_single_user | reset_the_camera | next_stored_camera | undo | redo | usual_text | view:_*) echo '^did' ;;
    *) return 1 ;;
  esac
}

# xdotool's name of a key: Ctrl+Shift+Z is ctrl+shift+z.
keys_of() {
  sed -e 's/Ctrl+/ctrl /; s/Shift+/shift /; s/ + *$/ plus/; s/Esc/Escape/; s/ -$/ minus/; s/Space/space/' <<<"$1" |
    sed -E 's/(^| )([A-Z])$/\1\L\2/'
}

# The ball is selected, nothing is open, the mouse is over the floor.
begin() {
  key Escape
  wait_until has_keyboard shortcuts
  key Escape
  if ! logged '^widget tab.Object ' "$(grep -nE '^(widget|gone) tab.Object( |$)' "$scratch/log" | tail -1 | cut -d: -f1)"; then
    sends 1 '^widget tab.Object ' xdotool key Tab
  fi
  wait_until has_value objects.1 off
  click objects.1
  wait_until has_value objects.1 on
  point picture 20 85
}
# Waits for what came of an action, and takes back what it did to the scene.
check() { # NAME WAY LINE
  local effect
  effect=$(effect_of "$1") || fail "this test does not know what comes of: $1"
  wait_for "^did ${1//_/ }\$" "$3"
  wait_for "$effect" "$3"
  case $1 in
    add_an_object) ;;
    duplicate | delete | add_*) chord ctrl z ;;
    inspect_pixels) key Escape ;;
    why_noisy)
      key Escape
      key Escape
      ;;
    split_view)
      chord ctrl k
      type_text 'split view'
      key Return
      ;;
    this_table | full_screen | pause_or_go_on | actual_size) sends 1 "^did ${1//_/ }\$" again "$1" ;;
  esac
  echo "$1 by $2"
}
again() {
  case $1 in
    this_table) xdotool key F1 ;;
    full_screen) xdotool key F11 ;;
    actual_size) xdotool key 0 ;;
    *) xdotool key space ;;
  esac
}

grep '^action ' "$scratch/log" >table
while read -r _ name keys <&3; do
  [ "$name" = close_the_window ] && continue # the last thing below
  if [ "$keys" != none ]; then
    begin
    lines=$(here)
    # shellcheck disable=SC2046
    chord $(keys_of "$keys")
    check "$name" "$keys" "$lines"
  fi
  [ "$name" = all_actions_by_name ] && continue # it is the palette
  begin
  chord ctrl k
  type_text "${name//_/ }"
  lines=$(here)
  key Return
  check "$name" palette "$lines"
done 3<table

# The menu of the selection, and that of Insert.
for name in duplicate delete rename add_a_box add_a_lamp; do
  begin
  lines=$(here)
  if [[ $name = add_* ]]; then
    key Insert
  else
    point picture 50 45 # the ball: a right click selects what is under the mouse
    sends 1 '^buttons 0 1 0' xdotool mousedown 3
    sends 1 '^buttons 0 0 0' xdotool mouseup 3
  fi
  wait_for "^widget menu.$name " "$lines"
  lines=$(here)
  click "menu.$name"
  check "$name" menu "$lines"
done

begin
click objects.1
chord ctrl q
wait_for '^did close the window$'
finish
