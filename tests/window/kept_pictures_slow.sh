#!/usr/bin/env bash
# What is on the screen looks like the kept pictures in kept/: the finished picture, what it is made of, the clean view, false
# colour, the handles of a selection, and a coarse picture enlarged. TYNDALL_UPDATE=1 keeps what is on the screen instead.
. "$(dirname "$0")/_lib.sh"
kept=$root/tests/window/kept

# shot FILE.png: the part of the screen that the picture covers.
shot() {
  local line
  line=$(grep -E '^widget picture ' "$scratch/log" | tail -1)
  # shellcheck disable=SC2086
  set -- "$1" $line
  python3 - "$screen/Xvfb_screen0" "$1" "$4" "$5" "$6" "$7" <<'PY'
import struct, sys, zlib
data = open(sys.argv[1], "rb").read()
x0, y0, x1, y1 = map(int, sys.argv[3:7])
header = struct.unpack(">25I", data[:100])
stride, start = header[12], header[0] + 12 * header[19]
rows = b""
for y in range(y0, y1):
    row = data[start + y * stride + 4 * x0 : start + y * stride + 4 * x1]
    rgb = bytearray(3 * (x1 - x0))
    rgb[0::3], rgb[1::3], rgb[2::3] = row[2::4], row[1::4], row[0::4]
    rows += b"\0" + bytes(rgb)
def chunk(kind, body):
    return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))
with open(sys.argv[2], "wb") as file:
    file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">2I5B", x1 - x0, y1 - y0, 8, 2, 0, 0, 0))
               + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b""))
PY
}

# looks NAME: the picture on the screen is the kept one of that name; waits until the screen shows it.
looks() {
  move 5 5
  settle_without_message
  if is_on TYNDALL_UPDATE; then
    until shot "$1.png" && sleep 0.5 && shot again.png && cmp -s "$1.png" again.png; do :; done
    "$tyndall" compare "$1.png" --baseline "$kept" --update --max-flip 0.002 >compared
    return
  fi
  local tries
  for ((tries = 0; tries < 100; ++tries)); do # the X server puts a drawing on the screen after the log has told of it
    shot "$1.png"
    "$tyndall" compare "$1.png" --baseline "$kept" >compared 2>&1 && return
    sleep 0.1
  done
  fail "the screen does not look like the kept picture: $(cat compared)"
}

write_scene scene.json 0.2
sed -i 's/"integrator": "path", "sampler": "random"/"integrator": "mis"/' scene.json
start scene.json --spp 64
settle
key 0 # a pixel for each of the screen's
looks beauty
for view in albedo normal depth object; do
  click "image.view.$view"
  looks "$view"
done
click image.view.beauty
key n
looks clean
key n
click image.view.false_colour
looks false_colour
click image.view.beauty
click picture 50 45
looks handles
finish
