#!/usr/bin/env bash
# PPM files as output, reference, baseline and texture; and what files say of their pixels is heard.
. "$(dirname "$0")/_common.sh"
scene=(showroom --size 32x18 --spp 4 -q)

# P6 with the bytes of the PNG, dithered and not, raw and filtered.
for dither in on off; do
  expect 0 "$tyndall" render "${scene[@]}" --exposure 1 --dither $dither -o a.png -o a.ppm
  same "the header" 'P6 32 18 255' "$(head -c 13 a.ppm | tr '\n' ' ' | sed 's/ $//')"
  expect 0 "$tyndall" compare a.ppm a.png --max-rmse 0
  cp a.ppm $dither.ppm
done
cmp -s on.ppm off.ppm && fail 'PPM is not dithered'
expect 0 "$tyndall" render "${scene[@]}" --denoise -o clean.png -o clean.ppm
expect 0 "$tyndall" compare clean.ppm clean.png --max-rmse 0
cmp -s clean.ppm a.ppm && fail 'the filtered PPM is the raw one'
if has_exr; then
  expect 0 "$tyndall" render "${scene[@]}" -o film.exr -o film.ppm
  expect 0 "$tyndall" merge film.exr -o merged.ppm
  cmp -s film.ppm merged.ppm || fail 'merge writes another PPM than render'
  expect 0 "$tyndall" denoise film.exr -o filtered.ppm
  cmp -s filtered.ppm clean.ppm || fail 'denoise writes another PPM than render --denoise'
fi

# --gamma2: the books' bytes, from the very numbers of the PFM.
expect 0 "$tyndall" render "${scene[@]}" --gamma2 -o books.ppm -o books.pfm
python3 - <<'CHECK' || fail '--gamma2 does not write the bytes of the books'
import math, struct
ppm = open("books.ppm", "rb").read().split(b"\n", 3)[3]
light = struct.unpack("<%df" % (3 * 32 * 18), open("books.pfm", "rb").read().split(b"\n", 3)[3])
rows = [light[96 * y:96 * y + 96] for y in range(17, -1, -1)]
assert list(ppm) == [int(256 * min(math.sqrt(max(v, 0)), 0.999)) for row in rows for v in row]
CHECK
"$tyndall" render "${scene[@]}" --gamma2 -o - --format ppm >stream.ppm || fail 'a PPM to standard output'
cmp -s stream.ppm books.ppm || fail '--format ppm writes another PPM'
# The picture is clipped at 1; it agrees with itself only where it is read as it was written.
expect 0 "$tyndall" render "${scene[@]}" --exposure -3 --gamma2 -o dark.ppm
expect 0 "$tyndall" compare dark.ppm dark.ppm --gamma2 --max-rmse 0
expect 1 "$tyndall" compare dark.ppm books.ppm --gamma2 --max-rmse 0.05
expect 0 "$tyndall" compare books.ppm on.ppm --gamma2

# P3, as the books' programs print it: numbers outside of the range are counted in one line.
printf 'P3\n# by hand\n2 1\n255\n256 -1 128\n-2147483648 0 255\n' >books3.ppm
printf 'P6 2 1 255\n\377\0\200\0\0\377' >same.ppm
expect 0 "$tyndall" compare books3.ppm same.ppm --max-rmse 0
same 'lines' 1 "$(wc -l <err)"
grep -q '^tyndall: books3.ppm: 3 of 6 numbers are outside of 0 to 255' err || fail "they are not counted: $(cat err)"

# Baselines.
mkdir new
cp books.ppm new
expect 0 "$tyndall" compare new --baseline base --update
expect 0 "$tyndall" compare new --baseline base --gamma2 --report report.html :out '^ok .*books.ppm'

# Textures, 16-bit ones too, and what is told of them.
texture() {
  cat >scene.json <<JSON
{ "tyndall": 1, "image": { "width": 4, "height": 4 }, "background": [1, 1, 1],
  "camera": { "look_from": [0, 0, 2], "look_at": [0, 0, 0] }, "render": { "max_depth": 2 },
  "textures": { "t": { "type": "image", "file": "$1" } },
  "materials": { "m": { "type": "lambertian", "albedo": "t" } },
  "objects": [{ "type": "quad", "corner": [-3, -3, 0], "u": [6, 0, 0], "v": [0, 6, 0], "material": "m" }] }
JSON
}
python3 - <<'FILES'
import struct, zlib
def chunk(kind, data): return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
def png(name, bits, row, more=b""):
    head = struct.pack(">IIBBBBB", 1, 1, bits, 2, 0, 0, 0)
    open(name, "wb").write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + more + chunk(b"IDAT", zlib.compress(b"\0" + row)) + chunk(b"IEND", b""))
png("low.png", 16, b"\x80\0" * 3)
png("high.png", 16, b"\x80\xff" * 3)
png("linear.png", 8, b"\x80" * 3, chunk(b"gAMA", struct.pack(">I", 100000)))
png("wide.png", 8, b"\x80" * 3, chunk(b"cHRM", struct.pack(">8I", 31270, 32900, 68000, 32000, 26500, 69000, 15000, 6000)))
open("high.ppm", "wb").write(b"P6 1 1 65535\n" + b"\x80\xff" * 3)
FILES
for file in low.png high.png high.ppm linear.png wide.png; do
  texture $file
  expect 0 "$tyndall" render scene.json --spp 4 -q -o $file.pfm
  [ $file = wide.png ] || [ ! -s err ] || fail "standard error: $(cat err)"
done
same 'lines' 1 "$(grep -c 'wide.png: its primaries (cHRM)' err)"
cmp -s high.png.pfm high.ppm.pfm || fail 'a texture as PPM is another one than as PNG'
expect 1 "$tyndall" compare low.png.pfm high.png.pfm --max-rmse 0.001 # all 16 bits count
expect 0 "$tyndall" compare linear.png.pfm high.png.pfm
python3 - <<'CHECK' || fail 'gAMA of a texture is passed over'
import struct
red = lambda name: struct.unpack("<f", open(name, "rb").read().split(b"\n", 3)[3][:4])[0]
assert abs(red("linear.png.pfm") / red("high.png.pfm") - 128 / 255 / 0.217667) < 0.01
CHECK
expect 0 "$tyndall" compare wide.png linear.png :err 'wide.png: its primaries (cHRM)'

no_leftovers
finish
