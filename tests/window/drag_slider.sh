#!/usr/bin/env bash
# Drags the fuzz slider, sees the picture change, saves a snapshot that opens as the edited scene, closes cleanly.
. "$(dirname "$0")/_lib.sh"

write_scene scene.json 0.05
start scene.json
settle
before=$(on_screen picture mean)
point gold.fuzz 20
press 1
wait_for '^submit 2'
for across in 25 40 55 70 85; do point gold.fuzz $across; done
release 1
settle
fuzz=$(value gold.fuzz)
compares "0.8 < $fuzz && $fuzz < 0.9" || fail "fuzz is $fuzz"
grep -qE '^frame [0-9]+ 16 ' log || fail 'the edited picture is not finished'
picture_changed() { [ "$(on_screen picture mean)" != "$before" ]; }
wait_until picture_changed

# Undo takes a whole drag back at once.
chord ctrl z
wait_until has_value gold.fuzz 0.05
chord ctrl shift z
wait_until has_value gold.fuzz "$fuzz"
settle
chord ctrl p
wait_for '^saved .*scene-001'
"$tyndall" convert scene-001.png -o back.json
grep -q "\"fuzz\": *$fuzz" back.json || fail "the snapshot holds another scene: $(grep fuzz back.json)"
finish
