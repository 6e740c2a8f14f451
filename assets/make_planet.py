"""Draws the map of an Earth-like planet: seas, continents by climate, mountains, ice caps and clouds.

The map is equirectangular, north up, 8-bit sRGB. Everything is noise on the unit sphere, so it has no seam and no
pinched poles. Python's standard library only; about a minute on two cores.
"""

import math
import random
import struct
import zlib
from multiprocessing import Pool

LAND_SHARE = 0.33  # of the sphere's area
SEED = 2

# sRGB, 0 to 255
ABYSS, OCEAN, SHELF, LAGOON = (6, 20, 54), (11, 44, 94), (27, 88, 134), (74, 152, 168)
DESERT, SAVANNA, JUNGLE = (208, 178, 126), (138, 134, 68), (34, 82, 34)
STEPPE, MEADOW, FOREST = (152, 142, 94), (92, 120, 54), (48, 88, 42)
TUNDRA, TAIGA = (126, 120, 98), (46, 74, 48)
ROCK, SNOW, CLOUD = (116, 102, 88), (238, 243, 247), (252, 253, 255)


# --- Noise --------------------------------------------------------------------------------------------------------

def lattice(seed):
    """A permutation of 0 to 255 (twice over) and 256 unit gradients, evenly spread over the sphere."""
    rng = random.Random(seed)
    order = sorted(range(256), key=[rng.random() for _ in range(256)].__getitem__)
    gradients = []
    for i in range(256):
        z, phi = 1 - (2 * i + 1) / 256, i * math.pi * (3 - math.sqrt(5))
        r = math.sqrt(1 - z * z)
        gradients.append((r * math.cos(phi), r * math.sin(phi), z))
    return order + order, gradients + gradients


ORDER, GRADIENTS = lattice(SEED)


def noise(x, y, z):
    """Gradient noise, about -0.8 to 0.8, mean 0."""
    i, j, k = math.floor(x), math.floor(y), math.floor(z)
    x, y, z = x - i, y - j, z - k
    i, j, k = i & 255, j & 255, k & 255
    u, v, w = (t * t * t * (t * (6 * t - 15) + 10) for t in (x, y, z))
    planes = []
    for row in (ORDER[i] + j, ORDER[i + 1] + j):
        dx = x - len(planes)
        (ax, ay, az), (bx, by, bz) = GRADIENTS[ORDER[ORDER[row] + k]], GRADIENTS[ORDER[ORDER[row] + k + 1]]
        (cx, cy, cz), (ex, ey, ez) = GRADIENTS[ORDER[ORDER[row + 1] + k]], GRADIENTS[ORDER[ORDER[row + 1] + k + 1]]
        a, b = ax * dx + ay * y + az * z, bx * dx + by * y + bz * (z - 1)
        c, e = cx * dx + cy * (y - 1) + cz * z, ex * dx + ey * (y - 1) + ez * (z - 1)
        low, high = a + w * (b - a), c + w * (e - c)
        planes.append(low + v * (high - low))
    return planes[0] + u * (planes[1] - planes[0])


def fractal(p, frequency, octaves, roughness=0.5):
    """Sum of octaves of noise, the first one of amplitude 1."""
    x, y, z = (c * frequency for c in p)
    total, amplitude = 0.0, 1.0
    for octave in range(octaves):
        total += amplitude * noise(x + 17.3 * octave, y - 9.1 * octave, z + 4.7 * octave)
        x, y, z, amplitude = 2.03 * x, 2.03 * y, 2.03 * z, amplitude * roughness
    return total


def ridges(p, frequency, octaves):
    """Sharp crests where noise changes its sign, 0 to 1."""
    x, y, z = (c * frequency for c in p)
    total, amplitude, weight = 0.0, 0.5, 1.0
    for octave in range(octaves):
        crest = (1 - min(1, 2.2 * abs(noise(x - 31.7 * octave, y + 3.3 * octave, z)))) ** 2
        total += amplitude * crest * weight
        weight = crest
        x, y, z, amplitude = 2.1 * x, 2.1 * y, 2.1 * z, 0.5 * amplitude
    return total


