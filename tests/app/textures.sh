#!/usr/bin/env bash
# Image textures: where they end, and alpha channels, which are not looked at.
. "$(dirname "$0")/_common.sh"

# columns.png: red, green, green, blue; alpha.png: the same, its green ones hidden. PNG with one row, no library needed.
python3 - <<'PY'
import struct, zlib
def png(name, kind, row):
    def chunk(tag, data):
        return struct.pack(">I", len(data)) + tag + data + struct.pack(">I", zlib.crc32(tag + data))
    open(name, "wb").write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", 4, 1, 8, kind, 0, 0, 0)) +
                           chunk(b"IDAT", zlib.compress(b"\0" + bytes(row))) + chunk(b"IEND", b""))
red, green, blue = [255, 0, 0], [0, 255, 0], [0, 0, 255]
png("columns.png", 2, red + green + green + blue)
png("alpha.png", 6, red + [255] + green + [0] + green + [0] + blue + [255])
PY

# scene FILE PICTURE OBJECT: a white sky over an object that fills the picture of 64 x 64 pixels.
scene() {
  cat >"$1" <<JSON
{ "tyndall": 1, "image": { "width": 64, "height": 64 }, "background": [1, 1, 1], "render": { "max_depth": 1 },
  "camera": { "look_from": [0, 0, 3], "look_at": [0, 0, 0], "vfov": 53.13010235415598 },
  "textures": { "t": { "type": "image", "file": "$2" } }, "materials": { "m": { "type": "lambertian", "albedo": "t" } },
  "objects": [ $3 ] }
JSON
}
quad='{ "type": "quad", "corner": [-1, -1, 1], "u": [2, 0, 0], "v": [0, 2, 0], "material": "m" }'
box='{ "type": "box", "min": [-1, -1, -1], "max": [1, 1, 1], "material": "m" }'
turned='{ "type": "box", "min": [-1, -1, -1], "max": [1, 1, 1], "material": "m", "transform": [{ "rotate_y": 90 }] }'
lamp='{ "type": "quad", "corner": [-1, -1, 1], "u": [2, 0, 0], "v": [0, 2, 0], "material": "m" }'

# edges FILE.pfm: fails unless half a texel at each side has the colour of its own edge alone.
edges() {
  python3 - "$1" <<'PY' || fail "$2"
import struct, sys
pixels = open(sys.argv[1], "rb").read().split(b"\n", 3)[3]
for x in range(64):
    red, green, blue = struct.unpack_from("<3f", pixels, 12 * (32 * 64 + x))
    assert x > 7 or (red > 0.5 and green == 0 and blue == 0), (x, red, green, blue)
    assert x < 56 or (blue > 0.5 and green == 0 and red == 0), (x, red, green, blue)
    assert not 8 <= x < 56 or red == 0 or blue == 0, (x, red, green, blue)
PY
}
for isa in scalar sse4 avx2 avx512; do
  "$tyndall" render showroom --size 8x8 --spp 1 --isa "$isa" -q -o probe.pfm 2>/dev/null || continue
  for object in quad box turned; do
    scene "$object.json" columns.png "${!object}"
    expect 0 "$tyndall" render "$object.json" --spp 8 --isa "$isa" -q -o "$object.pfm"
    edges "$object.pfm" "$object by $isa: its edges are mixed"
  done
  scene lamp.json columns.png "$lamp"
  expect 0 "$tyndall" render lamp.json --set '/materials/m={"type":"light","radiance":"t"}' --spp 8 --isa "$isa" -q -o lamp.pfm
  edges lamp.pfm "a lamp by $isa: its edges are mixed"
done

# What the clean view and a replay know of the surface is the same colour.
expect 0 "$tyndall" render quad.json --replay 2,32,0
grep -Eq 'm .*\(?1 0 0|colour +1 0 0|throughput +1 0 0' out || fail "a replay at the left edge: $(cat out)"
if has_exr; then
  expect 0 "$tyndall" render quad.json --spp 8 -q -o quad.exr
  expect 0 "$tyndall" compare quad.exr:Albedo quad.pfm --json --max-rmse 0.01
fi

# Alpha: one line when it is loaded, one in inspect; none for pictures without.
scene alpha.json alpha.png "$quad"
expect 0 "$tyndall" render alpha.json --spp 8 -q -o alpha.pfm
grep -qxF 'tyndall: alpha.json: texture "t" has an alpha channel, which is not looked at: what is hidden beneath it is shown' err ||
  fail "no word of the alpha channel: $(cat err)"
cmp -s alpha.pfm quad.pfm || fail 'an alpha channel changes the picture'
expect 0 "$tyndall" render quad.json --spp 8 -q -o quad.pfm :quiet
expect 0 "$tyndall" inspect alpha.json
same 'lines about alpha' 1 "$(grep -c 'texture "t" has an alpha channel' out)"
[ ! -s err ] || fail "standard error of inspect: $(cat err)"
expect 0 "$tyndall" inspect alpha.json --json
same 'textures with alpha' '["t"]' "$(json out textures_with_alpha)"
expect 0 "$tyndall" inspect quad.json
! grep -q alpha out || fail 'alpha where there is none'

finish
