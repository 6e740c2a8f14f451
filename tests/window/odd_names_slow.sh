#!/usr/bin/env bash
# Names that hold anything, of the scene's file, of objects and materials: each stands in one line, in the title too, and
# saving writes them as they were.
. "$(dirname "$0")/_lib.sh"

file=$'odd\n\x1b[31m\xff %s ##x.json'
python3 - "$file" <<'SCENE'
import json, os, sys
odd = "line\nfeed \u0001\u001b[31m \u2028 %s ## ### " + "ä" * 300
scene = {"tyndall": 1, "name": odd, "image": {"width": 320, "height": 200}, "camera": {"look_from": [0, 0, 4], "look_at": [0, 0, 0], "vfov": 40},
         "background": [1, 1, 1], "textures": {odd: {"type": "solid", "color": [0.5, 0.5, 0.5]}},
         "materials": {odd: {"type": "lambertian", "albedo": odd}},
         "objects": [{"name": odd, "type": "sphere", "center": [0, 0, 0], "radius": 1, "material": odd}]}
json.dump(scene, open(os.fsencode(sys.argv[1]), "w"))
SCENE
start "$file"
settle
click picture 50 50
wait_for '^widget picture .* Line\\nfeed \\u0001\\u001b\[31m \\u2028 %s ## ### ä'
wait_for '^widget section.Line\\nfeed_'
title=$(xdotool getwindowname "$(xdotool search --onlyvisible --pid "$pid" | tail -1)")
[ "$title" = 'odd\n\u001b[31m\xff %s ##x.json – Tyndall' ] || fail "the title is $title"
chord ctrl p
wait_for '^message .*saved odd\\n'
for image in ./odd*-001.png ./odd*-001.exr; do
  "$tyndall" convert "$image" -o back.json
  python3 - "$file" <<'SCENE' || fail "$image: other names come back"
import json, os, sys
a, b = json.load(open(os.fsencode(sys.argv[1]))), json.load(open("back.json"))
assert all(a[key] == b[key] for key in ("name", "textures", "materials")) and a["objects"][0]["name"] == b["objects"][0]["name"]
SCENE
done
finish
