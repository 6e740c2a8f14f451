#!/usr/bin/env bash
# How long it takes from the mouse's move to the new picture on the screen, while the camera is dragged at 60 events a
# second in a window of 1280 x 720: for a machine with two cores and nothing else to do. The limits are those of a
# window that feels immediate: half of the pictures within 50 ms, 95 of 100 within 90 ms.
. "$(dirname "$0")/_lib.sh"

for scene in showroom cornell-smoke; do
  open_window "$scene"
  sends 1 '^size 1280 720$' xdotool windowsize "$window" 1280 720
  point picture 50 50
  press 1
  # One process sends all moves, so that they come evenly.
  moves=()
  for step in $(seq 1 300); do
    moves+=(mousemove_relative -- $((step % 60 < 30 ? 4 : -4)) $((step % 20 < 10 ? 1 : -1)) sleep 0.0167)
  done
  xdotool "${moves[@]}"
  release 1
  finish
  # "latency camera n 123 p50 43.1 p95 52.4 …"
  read -r count median most < <(awk '/^latency camera/ { print $4, $6, $8 }' log)
  echo "$scene: $count pictures, half within $median ms, 95 % within $most ms"
  compares "$count > 60 and $median <= 50 and $most <= 90" || fail "$scene is slower than its limits"
done
