#!/usr/bin/env bash
# Two settings side by side: the left one stays, the right one changes, a divider between them, equal seconds for both.
. "$(dirname "$0")/_lib.sh"

write_scene scene.json 0.3 100000
tasks() { find "/proc/$pid/task" -mindepth 1 -maxdepth 1 | wc -l; }

# The difference of the halves' seconds, over the last line that tells both.
lead() { grep '^halves' log | tail -1 | awk '{ d = $3 - $5; print (d < 0 ? -d : d) }'; }

for threads in 2 1; do
  start scene.json --threads "$threads"
  before=$(tasks)
  click render.split.on
  wait_for '^widget split.a .*path · random'
  lines=$(here)
  click render.integrator.mis
  wait_for '^widget split.b .*mis · random   [0-9]+ spp' "$lines"
  wait_for '^accuracy B against A: relMSE [0-9.e-]+ · FLIP' "$lines"
  value split.a | grep -q '^path · random' || fail "the left half is $(value split.a)"
  sleep 3
  python3 -c "import sys; sys.exit(not $(lead) < 1.2)" || fail "$(grep '^halves' log | tail -1), $threads threads"
  grep '^halves' log | tail -1

  # The divider is dragged, the camera is not.
  edits=$(submits)
  lines=$(here)
  point divider 50 30
  wait_for '^cursor divider' "$lines"
  xdotool mousedown 1
  for way in 1 2 3 4 5 6; do
    xdotool mousemove_relative -- -30 3
    sleep 0.08
  done
  sleep 0.4
  xdotool mouseup 1
  xdotool mousemove 5 5
  wait_for '^cursor plain' "$lines"
  # shellcheck disable=SC2046
  set -- $(grep '^widget divider' log | head -1) $(grep '^widget divider' log | tail -1)
  moved=$(($3 - $9))
  [ "$moved" -gt 170 ] && [ "$moved" -lt 190 ] || fail "the divider moved by $moved instead of 180"
  [ "$(submits)" = "$edits" ] || fail 'dragging the divider moved the camera'

  # The difference as a picture, without a divider.
  lines=$(here)
  key 8
  wait_for '^gone divider' "$lines"
  lines=$(here)
  key 1
  wait_for '^widget divider' "$lines"

  # Both curves are exported.
  lines=$(here)
  click chart.export
  wait_for '^saved' "$lines"
  for name in 'A: path · random' 'B: mis · random'; do
    grep -q "^$name," scene-chart-*"$((3 - threads)).csv" || fail "no curve $name"
  done

  lines=$(here)
  click render.split.off
  wait_for '^gone split.a' "$lines"
  sleep 1
  [ "$(tasks)" -le "$((before + 1))" ] || fail "$(tasks) threads are left of $before"
  finish
done
