#!/usr/bin/env bash
# Adaptive sampling is a setting of the render: switching it starts over, once; undo takes it back.
. "$(dirname "$0")/_lib.sh"

write_scene scene.json 0.3 40
start scene.json
settle
[ "$(submits)" = 1 ] || fail "$(submits) submits instead of 1"
lines=$(here)
click render.adaptive.on
wait_for '^widget render.adaptive.on .* on' "$lines"
wait_for '^frame 2 40 ' "$lines"
settle
click render.adaptive.on
settle
[ "$(submits)" = 2 ] || fail "$(submits) submits instead of 2"
lines=$(here)
chord ctrl z
wait_for '^widget render.adaptive.off .* on' "$lines"
wait_for '^frame 3 40 ' "$lines"
finish
