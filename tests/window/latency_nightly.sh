#!/usr/bin/env bash
# How long it takes from the mouse's move to the new picture on the screen, in a window of 1280 x 720: for a machine with two
# cores and nothing else to do. While the camera or a slider is dragged at 60 events a second the limits are those of a window
# that feels immediate: half of the pictures within 50 ms, 95 of 100 within 90 ms, with a slider 95 of 100 within 120 ms. After
# single edits the first clean picture, a coarse one, is there within 250 ms.
. "$(dirname "$0")/_lib.sh"

# drag STEP: by as many pixels a move, to and fro. One process sends all moves, so that they come evenly.
drag() {
  local moves=() step
  for step in $(seq 1 300); do
    moves+=(mousemove_relative -- $((step % 60 < 30 ? $1 : -$1)) $((step % 20 < 10 ? 1 : -1)) sleep 0.0167)
  done
  press 1
  xdotool "${moves[@]}"
  release 1
}
# latency KIND MEDIAN MOST LEAST: the log's "latency camera n 123 p50 43.1 p95 52.4 …" has at least so many pictures within these.
latency() {
  local count median most
  read -r count median most < <(awk -v kind="$1" '$1 == "latency" && $2 == kind { print $4, $6, $8 }' log)
  echo "$scene, $1: $count pictures, half within $median ms, 95 % within $most ms"
  compares "$count >= $4 && $median <= $2 && $most <= $3" || fail "$scene, $1: slower than its limits"
}

rm -r "$XDG_CONFIG_HOME" # as on a first start: with the clean view
for pair in 'showroom gold.fuzz' 'cornell-smoke -'; do
  read -r scene slider <<<"$pair"
  open_window "$scene"
  sends 1 '^size 1280 720$' xdotool windowsize "$window" 1280 720
  point picture 50 50
  drag 4
  if [ "$slider" != - ]; then
    point "$slider" 50
    drag 2
  fi
  point picture 50 50
  for edit in $(seq 1 40); do # single edits, with a clean picture after each
    lines=$(here)
    xdotool click $((edit % 2 == 0 ? 4 : 5))
    wait_for '^submit' "$lines"
    sleep 1.5
  done
  finish
  latency camera 50 90 60
  [ "$slider" = - ] || latency other 120 120 60
  latency clean 250 250 40
done