def shifted(p, offset, amount, frequency, octaves):
    """p moved by a vector of noise: bends what is drawn from it."""
    q = tuple(c + o for c, o in zip(p, offset))
    return tuple(c + amount * fractal((q[0] + 5.2 * n, q[1] + 1.3 * n, q[2] - 8.1 * n), frequency, octaves)
                 for n, c in enumerate(p))


# --- What is where ------------------------------------------------------------------------------------------------

def smooth(low, high, t):
    """0 below low, 1 above high, smooth between."""
    t = min(1.0, max(0.0, (t - low) / (high - low)))
    return t * t * (3 - 2 * t)


def mix(a, b, t):
    return tuple(x + (y - x) * t for x, y in zip(a, b))


def bell(latitude, center, width):
    return math.exp(-((abs(latitude) - center) / width) ** 2)


def swirled(p, storms):
    """p turned about the storms' centres, most in the middle: makes spirals of the clouds."""
    for center, radius, turn in storms:
        gap = math.dist(p, center)
        if gap < 3 * radius:
            angle = turn * math.exp(-(gap / radius) ** 2)
            c, s = math.cos(angle), math.sin(angle)
            along = sum(a * b for a, b in zip(p, center)) * (1 - c)
            cross = (center[1] * p[2] - center[2] * p[1], center[2] * p[0] - center[0] * p[2],
                     center[0] * p[1] - center[1] * p[0])
            p = tuple(a * c + x * s + k * along for a, x, k in zip(p, cross, center))
    return p


def make_storms(count):
    """(centre, radius, turn) of the cyclones; they turn the other way in the south."""
    rng = random.Random(SEED + 1)
    storms = []
    for n in range(count):
        latitude = math.radians((-1) ** n * (22 + 36 * rng.random()))
        longitude = 2 * math.pi * rng.random()
        level = math.cos(latitude)
        center = (level * math.cos(longitude), math.sin(latitude), level * math.sin(longitude))
        storms.append((center, 0.07 + 0.10 * rng.random(), math.copysign(2.2 + 2.2 * rng.random(), latitude)))
    return storms


STORMS = make_storms(16)


def survey(args):
    """One row of the map: a list of (height, ridge, moisture, cloud), each about -1 to 1."""
    row, width, height = args
    latitude = math.pi * (0.5 - (row + 0.5) / height)
    y, r = math.sin(latitude), math.cos(latitude)
    cells = []
    for column in range(width):
        phi = 2 * math.pi * (column + 0.5) / width - math.pi
        p = (r * math.cos(phi), y, -r * math.sin(phi))
        bent = shifted(p, (3, 7, 1), 0.22, 1.8, 3)
        ground = fractal(bent, 1.25, 8, 0.54) + 0.10 * smooth(1.15, 1.45, abs(latitude)) * (1 if y < 0 else -1)
        ridge = ridges(bent, 2.1, 5)
        moisture = fractal(p, 2.3, 7, 0.55)
        q = swirled(p, STORMS)
        q = shifted((q[0], 1.7 * q[1], q[2]), (11, 2, 5), 0.30, 2.2, 3)
        belts = 0.16 * bell(latitude, 0.90, 0.30) + 0.14 * bell(latitude, 0.05, 0.12) - 0.10 * bell(latitude, 0.42, 0.2)
        cells.append((ground, ridge, moisture, fractal(q, 2.6, 7, 0.62) + belts))
    return cells


def sea_level(grid):
    """The height that leaves LAND_SHARE of the sphere's area above it."""
    cells = []
    for row, line in enumerate(grid):
        weight = math.sin(math.pi * (row + 0.5) / len(grid))
        cells += [(cell[0], weight) for cell in line]
    cells.sort(reverse=True)
    wanted = LAND_SHARE * sum(weight for _, weight in cells)
    for height, weight in cells:
        wanted -= weight
        if wanted <= 0:
            return height
    return cells[-1][0]


# --- Colours ------------------------------------------------------------------------------------------------------

