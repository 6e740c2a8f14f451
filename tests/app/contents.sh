#!/usr/bin/env bash
# What a picture is made of includes the pixels of its textures and its sky: where their files have changed since, each
# command does what it does for a changed scene. The same pixels under another name or stored otherwise are the same.
. "$(dirname "$0")/_common.sh"
has_exr || finish

python3 - <<'PY'
import struct, zlib
def png(name, grey, level=9):
    def chunk(tag, data):
        return struct.pack(">I", len(data)) + tag + data + struct.pack(">I", zlib.crc32(tag + data))
    rows = (b"\0" + bytes([grey] * 6)) * 2
    open(name, "wb").write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", 2, 2, 8, 2, 0, 0, 0)) +
                           chunk(b"IDAT", zlib.compress(rows, level)) + chunk(b"IEND", b""))
png("grey.png", 100), png("white.png", 255), png("again.png", 100, 0)
for name, light in ("dim.pfm", 0.5), ("bright.pfm", 1):
    open(name, "wb").write(b"PF\n2 1\n-1.0\n" + struct.pack("<6f", *[light] * 6))
PY
cmp -s grey.png again.png && fail 'again.png is the same file as grey.png'

# scene TEXTURE SKY: a quad with a texture beneath a sky.
scene() {
  cat <<JSON
{ "tyndall": 1, "image": { "width": 8, "height": 8 }, "camera": { "vfov": 40 },
  "background": { "type": "image", "file": "$2" },
  "textures": { "t": { "type": "image", "file": "$1" } }, "materials": { "m": { "type": "lambertian", "albedo": "t" } },
  "objects": [{ "type": "quad", "corner": [-9, -1, -9], "u": [18, 0, 0], "v": [0, 0, 18], "material": "m" }] }
JSON
}
scene t.png sky.pfm >tex.json
old() { cp grey.png t.png && cp dim.pfm sky.pfm; }
new() { case $1 in texture) cp white.png t.png ;; sky) cp bright.pfm sky.pfm ;; esac }
# unlabelled FILE...: makes films and pictures say nothing of pixels, as those of version 0.2.0.
unlabelled() { python3 - "$@" <<'PY'
import re, struct, sys
for name in sys.argv[1:]:
    data = open(name, "rb").read()
    data = data.replace(b"tyndall:contents", b"another:contents").replace(b"tyndall:checksum", b"another:checksum")
    at = data.find(b"iTXtanother:contents")
    if at >= 0:
        data = data[:at - 4] + data[at + 8 + struct.unpack(">I", data[at - 4:at])[0]:]
    open(name, "wb").write(data)
PY
}
render() { "$tyndall" render tex.json -q "$@"; }
animate() { "$tyndall" animate tex.json --turntable --frames 2 --spp 4 -q -o "$@"; }
sweep() { "$tyndall" sweep tex.json --vary "/camera/vfov=[30,40]" --spp 4 -q --each 'v%v.exr' "$@"; }
other='other pixels in its textures or sky'
silent='does not say which pixels its textures and sky had; those of now are taken'

for what in texture sky; do
  old
  "$tyndall" render tex.json -q --spp 400000 --threads 1 --checkpoint 0 -o a.exr &
  wait_worked $! 0.3
  kill -INT $! && wait $!
  expect 0 render --samples 0:4 -o first.exr
  expect 0 animate 'f%d.png'
  expect 0 animate 'f%d.ppm' -o film.y4m
  expect 0 sweep :quiet
  new "$what"
  expect 2 render --spp 400000 -o a.exr :: a.exr "$other" '--fresh'
  expect 2 render --spp 8 --resume -o first.exr :: first.exr "$other" '--fresh'
  expect 0 render --samples 4:8 -o second.exr
  expect 2 "$tyndall" merge first.exr second.exr -o sum.exr :: second.exr "$other" 'as in first.exr'
  expect 2 animate 'f%d.png' :: f0.png "$other" '--fresh'
  expect 2 animate 'f%d.ppm' :: f0.ppm 'another scene' '--fresh'
  expect 2 animate film.y4m :: film.y4m '--fresh'
  expect 2 sweep :: v30.exr "$other" '--fresh'
  expect 0 "$tyndall" denoise first.exr -o clean.pfm :: first.exr 'its textures or sky have other pixels now'
  for snapshot in f0.png first.exr; do
    expect 0 "$tyndall" render "$snapshot" --spp 4 -q -o snapshot.pfm
    complains "$snapshot" 'its textures or sky have other pixels now than when the picture was made'
  done
  expect 0 animate 'f%d.png' --fresh
  expect 0 animate 'f%d.ppm' --fresh
  expect 0 sweep --fresh
  rm -f ./*.exr ./*.list f?.p?m f?.png film.y4m
done

# A finished film of other pixels is replaced, as one of another scene is.
old
expect 0 render --spp 4 -o a.exr
new texture
expect 0 render --spp 4 -o a.exr -o a.pfm :quiet
expect 0 render --spp 4 -o now.pfm
cmp -s a.pfm now.pfm || fail 'a finished film of other pixels was taken'

# The same pixels agree: under another name, stored otherwise, of a file that is there no more.
old
expect 0 render --samples 0:4 -o first.exr
cp again.png t.png
expect 0 render --samples 4:8 -o second.exr
scene again.png sky.pfm >tex.json
new texture
expect 0 render --samples 8:12 -o third.exr
expect 0 "$tyndall" merge third.exr first.exr second.exr -o sum.exr -o sum.pfm :quiet
expect 0 render --spp 12 -o whole.pfm
cmp -s sum.pfm whole.pfm || fail 'parts of equal pixels differ from one render'
expect 0 render --spp 20 --resume -o sum.exr :quiet
scene t.png sky.pfm >tex.json

# Films and pictures of version 0.2.0, which say nothing of pixels, are taken, and told.
old
expect 0 render --samples 0:4 -o first.exr
expect 0 render --samples 4:8 -o second.exr
expect 0 "$tyndall" animate tex.json --turntable --frames 1 --spp 4 -q -o 'f%d.png'
unlabelled first.exr f0.png
expect 0 render --spp 6 --resume -o first.exr :: "first.exr: $silent"
expect 0 render --samples 0:4 -o first.exr
unlabelled first.exr
expect 0 "$tyndall" merge second.exr first.exr -o sum.exr :: "first.exr: $silent"
expect 0 "$tyndall" denoise first.exr -o clean.pfm :: "first.exr: $silent"
expect 0 "$tyndall" render f0.png -q -o snapshot.pfm :: "f0.png: $silent"
expect 0 "$tyndall" animate tex.json --turntable --frames 1 --spp 4 -q -o 'f%d.png'
grep -qF "f0.png: $silent" err || fail "a frame of version 0.2.0: $(cat err)"

# Where there are no pictures, nothing is written and nothing said.
expect 0 "$tyndall" render cornell-box --size 8x8 --spp 2 -q -o box.png -o box.exr
grep -qa 'tyndall:contents' box.png box.exr && fail 'a hash of no pictures'
expect 0 "$tyndall" render box.png -q -o again.pfm
expect 0 "$tyndall" denoise box.exr -o again.pfm :quiet

finish
