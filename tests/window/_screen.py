"""A rectangle of the screen of Xvfb. Usage: _screen.py FRAMEBUFFER X0 Y0 X1 Y1 COMMAND [PICTURE.png]

mean   prints the mean of its red, green and blue
save   writes it as a picture
same   exit code 1, unless it shows the picture to one step of 255
"""
import struct
import sys
import zlib


def screen_rows(file, x0, y0, x1, y1):
    """Its rows, as bytes of red, green and blue."""
    with open(file, "rb") as framebuffer:
        data = framebuffer.read()
    header = struct.unpack(">25I", data[:100])
    stride, start = header[12], header[0] + 12 * header[19]
    for y in range(y0, y1):
        row = data[start + y * stride + 4 * x0 : start + y * stride + 4 * x1]
        rgb = bytearray(3 * (x1 - x0))
        rgb[0::3], rgb[1::3], rgb[2::3] = row[2::4], row[1::4], row[0::4]
        yield bytes(rgb)


def write_png(file, rows):
    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))

    header = struct.pack(">2I5B", len(rows[0]) // 3, len(rows), 8, 2, 0, 0, 0)
    packed = zlib.compress(b"".join(b"\0" + row for row in rows), 9)
    with open(file, "wb") as picture:
        picture.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", packed) + chunk(b"IEND", b""))


def png_rows(file):
    with open(file, "rb") as picture:
        data = picture.read()
    at, packed = 8, b""
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at : at + 8])
        if kind == b"IHDR":
            width, height, depth, colour = struct.unpack(">IIBB", data[at + 8 : at + 18])
        if kind == b"IDAT":
            packed += data[at + 8 : at + 8 + size]
        at += 12 + size
    assert (depth, colour) == (8, 2), "not 8-bit RGB"
    raw, before = zlib.decompress(packed), bytearray(3 * width)
    for y in range(height):
        kind, line = raw[y * (3 * width + 1)], bytearray(raw[y * (3 * width + 1) + 1 :][: 3 * width])
        for i in range(3 * width):
            a, b = line[i - 3] if i >= 3 else 0, before[i]
            c = before[i - 3] if i >= 3 else 0
            nearest = min((abs(b - c), 0, a), (abs(a - c), 1, b), (abs(a + b - 2 * c), 2, c))[2]
            line[i] = (line[i] + (0, a, b, (a + b) // 2, nearest)[kind]) & 255
        yield bytes(line)
        before = line


rows = list(screen_rows(sys.argv[1], *map(int, sys.argv[2:6])))
if sys.argv[6] == "mean":
    print(round(sum(map(sum, rows)) / (len(rows) * len(rows[0])), 2))
elif sys.argv[6] == "save":
    write_png(sys.argv[7], rows)
else:
    saved = list(png_rows(sys.argv[7]))
    sys.exit(max(abs(a - b) for row, other in zip(rows, saved, strict=True) for a, b in zip(row, other, strict=True)) > 1)
