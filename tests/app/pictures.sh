#!/usr/bin/env bash
# PPM files as output, reference, baseline and texture; and what files say of their pixels is heard.
. "$(dirname "$0")/_common.sh"
scene=(showroom --size 32x18 --spp 4 -q)

# PPM with the bytes of the PNG, by all commands that write pictures.
expect 0 "$tyndall" render "${scene[@]}" --exposure 1 -o a.png -o a.ppm
expect 0 "$tyndall" compare a.ppm a.png --max-rmse 0
expect 0 "$tyndall" render "${scene[@]}" --denoise -o clean.ppm
cmp -s clean.ppm a.ppm && fail 'the filtered PPM is the raw one'
if has_exr; then
  expect 0 "$tyndall" render "${scene[@]}" -o film.exr -o film.ppm
  expect 0 "$tyndall" merge film.exr -o merged.ppm
  cmp -s film.ppm merged.ppm || fail 'merge writes another PPM than render'
  expect 0 "$tyndall" denoise film.exr -o filtered.ppm
  cmp -s filtered.ppm clean.ppm || fail 'denoise writes another PPM than render --denoise'
fi
expect 0 "$tyndall" render "${scene[@]}" --gamma2 -o books.ppm
"$tyndall" render "${scene[@]}" --gamma2 -o - --format ppm >stream.ppm || fail 'a PPM to standard output'
cmp -s stream.ppm books.ppm || fail '--format ppm writes another PPM'
# The picture is clipped at 1; it agrees with itself only where it is read as it was written.
expect 0 "$tyndall" render "${scene[@]}" --exposure -3 --gamma2 -o dark.ppm
expect 0 "$tyndall" compare dark.ppm dark.ppm --gamma2 --max-rmse 0
expect 1 "$tyndall" compare dark.ppm books.ppm --gamma2 --max-rmse 0.05
expect 0 "$tyndall" compare books.ppm a.ppm --gamma2

# What files say of their pixels is told once: here numbers outside of the range.
printf 'P3\n# by hand\n2 1\n255\n256 -1 128\n-2147483648 0 255\n' >books3.ppm
printf 'P6 2 1 255\n\377\0\200\0\0\377' >same.ppm
expect 0 "$tyndall" compare books3.ppm same.ppm --max-rmse 0 :err '^tyndall: books3.ppm: 3 of 6 numbers are outside of 0 to 255'
same 'lines' 1 "$(wc -l <err)"

# Baselines.
mkdir new
cp books.ppm new
expect 0 "$tyndall" compare new --baseline base --update
expect 0 "$tyndall" compare new --baseline base --gamma2 --report report.html :out '^ok .*books.ppm'

# Textures are read with all of their bits, and what they say is told.
python3 - <<'FILES'
import struct, zlib
def chunk(kind, data): return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
primaries = struct.pack(">8I", 31270, 32900, 68000, 32000, 26500, 69000, 15000, 6000)
open("wide.png", "wb").write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", 1, 1, 8, 2, 0, 0, 0)) +
                             chunk(b"cHRM", primaries) + chunk(b"IDAT", zlib.compress(b"\0" + b"\x80" * 3)) + chunk(b"IEND", b""))
for name, low in (("low.ppm", b"\0"), ("high.ppm", b"\xff")): open(name, "wb").write(b"P6 1 1 65535\n" + (b"\x80" + low) * 3)
FILES
for file in low.ppm high.ppm wide.png; do
  cat >scene.json <<JSON
{ "tyndall": 1, "image": { "width": 4, "height": 4 }, "background": [1, 1, 1],
  "camera": { "look_from": [0, 0, 2], "look_at": [0, 0, 0] }, "render": { "max_depth": 2 },
  "textures": { "t": { "type": "image", "file": "$file" } },
  "materials": { "m": { "type": "lambertian", "albedo": "t" } },
  "objects": [{ "type": "quad", "corner": [-3, -3, 0], "u": [6, 0, 0], "v": [0, 6, 0], "material": "m" }] }
JSON
  expect 0 "$tyndall" render scene.json --spp 4 -q -o $file.pfm
  [ $file = wide.png ] || [ ! -s err ] || fail "standard error: $(cat err)"
done
same 'lines' 1 "$(grep -c 'wide.png: its primaries (cHRM)' err)"
expect 1 "$tyndall" compare low.ppm.pfm high.ppm.pfm --max-rmse 0.001
expect 0 "$tyndall" compare wide.png low.ppm :err 'wide.png: its primaries (cHRM)'

no_leftovers
finish
