"""Computes pictures of a clear sky with a sun, as Radiance HDR files.

The luminance is that of a CIE standard sky (ISO 15469:2004 / CIE S 011:2003, "Spatial distribution of daylight"):

    L / L_zenith = f(chi) phi(Z) / (f(Z_sun) phi(0)),
    phi(Z) = 1 + a exp(b / cos Z),  f(chi) = 1 + c (exp(d chi) - exp(d pi / 2)) + e cos^2 chi,

where Z is the angle from the zenith and chi that from the sun; a to e are those of type 12, the clear sky. Colour is a
plain rule of ours: from a blue at the zenith to white towards the horizon and the sun. The sun is a disc of one
radiance. Below the horizon, haze fades into one grey. The zenith has a luminance of ZENITH.

The map is equirectangular: its middle is towards -z, its top towards +y, +x is to the right of the middle. Python's
standard library only.
"""

import math
import struct

A, B, C, D, E = -1.0, -0.32, 10.0, -3.0, 0.45
ZENITH = 0.3
BLUE, WHITE, SUN_COLOUR, GROUND = (0.34, 0.56, 1.0), (1.0, 0.98, 0.95), (1.0, 0.95, 0.86), (0.11, 0.105, 0.10)
HAZE = 0.15  # sine of the depth below the horizon at which it ends
WEIGHTS = (0.2126, 0.7152, 0.0722)  # of luminance
PARTS = 8  # a texel is the mean over so many squared points


def gradation(z):
    return 1 + A * math.exp(B / max(math.cos(z), 1e-6))


def indicatrix(chi):
    return 1 + C * (math.exp(D * chi) - math.exp(D * math.pi / 2)) + E * math.cos(chi) ** 2


def of_luminance(colour, luminance):
    own = sum(w * c for w, c in zip(WEIGHTS, colour))
    return [luminance * c / own for c in colour]


class Sky:
    """sun_height: degrees above the horizon; sun_turn: degrees from -z towards +x; sun_radius: degrees; sun: its
    luminance over that of the zenith."""

    def __init__(self, sun_height, sun_turn, sun_radius, sun):
        height, turn = math.radians(sun_height), math.radians(sun_turn)
        self.sun = (math.cos(height) * math.sin(turn), math.sin(height), -math.cos(height) * math.cos(turn))
        self.cos_radius, self.sun_luminance = math.cos(math.radians(sun_radius)), sun * ZENITH
        self.scale = ZENITH / (indicatrix(math.pi / 2 - height) * gradation(0))

    def radiance(self, x, y, z):
        cos_sun = min(max(x * self.sun[0] + y * self.sun[1] + z * self.sun[2], -1.0), 1.0)
        if cos_sun >= self.cos_radius:
            return of_luminance(SUN_COLOUR, self.sun_luminance)
        if y < 0:
            flat = math.hypot(x, z) or 1.0
            horizon, depth = self.radiance(x / flat, 0.0, z / flat), min(-y / HAZE, 1.0)
            return [h + depth * (g - h) for h, g in zip(horizon, GROUND)]
        chi = math.acos(cos_sun)
        whiteness = max((1 - y) ** 4, math.exp(-4 * chi))
        colour = [b + whiteness * (w - b) for b, w in zip(BLUE, WHITE)]
        return of_luminance(colour, self.scale * indicatrix(chi) * gradation(math.acos(y)))

    def texel(self, column, row, width, height):
        total = [0.0, 0.0, 0.0]
        near = self.near_sun(column, row, width, height)
        parts = PARTS if near else 1
        for k in range(parts * parts):
            theta = math.pi * (row + (k // parts + 0.5) / parts) / height
            phi = 2 * math.pi * ((column + (k % parts + 0.5) / parts) / width - 0.5)
            value = self.radiance(math.sin(theta) * math.sin(phi), math.cos(theta), -math.sin(theta) * math.cos(phi))
            total = [t + v for t, v in zip(total, value)]
        return [t / (parts * parts) for t in total]

    def near_sun(self, column, row, width, height):
        theta, phi = math.pi * (row + 0.5) / height, 2 * math.pi * ((column + 0.5) / width - 0.5)
        way = (math.sin(theta) * math.sin(phi), math.cos(theta), -math.sin(theta) * math.cos(phi))
        angle = math.acos(min(sum(a * b for a, b in zip(way, self.sun)), 1.0))
        return angle < math.acos(self.cos_radius) + 2 * math.pi / height


def rgbe(colour):
    """Four bytes: mantissas of 8 bits, rounded, and the exponent that they share."""
    largest = max(colour)
    if largest < 1e-32:
        return bytes(4)
    exponent = math.frexp(largest)[1]
    if round(math.ldexp(largest, 8 - exponent)) == 256:
        exponent += 1
    return bytes([round(math.ldexp(c, 8 - exponent)) for c in colour] + [exponent + 128])


def runs(values):
    """A channel of a row: runs of at least 4 equal bytes as (128 + count, byte), others as (count, bytes)."""
    out, at, plain = bytearray(), 0, bytearray()

    def flush():
        while plain:
            part = plain[:128]
            out.append(len(part))
            out.extend(part)
            del plain[:128]

    while at < len(values):
        count = 1
        while at + count < len(values) and count < 127 and values[at + count] == values[at]:
            count += 1
        if count >= 4:
            flush()
            out.extend((128 + count, values[at]))
        else:
            plain.extend(values[at:at + count])
        at += count
    flush()
    return bytes(out)


def hdr(pixels):
    """The file of rows of pixels, from the top. G. Ward: Radiance, File Formats."""
    height, width = len(pixels), len(pixels[0])
    out = bytearray(b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y %d +X %d\n" % (height, width))
    for row in pixels:
        texels = [rgbe(colour) for colour in row]
        out += struct.pack(">BBH", 2, 2, width)
        for channel in range(4):
            out += runs(bytes(t[channel] for t in texels))
    return bytes(out)


def sky_hdr(width, sun_height, sun_turn, sun_radius, sun):
    sky, height = Sky(sun_height, sun_turn, sun_radius, sun), width // 2
    return hdr([[sky.texel(x, y, width, height) for x in range(width)] for y in range(height)])


def clear_sky_hdr():
    """A sun that thin haze spreads over 4 degrees to each side."""
    return sky_hdr(512, 35, 115, 4.0, 300)


def bright_sun_hdr():
    """A sun of about twice its true size, a million times as bright as the zenith."""
    return sky_hdr(512, 35, 115, 0.5, 1e6)
