#!/usr/bin/env bash
# The clean view: on at first, key N, beside the raw picture, labelled with both errors, and remembered.
. "$(dirname "$0")/_lib.sh"
rm -r "$XDG_CONFIG_HOME" # as on a first start

write_scene scene.json 0.3 64
sed -i 's/"integrator": "path", "sampler": "random"/"integrator": "mis"/' scene.json
start scene.json
settle
has_value image.clean.on on || fail "the clean view is off at the first start"
grep -q '^edit' log && fail 'something was edited'
edits=$(submits)

lines=$(here)
key n
wait_for '^widget image.clean.off .* on' "$lines"
settle
lines=$(here)
chord shift n
wait_for '^widget image.clean.beside_raw .* on' "$lines"
wait_for '^widget split.b .*clean   64 spp   est. error' "$lines"
value split.a | grep -q '^raw   64 spp   est. error' || fail "the left half is $(value split.a)"
lines=$(here)
click image.clean.off
wait_for '^gone divider' "$lines"
settle
[ "$(submits)" = "$edits" ] || fail 'the clean view started something over'
finish

start scene.json
settle
has_value image.clean.off on || fail 'that the clean view is off was not remembered'
finish
