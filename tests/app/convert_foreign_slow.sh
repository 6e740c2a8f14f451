#!/usr/bin/env bash
# convert for other renderers: the conventions, by following rays through what was written as those renderers read it; what
# has no equal; names that would like to be statements.
. "$(dirname "$0")/_common.sh"
foreign=$source_root/tests/app/_foreign.py
cat >scene.json <<'JSON'
{ "tyndall": 1, "name": "a test", "image": { "width": 40, "height": 24 },
  "camera": { "look_from": [1, 2, 7], "look_at": [0.2, 0.8, 0], "vup": [0.1, 1, 0], "vfov": 50, "defocus_angle": 0.3 },
  "background": { "type": "gradient", "bottom": [1, 1, 1], "top": [0.5, 0.7, 1.0] },
  "materials": { "grey": { "type": "lambertian", "albedo": [0.5, 0.5, 0.5] }, "glass": { "type": "dielectric", "refractive_index": 1.5 },
                 "lamp": { "type": "light", "radiance": [4, 4, 4] } },
  "objects": [
    { "type": "sphere", "center": [0, 0, 0], "radius": 30, "material": "grey" },
    { "type": "quad", "corner": [-9, 0, -9], "u": [0, 0, 18], "v": [18, 0, 0], "material": "grey" },
    { "type": "sphere", "center": [1.5, 1, 1], "radius": 1, "material": "glass" },
    { "type": "sphere", "center": [1.5, 1, 1], "radius": -0.9, "material": "glass" },
    { "type": "quad", "corner": [-2, 3, -3], "u": [1, 0, 0], "v": [0, 1, 1], "material": "lamp" },
    { "type": "group", "transform": [{ "translate": [-1.5, 0, 0] }], "objects": [
      { "type": "box", "min": [-1, 0, -1], "max": [1, 1.5, 0.5], "material": "grey", "transform": [{ "rotate_y": 30 }, { "translate": [0, 0, 0.5] }] } ] },
    { "type": "triangle", "corner": [-3, 0.5, 2], "u": [1.5, 0, 0.5], "v": [0.2, 1.8, 0], "material": "grey" },
    { "type": "disk", "center": [0, 2.2, 1], "u": [0, 0.8, 0.6], "v": [1, 0, 0], "material": "grey", "transform": [{ "rotate_y": 20 }] },
    { "type": "triangle", "corner": [2, 3, -3], "u": [1, 0, 0], "v": [0, 1, 1], "material": "lamp" },
    { "type": "disk", "center": [0.5, 3.6, -3], "u": [0.5, 0, 0], "v": [0, 0.5, 0], "material": "lamp" },
    { "type": "sphere", "center": [3, 3.5, -4], "radius": -0.5, "material": "lamp" },
    { "type": "sphere", "center": [-4, 3, -4], "radius": 0.4, "material": "lamp" },
    { "type": "medium", "boundary": { "type": "sphere", "center": [-1, 3, 1], "radius": 0.7 }, "density": 2, "albedo": [0.9, 0.8, 0.7], "g": 0.3 } ] }
JSON
expect 0 "$tyndall" render scene.json --spp 16 -q -o scene.exr
for ending in pbrt xml py; do
  expect 0 "$tyndall" convert scene.json -o "scene.$ending" :quiet
  python3 "$foreign" "scene.$ending" 40x24 "$ending.pfm" >log 2>&1 || fail "$ending: $(cat log)"
  grep -q " shapes, 1 inward, 5 lights" log || fail "$ending: $(cat log)"
  if has_exr; then
    expect 0 "$tyndall" compare "$ending.pfm" scene.exr:Depth.Z --json
    cp out "$ending.json"
    python3 -c '
import json, sys
found = json.load(open(sys.argv[1]))
sys.exit(not found["relmse"] < 0.03)' "$ending.json" || fail "$ending: the first surfaces lie elsewhere: $(cat "$ending.json")"
  fi
done
for ending in pbrt xml; do # the sky: bright and white below, blue above
  [ -s scene.$ending.sky.pfm ] || fail "no sky of $ending"
done
# Blender: versions that were not tried are not promised; names that newer ones lack are not used.
grep -q 'Blender 3.4 to 3.6' scene.py || fail 'the script does not say for which versions it is'
for gone in SHARP colorspace_settings images.load; do ! grep -q "$gone" scene.py || fail "the script uses $gone"; done
cat >lamp.json <<'JSON'
{ "tyndall": 1, "textures": { "warm": { "type": "solid", "color": [0.5, 0.25, 0.125] } },
  "materials": { "lamp": { "type": "light", "radiance": "warm" } },
  "objects": [{ "type": "sphere", "center": [0, 0, -2], "radius": 0.5, "material": "lamp" }] }
