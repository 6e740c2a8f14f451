#!/usr/bin/env bash
# --spp, --time and --target-error: where the picture pauses by itself; an edit or Space goes on.
. "$(dirname "$0")/_lib.sh"

write_scene scene.json 0.2 0
sed -i 's/"spp": 0, //' scene.json
start scene.json --target-error 0.2
wait_for '^message paused at the error'
wait_for '^state paused$'
lines=$(here)
type_value gold.fuzz.value 0.4
wait_for '^state rendering$' "$lines"
wait_for '^message paused at the error' "$lines"
lines=$(here)
key space
wait_for '^state rendering$' "$lines"
finish

start scene.json --time 0.5
wait_for '^message paused at the time limit'
finish

start scene.json --spp 3
wait_for '^state finished$'
wait_for '^frame 1 3 '
finish

# Without a limit a picture that is black at first is no picture without error: it goes on until its lamp is found.
start stress-small-light --integrator path --spp 40
wait_for '^state finished$'
wait_for '^frame 1 40 '
grep -q '^message paused' log && fail 'a black picture pauses at an error that nobody asked for'
finish
