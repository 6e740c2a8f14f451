#!/usr/bin/env bash
# What does not change the picture starts nothing over: exposure, tone map, views, a value set to itself, an idle
# window. What changes only how it is shown shows at once.
. "$(dirname "$0")/_lib.sh"

write_scene scene.json 0.3
start scene.json
settle
dark=$(brightness picture)

point image.exposure 50
press 1
for across in 55 60 65; do point image.exposure $across; done
release 1
brighter() { compares "$(brightness picture) > $dark + 10"; }
wait_until brighter
click image.tone_map.aces
for view in albedo normal depth noise samples cost beauty; do
  lines=$(here)
  click image.view.$view
  wait_for '^frame' "$lines"
done
lines=$(here)
key 3
wait_for '^widget image.view.normal .* on' "$lines"
key 7
wait_for '^widget image.view.cost .* on' "$lines"
key 1
wait_for '^widget image.view.beauty .* on' "$lines"

# The click alone, the same number typed, a number that is not valid.
click gold.fuzz.value
enter
type_value gold.fuzz.value 0.3
type_value gold.fuzz.value 0.300
lines=$(here)
type_value gold.fuzz.value 1.5
wait_for '^message fuzz: found 1.5, expected a number in \[0, 1\]' "$lines"
settle
[ "$(submits)" = 1 ] || fail "$(submits) submits instead of 1"
[ "$(value gold.fuzz)" = 0.3 ] || fail "fuzz is $(value gold.fuzz)"

# When the message has gone, nothing is drawn and nothing computed any more.
key Escape
move 6 6 # the key was released before
settle_without_message
lines=$(wc -l <log)
busy() { awk '{ print $14 + $15 }' "/proc/$pid/stat"; }
ticks=$(busy)
sleep 3 # not to wait for anything: the time that is looked at
[ "$(wc -l <log)" = "$lines" ] || fail "an idle window draws"
[ $(($(busy) - ticks)) -le 2 ] || fail "an idle window uses $(($(busy) - ticks)) ticks of 300"
finish
