#!/usr/bin/env bash
# Looking closer: the inspector and the path that makes a pixel noisy, zoom, a rectangle that is refined first, legends,
# false colour, the histogram. (What tone curves show: what_is_saved_slow.sh.)
. "$(dirname "$0")/_lib.sh"

picture_is_wide() { # PIXELS
  # shellcheck disable=SC2046
  set -- "$1" $(grep -E '^widget picture ' "$scratch/log" | tail -1)
  compares "abs($6 - $4 - $1) < 1.5"
}
inspector_says() { value inspector | grep -qE -- "$1"; }

write_scene scene.json 0.2
start scene.json
settle

# The inspector: what the pixel is, with its error.
point picture 50 45
key i
wait_until inspector_says 'samples  16 .*object   Ball .*material gold'
inspector_says 'red      [0-9.e-]+ +± [0-9.]+ ' || fail "no value with an error: $(value inspector)"
inspector_says 'shown    [0-9]+ [0-9]+ [0-9]+' || fail "not what is shown: $(value inspector)"
point picture 5 5
wait_until inspector_says 'object   nothing'

# Why noisy: the path is told and drawn, and stays when the camera moves, until an edit changes what it met.
point picture 50 45
lines=$(here)
chord shift i
wait_for '^widget path.1 .*ball' "$lines"
wait_until inspector_says 'the brightest of 16 samples: [0-9.e+-]+ % of their light'
place=$(at path.1 50)
point picture 40 80
press 1
point picture 45 80
release 1
settle
[ "$(at path.1 50)" != "$place" ] || fail 'the path did not follow the camera'
lines=$(here)
click gold.fuzz 80
wait_for '^gone path.1$' "$lines"
chord ctrl z
chord ctrl z
settle
point picture 50 45
chord shift i
wait_for '^widget path.1 ' "$lines"
key Escape
wait_for '^gone path.1$' "$lines"
key Escape
wait_for '^gone inspector$' "$lines"

# Zoom: actual size, at the cursor by Alt + wheel, moved by Alt + drag; clicks still meet what is under the cursor.
settle
before=$(submits)
point picture 50 45
key 0
wait_until picture_is_wide 320
click picture 50 45
wait_for '^widget picture .* Ball$'
xdotool keydown alt
wait_for '^key 342'
roll
wait_until picture_is_wide 400
press 1
point picture 60 60
release 1
xdotool keyup alt
settle
lines=$(here)
key Escape
wait_for '^widget picture [^B]*$' "$lines"
click picture 50 45
wait_for '^widget picture .* Ball$' "$lines"
[ "$(submits)" = "$before" ] || fail 'looking closer edited the scene'
key Escape
key 0
wait_until picture_is_wide 320
key 0
wait_until picture_is_wide 908

# Legends tell what colours mean; views without a digit are in the palette.
for view in 'samples=samples: 0 16 32' 'noise=estimated relative error: 0 % 50 % 100 %' \
  'false=stops from middle grey: -6 -5 -4 -3 -2 -1 0' 'cost=rays of a path: 0 '; do
  chord ctrl k
  type_text "view ${view%%=*}"
  key Return
  wait_until grep -qE "^widget legend .*${view#*=}" "$scratch/log"
  wait_until has_keyboard shortcuts
done
chord ctrl k
type_text 'view object'
key Return
wait_until has_value image.view.object on
wait_for '^gone legend$'
wait_until has_keyboard shortcuts
key 1

# The histogram tells what is clipped.
click section.Histogram
wait_for '^widget histogram .*white, clipped: [0-9.]+ %'
finish

# A rectangle is refined first, and later the rest.
write_scene long.json 0.2 100000
start long.json
lines=$(here)
chord ctrl b
wait_for '^message drag over' "$lines"
point picture 40 40
press 1
point picture 60 60
release 1
wait_for '^widget rectangle .*refined first: [0-9,]+ spp' "$lines"
chord ctrl b
wait_for '^gone rectangle$' "$lines"
finish