JSON
expect 0 "$tyndall" convert lamp.json -o lamp.pbrt
grep -qF '"rgb L" [ 0.5 0.25 0.125 ]' lamp.pbrt || fail "a lamp whose colour is a texture: $(grep Area lamp.pbrt)"
expect 0 "$tyndall" convert cornell-smoke -o smoke.pbrt
same 'media of pbrt' 2 "$(grep -c '^MakeNamedMedium' smoke.pbrt)"
grep -qF '"rgb sigma_a" [ 0.01 0.01 0.01 ] "rgb sigma_s" [ 0 0 0 ]' smoke.pbrt || fail 'black smoke scatters, or absorbs nothing'
expect 0 "$tyndall" convert cornell-smoke --set /image/width=300 -o upright.pbrt # half as wide as high: 2 atan(tan(20 degrees) / 2)
grep -qF '"float fov" 20.628' upright.pbrt || fail "the angle of an upright picture: $(grep fov upright.pbrt)"

# The eye in a medium: what lies outside of it stands in none.
sed 's/"center": \[-1, 3, 1\], "radius": 0.7/"center": [1, 2, 7], "radius": 0.7/' scene.json >eye.json
for ending in pbrt xml py; do
  expect 0 "$tyndall" convert eye.json -o "eye.$ending"
  python3 "$foreign" "eye.$ending" 40x24 eye.pfm >log 2>&1 || fail "the eye in a medium, $ending: $(cat log)"
done

# Skies and images are those that are seen here, whatever their files are: small, a layer of an EXR, with an EXPOSURE.
python3 - <<'PY'
import struct
def write(name, width, height, pixel):
    numbers = [c for y in reversed(range(height)) for x in range(width) for c in pixel(x, y)]
    open(name, "wb").write(b"PF\n%d %d\n-1\n" % (width, height) + struct.pack(f"<{len(numbers)}f", *numbers))
