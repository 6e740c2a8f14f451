# shellcheck shell=bash
# Sourced: pictures in floating point.
# pfm FILE WIDTH HEIGHT RED GREEN BLUE [X,Y,RED,GREEN,BLUE ...]: an image of one colour, but for some pixels (y down).
pfm() {
  python3 -c '
import struct, sys
w, h = int(sys.argv[2]), int(sys.argv[3])
rows = [[tuple(map(float, sys.argv[4:7]))] * w for _ in range(h)]
for pixel in sys.argv[7:]:
    x, y, *colour = pixel.split(",")
    rows[int(y)][int(x)] = tuple(map(float, colour))
data = b"".join(struct.pack("<3f", *colour) for row in reversed(rows) for colour in row)
open(sys.argv[1], "wb").write(b"PF\n%d %d\n-1.0\n" % (w, h) + data)' "$@"
}
