#!/usr/bin/env bash
# Keys of rows, the film's bar: going to a frame, play and stop, keys that follow objects, saved with the scene.
. "$(dirname "$0")/_lib.sh"

write_scene scene.json 0.2
open_window scene.json
sends 1 '^size 1280 800$' xdotool windowsize "$window" 1280 800
settle

# set_key ROW: its menu, and Key in it.
set_key() {
  point "$1" 60
  local from
  from=$(here)
  press 3
  release 3
  wait_for "^widget $1.key " "$from"
  click "$1.key"
}

set_key gold.fuzz
wait_for '^widget film.track .* 0$'
click film.track 99
wait_until has_value film.track 119
type_value gold.fuzz.value 0.8
wait_until has_value gold.fuzz 0.8
set_key gold.fuzz

# Going to a frame gives the scene its values; all of a drag is one step to undo.
lines=$(here)
click film.track 50
wait_until has_other_value gold.fuzz 0.8
compares "0.45 < $(value gold.fuzz) < 0.55" || fail "half way the fuzz is $(value gold.fuzz)"
chord ctrl z
wait_until has_value gold.fuzz 0.8

# Play goes on by itself, and stops.
click film.play
wait_until has_value film.play plays
frame=$(value film.track)
wait_until has_other_value film.track "$frame"
click film.play
wait_until has_value film.play rests

# Saved with the scene, and rendered.
chord ctrl s
wait_for '^widget dialog.save '
click dialog.save # the comments go
wait_until grep -q '"animation"' scene.json
"$tyndall" render scene.json --frame 119 --spp 1 --size 16x10 -q -o f.png 2>render_errors || fail "$(cat render_errors)"
finish
