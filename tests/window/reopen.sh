#!/usr/bin/env bash
# A snapshot that is opened again goes on: the EXR from the samples that it has, to the same bits as if it had never been
# closed; the PNG starts over and says so.
. "$(dirname "$0")/_lib.sh"

write_scene scene.json 0.3 8
start scene.json
settle
lines=$(here)
chord ctrl p
wait_for '^saved .*scene-001' "$lines"
finish
start scene-001.exr --set /render/spp=24
wait_for '^message opened scene-001.exr; it goes on from 8 spp'
settle
lines=$(here)
chord ctrl p
wait_for '^saved .*scene-002' "$lines"
finish
"$tyndall" render scene.json --spp 24 -q -o whole.exr
"$tyndall" compare scene-002.exr whole.exr --max-rmse 0 || fail "the reopened picture is not that of one render"
start scene-001.png
wait_for '^message opened scene-001.png; it starts over'
finish
