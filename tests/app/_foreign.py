"""Reads scenes for other renderers by those renderers' own rules, and draws how far away the first surface is.

Usage: _foreign.py FILE.pbrt|FILE.xml|FILE.py WIDTHxHEIGHT OUT.pfm

Own code, from the formats' pages: pbrt.org/fileformat-v4, mitsuba.readthedocs.io, docs.blender.org. Prints the number of
shapes, of inward normals and of lights.
"""
import ast
import json
import math
import re
import struct
import sys
import xml.etree.ElementTree


def sub(a, b): return [x - y for x, y in zip(a, b)]
def add(a, b): return [x + y for x, y in zip(a, b)]
def scale(s, a): return [s * x for x in a]
def dot(a, b): return sum(x * y for x, y in zip(a, b))
def cross(a, b): return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
def unit(a): return scale(1 / math.sqrt(dot(a, a)), a)


class Scene:
    """Spheres (center, radius), flats (corner, u, v, within) and ray(x, y) for x, y in [0, 1], y down.

    within(a, b): whether the point corner + a u + b v belongs to the flat.
    """

    def __init__(self):
        self.spheres, self.flats, self.inward, self.lights = [], [], 0, 0

    def add_quad(self, corner, u, v):
        self.flats.append((corner, u, v, lambda a, b: 0 <= a <= 1 and 0 <= b <= 1))

    def add_triangle(self, corner, u, v):
        self.flats.append((corner, u, v, lambda a, b: a >= 0 and b >= 0 and a + b <= 1))

    def add_disk(self, center, u, v, inner=0.0):
        self.flats.append((center, u, v, lambda a, b: inner * inner <= a * a + b * b <= 1))

    def distance(self, origin, direction):
        nearest = math.inf
        for center, radius in self.spheres:
            to = sub(origin, center)
            b, c = dot(to, direction), dot(to, to) - radius * radius
            if b * b - c > 0:
                for t in (-b - math.sqrt(b * b - c), -b + math.sqrt(b * b - c)):
                    if 1e-4 < t < nearest:
                        nearest = t
                        break
        for corner, u, v, within in self.flats:
            n = cross(u, v)
            if dot(n, direction) == 0:
                continue
            t = dot(n, sub(corner, origin)) / dot(n, direction)
            p = sub(add(origin, scale(t, direction)), corner)
            a, b = dot(cross(p, v), n) / dot(n, n), dot(cross(u, p), n) / dot(n, n)
            if 1e-4 < t < nearest and within(a, b):
                nearest = t
        return nearest


def pinhole(origin, forward, right, up, tan_x, tan_y):
    def ray(x, y):
        across, along = (2 * x - 1) * tan_x, (1 - 2 * y) * tan_y
        return origin, unit(add(forward, add(scale(across, right), scale(along, up))))
    return ray


def pbrt_tokens(text):
    text = re.sub(r"^#.*$", "", text, flags=re.M)
    found = re.findall(r'"(?:\\.|[^"\\\n])*"|\[|\]|[^\s"\[\]]+', text)
    assert sum(map(len, found)) == len(re.sub(r'\s', '', text)) + sum(len(re.findall(r'\s', w)) for w in found)
    return found


def read_pbrt(text, aspect):
    scene, at = Scene(), 0
    words = pbrt_tokens(text)
    known = {"Scale": 3, "LookAt": 9, "Translate": 3, "Rotate": 4, "ConcatTransform": 18, "TransformTimes": 2}
    named = ("Camera", "Film", "PixelFilter", "Sampler", "Integrator", "Material", "AreaLightSource", "LightSource", "Shape",
             "MakeNamedMedium", "Texture")
    place, mirrored, fov, seen, axes = [0, 0, 0], False, None, True, None
    while at < len(words):
        word, at = words[at], at + 1
        if word in known:
            numbers = [float(w) for w in words[at:at + known[word]] if w not in "[]"]
            at += known[word]
            if word == "Scale" and fov is None and numbers == [-1, 1, 1]:
                mirrored = True
            elif word == "LookAt":
                look = numbers
            elif word == "Translate":
                place = numbers
            elif word == "ConcatTransform":
                axes = [numbers[4 * k:4 * k + 3] for k in range(4)]  # by columns: x, y, z, origin
        elif word in named:
            kind, at = words[at], at + 1
            at += 2 if word == "Texture" else 0
            values = {}
            while at < len(words) and words[at].startswith('"'):
                key, at = words[at].strip('"').split(" ", 1)[1], at + 1
                if words[at] == "[":
                    end = words.index("]", at)
                    values[key], at = words[at + 1:end], end + 1
                else:
                    values[key], at = [words[at]], at + 1
            if word == "Camera":
                fov = float(values["fov"][0])
            elif word == "Material":
                seen = kind != '"interface"'
            elif word == "Shape" and not seen:
                pass
            elif word == "AreaLightSource":
                scene.lights += 1
                assert values["twosided"] == ["true"]
            elif word == "Shape" and kind == '"sphere"':
                scene.spheres.append((place, float(values["radius"][0])))
            elif word == "Shape" and kind == '"disk"':
                assert all(abs(dot(axes[i], axes[k]) - (i == k)) < 1e-9 for i in range(3) for k in range(3))
                radius, inner = float(values["radius"][0]), float(values["innerradius"][0])
                scene.add_disk(axes[3], scale(radius, axes[0]), scale(radius, axes[1]), inner / radius)
            elif word == "Shape":
                p = [float(v) for v in values["P"]]
                corners = [p[k:k + 3] for k in range(0, len(p), 3)]
                add_flat = scene.add_quad if len(corners) == 4 else scene.add_triangle
                add_flat(corners[0], sub(corners[1], corners[0]), sub(corners[-1], corners[0]))
        elif word == "ReverseOrientation":
            scene.inward += 1
        elif word == "MediumInterface":
            at += 2
        elif word == "ActiveTransform":
            at += 1
        else:
            assert word in ("WorldBegin", "AttributeBegin", "AttributeEnd"), f"what is {word}?"
    origin, forward = look[:3], unit(sub(look[3:6], look[:3]))
    right = unit(cross(look[6:9], forward))  # left-handed
    up = cross(forward, right)
    half = math.tan(math.radians(fov) / 2)
    tan_x, tan_y = (half * aspect, half) if aspect >= 1 else (half, half / aspect)
    scene.ray = pinhole(origin, forward, scale(-1, right) if mirrored else right, up, tan_x, tan_y)
    return scene


