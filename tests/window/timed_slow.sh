#!/usr/bin/env bash
# Figures by the clock, for a machine with nothing else to do: equal seconds in a split view, the first picture of a
# restart, and a window that rests. The quick tests see to the same without a clock.
. "$(dirname "$0")/_lib.sh"

write_scene scene.json 0.3 100000
for threads in 2 1; do
  start scene.json --threads "$threads"
  lines=$(here)
  key r
  wait_for '^frame 1 [1-9]' "$lines"
  first=$(awk '$1 == "frame" { ms = $6 } END { print ms }' log)
  compares "$first < 250" || fail "the first picture after a restart came after $first ms, $threads threads"
  click render.split.on
  click render.integrator.mis
  wait_for '^widget split.b .*mis · random   [0-9]+ spp'
  sleep 3 # the time in which one half may get ahead
  # The difference of the halves' seconds, over the last line that tells both.
  lead=$(awk '$1 == "halves" { d = $3 - $5 } END { print d < 0 ? -d : d }' log)
  compares "$lead < 1.2" || fail "$(grep '^halves' log | tail -1), $threads threads"
  echo "$threads threads: first picture after $first ms, halves $lead s apart"
  finish
done

# When the message has gone, nothing is drawn and nothing computed any more.
write_scene rest.json 0.3
start rest.json
move 6 6
settle_without_message
lines=$(wc -l <log)
busy() { awk '{ print $14 + $15 }' "/proc/$pid/stat"; }
ticks=$(busy)
sleep 3
[ "$(wc -l <log)" = "$lines" ] || fail "an idle window draws"
[ $(($(busy) - ticks)) -le 2 ] || fail "an idle window uses $(($(busy) - ticks)) ticks of 300"
finish
