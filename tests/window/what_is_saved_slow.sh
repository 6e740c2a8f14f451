#!/usr/bin/env bash
# What is seen is what is saved: at one screen pixel a pixel, the window shows the bytes of the snapshot, for each tone
# curve and with exposure. Messages appear beneath the picture: the window is higher than the picture needs.
. "$(dirname "$0")/_lib.sh"

write_scene scene.json 0.3 8
start scene.json --set /image/width=640 --set /image/height=400
settle

same_as_the_screen() { # SNAPSHOT
  python3 - "$1" "$screen/Xvfb_screen0" <<'PY'
import struct, sys, zlib
data = open(sys.argv[1], "rb").read()
at, packed = 8, b""
while at < len(data):
    size, kind = struct.unpack(">I4s", data[at : at + 8])
    if kind == b"IHDR":
        width, height, depth, colour = struct.unpack(">IIBB", data[at + 8 : at + 18])
    if kind == b"IDAT":
        packed += data[at + 8 : at + 8 + size]
    at += 12 + size
assert (depth, colour) == (8, 2), "not 8-bit RGB"
raw, stride, rows = zlib.decompress(packed), 3 * width, []
before = bytearray(stride)
for y in range(height):
    kind, line = raw[y * (stride + 1)], bytearray(raw[y * (stride + 1) + 1 : (y + 1) * (stride + 1)])
    for i in range(stride):
        a = line[i - 3] if i >= 3 else 0
        b, c = before[i], before[i - 3] if i >= 3 else 0
        p = a + b - c
        nearest = min((abs(p - a), 0, a), (abs(p - b), 1, b), (abs(p - c), 2, c))[2]
        line[i] = (line[i] + (0, a, b, (a + b) // 2, nearest)[kind]) & 255
    rows.append(line)
    before = line
screen = open(sys.argv[2], "rb").read()
header = struct.unpack(">25I", screen[:100])
start = header[0] + 12 * header[19] + 100 * header[12]  # where the picture begins
worst = sum_difference = 0
for y in range(height):
    row = screen[start + y * header[12] :][: 4 * width]
    for x in range(width):
        for c in range(3):
            difference = abs(rows[y][3 * x + c] - row[4 * x + 2 - c])
            worst = max(worst, difference)
            sum_difference += difference
print("worst difference", worst, "mean", sum_difference / (3 * width * height))
sys.exit(worst > 1)
PY
}

type_value image.exposure.value 0.7
click image.tone_map.aces
click image.tone_map.agx
sends 1 '^size 1012 630$' xdotool windowsize "$window" 1012 630
wait_for '^widget picture 0 100 640 500'
move 1005 625
for number in 001 002 003; do
  lines=$(here)
  chord ctrl p
  wait_for "^saved .*scene-$number" "$lines"
  wait_until same_as_the_screen scene-$number.png
  chord ctrl z # back to aces, then to srgb
  settle
done
finish
