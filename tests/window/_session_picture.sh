#!/usr/bin/env bash
# The README's animated picture of a session: the metal ball becomes rougher and smooth again, the camera swings, the ball is
# selected. Needs ImageMagick, and a machine with nothing else to do. Arguments: the tyndall binary, the picture (.gif).
width=1280 height=800 options=()
. "$(dirname "$0")/_showroom.sh"

frames=0
shot() { # COUNT: as many pictures of the window as it is now
  import -window "$window" -resize 560x "$folder/$(printf 'frame-%03d' "$frames").png"
  for ((k = 1; k < $1; k++)); do
    cp "$folder/$(printf 'frame-%03d' "$frames").png" "$folder/$(printf 'frame-%03d' $((frames + k))).png"
  done
  frames=$((frames + $1))
}
line_of() { grep -E "^widget ${1//./\\.} " "$log" | tail -1; }
place() { # NAME ACROSS: the point at that percentage of a control
  local name x0 y0 x1 y1 _
  read -r _ name x0 y0 x1 y1 _ <<<"$(line_of "$1")"
  echo $((x0 + (x1 - x0) * $2 / 100)) $(((y0 + y1) / 2))
}
shown() { [ -n "$(line_of "$1")" ]; }
await() { until "$@"; do sleep 0.05; done; }
drawn() { grep -c '^drawn' "$log" || true; }
after_drawing() { # COMMAND: and a drawing after it
  local before
  before=$(drawn)
  "$@"
  until [ "$(drawn)" -gt "$before" ]; do sleep 0.02; done
}
# shellcheck disable=SC2046
go() { after_drawing xdotool mousemove $(place "$1" "$2"); }
click() {
  go "$1" "$2"
  after_drawing xdotool click 1
}

await shown gold.fuzz
await grep -qE '^frame 1 ([2-9]|[1-9][0-9]+) ' "$log"
shot 4
go gold.fuzz 25
xdotool mousedown 1
for across in 35 45 55 65 75 65 50 35 20 10; do
  go gold.fuzz "$across"
  shot 1
done
xdotool mouseup 1
shot 2
go picture 50
xdotool mousedown 1
for step in 47 44 41 38 35 38 41 44; do
  go picture "$step"
  shot 1
done
xdotool mouseup 1
shot 3
click picture 44
shot 3
convert -delay 18 -loop 0 "$folder"/frame-*.png -dither none -colors 64 -layers optimize "$picture"