def sea_colour(depth, latitude, wobble):
    colour = mix(LAGOON, SHELF, smooth(0.0, 0.035, depth))
    colour = mix(colour, OCEAN, smooth(0.02, 0.16, depth))
    colour = mix(colour, ABYSS, smooth(0.15, 0.6, depth))
    return mix(colour, SNOW, 0.95 * smooth(1.26, 1.36, abs(latitude) + 0.28 * wobble))  # sea ice


def land_colour(height, ridge, latitude, wobble):
    """height above the sea, 0 to about 1; wobble: the moisture's noise."""
    wet = 0.50 + 0.8 * wobble + 0.35 * bell(latitude, 0.0, 0.25) - 0.30 * bell(latitude, 0.42, 0.17) \
        + 0.15 * bell(latitude, 0.95, 0.35) - 0.25 * height
    warm = 1.08 - 0.72 * abs(latitude) ** 1.35 - 0.25 * height + 0.14 * wobble
    hot = mix(mix(DESERT, SAVANNA, smooth(0.22, 0.42, wet)), JUNGLE, smooth(0.45, 0.7, wet))
    mild = mix(mix(STEPPE, MEADOW, smooth(0.2, 0.45, wet)), FOREST, smooth(0.45, 0.75, wet))
    cold = mix(TUNDRA, TAIGA, smooth(0.3, 0.6, wet))
    colour = mix(cold, mild, smooth(0.32, 0.46, warm))
    colour = mix(colour, hot, smooth(0.62, 0.80, warm))
    mountain = smooth(0.30, 0.58, ridge) * smooth(0.04, 0.20, height)
    colour = mix(colour, ROCK, 0.75 * mountain)
    snow = 1 - smooth(0.09, 0.25, warm - 0.30 * mountain)
    return mix(colour, SNOW, snow)


def paint(grid, level):
    """Rows of sRGB bytes from the surveyed grid."""
    rows, width = [], len(grid[0])
    for row, line in enumerate(grid):
        latitude = math.pi * (0.5 - (row + 0.5) / len(grid))
        above = grid[max(row - 1, 0)]
        out = bytearray()
        for column, (ground, ridge, wobble, cloud) in enumerate(line):
            height = ground - level
            if height > 0:
                colour = land_colour(height, ridge, latitude, wobble)
                west, north = line[column - 1], above[column]
                relief = (ground - west[0]) + (ground - north[0]) + 0.35 * (2 * ridge - west[1] - north[1])
                colour = tuple(c * min(1.25, max(0.7, 1 - 1.1 * relief)) for c in colour)
            else:
                colour = sea_colour(-height, latitude, wobble)
            east = line[(column + 3) % width]
            colour = tuple(c * (1 - 0.22 * smooth(0.22, 0.7, east[3])) for c in colour)  # the clouds' shadow
            colour = mix(colour, CLOUD, 0.94 * smooth(0.14, 0.70, cloud))
            out += bytes(int(min(255, max(0, c)) + 0.5) for c in colour)
        rows.append(bytes(out))
    return rows


# --- PNG ----------------------------------------------------------------------------------------------------------

def filtered(row, above):
    """The row after PNG's Paeth filter (type 4), which packs smooth pictures best."""
    out = bytearray([4])
    for i, value in enumerate(row):
        a, b, c = (row[i - 3] if i > 2 else 0), above[i], (above[i - 3] if i > 2 else 0)
        pa, pb, pc = abs(b - c), abs(a - c), abs(a + b - 2 * c)
        guess = a if pa <= pb and pa <= pc else b if pb <= pc else c
        out.append((value - guess) & 255)
    return bytes(out)


def png_bytes(rows):
    """A PNG file of 8-bit RGB rows."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    packed = b"".join(filtered(row, above) for row, above in zip(rows, [bytes(len(rows[0]))] + rows))
    header = struct.pack(">IIBBBBB", len(rows[0]) // 3, len(rows), 8, 2, 0, 0, 0)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"sRGB", b"\0")
            + chunk(b"IDAT", zlib.compress(packed, 9)) + chunk(b"IEND", b""))


def planet_png(width, height):
    """The planet's map as the bytes of a PNG file."""
    with Pool() as pool:
        grid = pool.map(survey, [(row, width, height) for row in range(height)], chunksize=4)
    return png_bytes(paint(grid, sea_level(grid)))