write("one.pfm", 1, 1, lambda x, y: (1, 2, 3))
write("few.pfm", 3, 2, lambda x, y: (x, 2 - 2 * y, 0.5 + x * y))
write("more.pfm", 24, 12, lambda x, y: (x / 24, y / 12, x * y / 288))
open("bright.hdr", "wb").write(b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\nEXPOSURE=4\n\n-Y 1 +X 1\n\x80\x40\x20\x81")
PY
skies='one.pfm few.pfm more.pfm bright.hdr'
has_exr && skies="$skies scene.exr:Albedo"
for sky in $skies; do
  cat >sky.json <<JSON
{ "tyndall": 1, "image": { "width": 1, "height": 1 }, "camera": { "look_from": [0, 0, 0], "look_at": [0.3, 0.8, -0.52], "vfov": 0.01 },
  "background": { "type": "image", "file": "$sky", "rotate_y": 35, "scale": 0.5 }, "objects": [] }
JSON
  expect 0 "$tyndall" render sky.json --spp 1 -q -o "sky-$sky.pfm"
  for ending in xml py; do expect 0 "$tyndall" convert sky.json -o "sky-$sky.$ending"; done
done
PYTHONPATH=$source_root/tests/app python3 -B - $skies <<'PY' || fail 'skies look otherwise there'
import struct, sys, _foreign
for sky in sys.argv[1:]:
    want = struct.unpack("<3f", open(f"sky-{sky}.pfm", "rb").read()[-12:])
    for read, ending in ((_foreign.read_xml, "xml"), (_foreign.read_script, "py")):
        found = read(open(f"sky-{sky}.{ending}").read(), 1.0).sky
        assert all(abs(a - b) < 1e-3 for a, b in zip(want, found)), (sky, ending, want, found)
PY

# What has no equal ends in one sentence that names it.
refused() { # FILE TEXT... CONVERT-ARGUMENTS are in $arguments
  expect 2 "$tyndall" convert "${arguments[@]}" -o "$1" :: "${@:2}" 'has no equal'
  [ ! -e "$1" ] || fail "$1 was written"
}
# A ring and an ellipse have equals in some.
for what in ring ellipse; do
  python3 - "$what" <<'PY'
import json, sys
scene = json.load(open("scene.json"))
disk = scene["objects"][7]
disk.update({"inner": 0.5} if sys.argv[1] == "ring" else {"v": [0.3, 1.5, 0]})
json.dump(scene, open(sys.argv[1] + ".json", "w"))
PY
  expect 0 "$tyndall" render "$what.json" --spp 16 -q -o "$what.exr"
  arguments=("$what.json")
  refused no.xml /objects "$what"
  endings='pbrt py'
  [ "$what" = ellipse ] && endings=py && refused no.pbrt /objects ellipse
  for ending in $endings; do
    expect 0 "$tyndall" convert "$what.json" -o "$what.$ending"
    python3 "$foreign" "$what.$ending" 40x24 "$what.pfm" >log 2>&1 || fail "$what, $ending: $(cat log)"
    ! cmp -s "$what.pfm" "$ending.pfm" || fail "$what, $ending: as without it"
    has_exr || continue
    expect 0 "$tyndall" compare "$what.pfm" "$what.exr:Depth.Z" --max-relmse 0.03
  done
done
python3 - <<'PY'
import json
scene = json.load(open("scene.json"))
scene["textures"] = {"map": {"type": "image", "file": "map.ppm"}}
scene["materials"]["grey"]["albedo"] = "map"
json.dump(scene, open("map.json", "w"))
open("map.ppm", "wb").write(b"P6 1 1 255\n\x80\x80\x80")
PY
python3 - <<'PY'
import json
scene = json.load(open("map.json"))
del scene["objects"][7]
json.dump(scene, open("round.json", "w"))
PY
for ending in pbrt py; do
  expect 0 "$tyndall" convert round.json -o "round.$ending"
  python3 "$foreign" "round.$ending" 40x24 round.pfm >log 2>&1 || fail "images, $ending: $(cat log)"
done
same 'images of pbrt' "$(grep -c '"string wrap" "clamp"' round.pbrt)" 2 # around spheres, and on what is flat
arguments=(map.json)
for ending in pbrt py; do refused "no.$ending" /objects 'an image on a disk'; done
sed 's/"type": "medium", "boundary": { "type": "sphere", "center": \[-1, 3, 1\], "radius": 0.7 }/"type": "medium", "boundary": { "type": "sphere", "center": [-4, 3, -4], "radius": 0.4 }/' scene.json >glowing.json
arguments=(glowing.json)
refused no.xml /objects 'a medium within a light'
sed 's/"grey": { "type": "lambertian", "albedo": \[0.5, 0.5, 0.5\]/"grey": { "type": "metal", "albedo": [1, 1, 1]/' scene.json >mirror.json
arguments=(mirror.json)
refused no.pbrt /materials/grey/type mirror
expect 0 "$tyndall" convert mirror.json -o mirror.xml

# Names are data, whatever they hold.
python3 - <<'PY'
import json
scene = json.load(open("scene.json"))
evil = ["\"\"\"\nimport os\nos.system('touch owned')\n\"\"\"", "'''\nraise SystemExit(3)\n'''", "\\\"\nWorldBegin\n# ",
        "--><scene/><!--", "]]>&amp;\"'<x>", "\\", "\u2028\u0000\u001b[31m\ud83d\ude00"]
scene["name"] = evil[0] + evil[3]
for k, name in enumerate(list(scene["materials"])):
    scene["materials"][evil[k] + name] = scene["materials"].pop(name)
    for thing in [*scene["objects"], *scene["objects"][5]["objects"]]:
        if thing.get("material") == name:
            thing["material"] = evil[k] + name
for k, thing in enumerate(scene["objects"]):
    thing["name"] = evil[k % len(evil)]
json.dump(scene, open("evil.json", "w"))
PY
name=$'x"""\'\'\'\nWorldBegin'
for ending in pbrt xml py; do
  expect 0 "$tyndall" convert evil.json -o "evil.$ending"
  expect 0 "$tyndall" convert evil.json -o "$name.$ending"
  for file in "evil.$ending" "$name.$ending"; do
    python3 "$foreign" "$file" 40x24 evil.pfm >log 2>&1 || fail "$ending: $(cat log)"
    cmp -s evil.pfm "$ending.pfm" || fail "$ending: names have changed the scene"
  done
done
[ ! -e owned ] || fail 'a name became a statement'
PYTHONPATH=$source_root/tests/app python3 -B - <<'PY' || fail 'the scripts differ by more than their data'
import _foreign
(evil, a), (plain, b) = (_foreign.data_of(open(f).read()) for f in ("evil.py", "scene.py"))
assert a == b and evil["shapes"] == plain["shapes"] and evil["name"] != plain["name"]
PY
same 'lines of pbrt' "$(wc -l <scene.pbrt)" "$(wc -l <evil.pbrt)"
same 'lines of Mitsuba' "$(wc -l <scene.xml)" "$(wc -l <evil.xml)"
finish