def check_mesh(file):
    head, body = open(file, encoding="ascii").read().split("end_header\n")
    assert head.startswith("ply\nformat ascii 1.0\nelement vertex 3\n"), head
    assert body.split("\n") == ["0 0 0", "1 0 0", "0 1 0", "3 0 1 2", ""], body


def read_xml(text, aspect):
    scene, root = Scene(), xml.etree.ElementTree.fromstring(text)
    vector = lambda words: [float(w) for w in re.split(r"[,\s]+", words.strip())]
    number = lambda node, name: float(node.find(f"float[@name='{name}']").get("value"))
    for shape in root.iter("shape"):
        scene.lights += shape.find("emitter") is not None
        if shape.find("bsdf").get("type") == "null":
            continue
        if shape.get("type") == "sphere":
            center = shape.find("point")
            scene.spheres.append(([float(center.get(k)) for k in "xyz"], number(shape, "radius")))
            scene.inward += shape.find("boolean[@name='flip_normals']") is not None
        else:
            m = vector(shape.find("transform/matrix").get("value"))
            x, y, _, middle = ([m[4 * row + column] for row in range(3)] for column in range(4))
            if shape.get("type") == "rectangle":
                scene.add_quad(sub(middle, add(x, y)), scale(2, x), scale(2, y))
            elif shape.get("type") == "disk":
                assert abs(dot(x, x) - dot(y, y)) < 1e-5 * dot(x, x) and abs(dot(x, y)) < 1e-5 * dot(x, x)
                scene.add_disk(middle, x, y)
            else:
                check_mesh(shape.find("string[@name='filename']").get("value"))
                scene.add_triangle(middle, x, y)
    sensor = root.find("sensor")
    look = sensor.find("transform/lookat")
    origin, target, up = (vector(look.get(k)) for k in ("origin", "target", "up"))
    forward = unit(sub(target, origin))
    left = unit(cross(up, forward))  # right-handed, x to the left
    assert sensor.find("string[@name='fov_axis']").get("value") == "y"
    half = math.tan(math.radians(number(sensor, "fov")) / 2)
    scene.ray = pinhole(origin, forward, scale(-1, left), cross(forward, left), half * aspect, half)
    return scene


def data_of(text):
    """The scene in a script: the only thing in it that differs from scene to scene."""
    tree = ast.parse(text)
    values = [n.value for n in tree.body if isinstance(n, ast.Assign)
              and ast.unparse(n.targets[0]) == "DATA"]
    assert len(values) == 1 and isinstance(values[0], ast.Constant)
    data, values[0].value = json.loads(values[0].value), ""
    return data, ast.dump(tree)


def read_script(text, aspect):
    scene, (data, _) = Scene(), data_of(text)
    world = lambda p: [p[0], -p[2], p[1]]  # z is up
    for shape in data["shapes"]:
        if shape["material"] < 0:
            continue
        light = data["materials"][shape["material"]]["type"] == "light"
        if "radius" in shape:
            scene.spheres.append((world(shape["center"]), shape["radius"]))
            scene.inward += shape["inward"]
            scene.lights += light
        else:
            for flat in shape.get("flats", []):
                scene.add_quad(*map(world, flat))
            if "triangle" in shape:
                scene.add_triangle(*map(world, shape["triangle"]))
            if "disk" in shape:
                scene.add_disk(*map(world, shape["disk"]), shape["inner"])
            scene.lights += light * len(shape.get("flats", [None]))
    camera = data["camera"]
    half = math.tan(math.radians(camera["vfov"]) / 2)
    # Blender's camera looks along its -z, x to the right, y up.
    right, up, forward = (world(camera[k]) for k in ("right", "up", "forward"))
    assert all(abs(a - b) < 1e-9 for a, b in zip(cross(right, up), scale(-1, forward)))
    scene.ray = pinhole(world(camera["at"]), forward, right, up, half * aspect, half)
    return scene


def main(file, size, out):
    width, height = map(int, size.split("x"))
    text = open(file, encoding="utf-8").read()
    read = {"pbrt": read_pbrt, "xml": read_xml, "py": read_script}[file.rsplit(".", 1)[1]]
    scene = read(text, width / height)
    rows = []
    for y in range(height):
        row = []
        for x in range(width):
            t = scene.distance(*scene.ray((x + 0.5) / width, (y + 0.5) / height))
            row += [t if t < math.inf else 0.0] * 3
        rows.append(row)
    with open(out, "wb") as picture:
        picture.write(b"PF\n%d %d\n-1.0\n" % (width, height))
        for row in reversed(rows):
            picture.write(struct.pack(f"<{len(row)}f", *row))
    print(len(scene.spheres) + len(scene.flats), "shapes,", scene.inward, "inward,", scene.lights, "lights")


if __name__ == "__main__":
    main(*sys.argv[1:])
