#!/usr/bin/env bash
# Figures by the clock, for a machine with nothing else to do: the first picture of a restart, and a window that rests.
. "$(dirname "$0")/_lib.sh"

write_scene scene.json 0.3 100000
for threads in 2 1; do
  start scene.json --threads "$threads"
  lines=$(here)
  key r
  wait_for '^frame 1 [1-9]' "$lines"
  first=$(awk '$1 == "frame" { ms = $6 } END { print ms }' log)
  compares "$first < 250" || fail "the first picture after a restart came after $first ms, $threads threads"
  echo "$threads threads: first picture after $first ms"
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
