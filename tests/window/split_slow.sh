#!/usr/bin/env bash
# Two settings side by side: the left one stays, the right one changes, a divider between them, and both go on.
# That they get equal seconds is tested with their renderers, and by the clock in timed_slow.sh.
. "$(dirname "$0")/_lib.sh"

write_scene scene.json 0.3 100000
tasks() { find "/proc/$pid/task" -mindepth 1 -maxdepth 1 | wc -l; }

# How often each half has got new samples since line $1 of the log.
both_go_on() {
  awk '$1 == "halves" { a += $3 > last_a; b += $5 > last_b; last_a = $3; last_b = $5 } END { exit a < 4 || b < 4 }' \
    < <(tail -n "+$1" log)
}

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
  wait_until both_go_on "$(here)"

  # The divider is dragged, the camera is not.
  edits=$(submits)
  lines=$(here)
  point divider 50 30
  wait_for '^cursor divider' "$lines"
  press 1
  read -r x y <<<"$(last_of mouse)"
  for way in 1 2 3 4 5 6; do move $((x - 30 * way)) $((y + 3 * way)); done
  release 1
  move 5 5
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

  # Leaving asks which half to keep; Esc keeps both.
  lines=$(here)
  click render.split.off
  wait_for '^widget dialog.a ' "$lines"
  cp "$screen/Xvfb_screen0" question.xwd
  key Escape
  wait_for '^gone dialog.a' "$lines"
  lines=$(here)
  click render.split.off
  wait_for '^widget dialog.a ' "$lines"
  click dialog.a
  wait_for '^gone split.a' "$lines"
  wait_until has_value render.integrator.path on
  threads_are_gone() { [ "$(tasks)" -le "$((before + 1))" ]; }
  wait_until threads_are_gone
  finish
done
