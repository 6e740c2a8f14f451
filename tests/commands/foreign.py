"""Reads scenes for other renderers by those renderers' own rules, and draws how far away the first surface is.

Own code, from the formats' pages: pbrt.org/fileformat-v4, mitsuba.readthedocs.io, docs.blender.org. Fails where a light shines on
one side alone, where a surface is in a medium on its outer side, and where a picture is not there.
"""

import ast
import json
import math
import os
import re
import struct
import xml.etree.ElementTree


def sub(a, b): return [x - y for x, y in zip(a, b)]
def add(a, b): return [x + y for x, y in zip(a, b)]
def scale(s, a): return [s * x for x in a]
def dot(a, b): return sum(x * y for x, y in zip(a, b))
def cross(a, b): return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
def unit(a): return scale(1 / math.sqrt(dot(a, a)), a)


SKY_TOWARDS = (0.3, 0.8, -0.52)


class Picture:
    """A PFM; at(column, row): between the middles of pixels, wrapped across and down as Blender does."""

    def __init__(self, file):
        with open(file, "rb") as data:
            assert data.readline() == b"PF\n"
            self.width, self.height = map(int, data.readline().split())
            assert float(data.readline()) < 0
            numbers = struct.unpack(f"<{3 * self.width * self.height}f", data.read())
        rows = [numbers[3 * self.width * y:3 * self.width * (y + 1)] for y in reversed(range(self.height))]
        self.pixels = [[row[3 * x:3 * x + 3] for x in range(self.width)] for row in rows]

    def at(self, column, row):
        x, y = math.floor(column), math.floor(row)
        a, b = column - x, row - y
        pixel = lambda i, k: self.pixels[(y + k) % self.height][(x + i) % self.width]
        return [(1 - b) * ((1 - a) * p + a * q) + b * ((1 - a) * r + a * s)
                for p, q, r, s in zip(pixel(0, 0), pixel(1, 0), pixel(0, 1), pixel(1, 1))]


def turned(a, angle, axis):
    """About the axis (1: y, 2: z), counterclockwise as seen from its tip."""
    i, k = (axis + 1) % 3, (axis + 2) % 3
    out = list(a)
    out[i], out[k] = math.cos(angle) * a[i] - math.sin(angle) * a[k], math.sin(angle) * a[i] + math.cos(angle) * a[k]
    return out


class Scene:
    """Spheres (center, radius), flats (corner, u, v, within), sky (Mitsuba, Blender: the radiance of its picture towards
    SKY_TOWARDS) and ray(x, y) for x, y in [0, 1], y down.

    within(a, b): whether the point corner + a u + b v belongs to the flat.
    """

    def __init__(self):
        self.spheres, self.flats, self.inward, self.lights, self.sky = [], [], 0, 0, None

    def add_flat(self, kind, corner, u, v, inner=0.0):
        within = {"quad": lambda a, b: 0 <= a <= 1 and 0 <= b <= 1,
                  "triangle": lambda a, b: a >= 0 and b >= 0 and a + b <= 1,
                  "disk": lambda a, b: inner * inner <= a * a + b * b <= 1}
        self.flats.append((corner, u, v, within[kind]))

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


def text_of(word):
    return re.sub(r"\\(.)", r"\1", word[1:-1])


def read_pbrt(text, aspect):
    scene, at = Scene(), 0
    words = pbrt_tokens(text)
    known = {"Scale": 3, "LookAt": 9, "Translate": 3, "Rotate": 4, "ConcatTransform": 18, "TransformTimes": 2}
    named = ("Camera", "Film", "PixelFilter", "Sampler", "Integrator", "Material", "AreaLightSource", "LightSource", "Shape",
             "MakeNamedMedium", "Texture")
    mirrored, fov, stack = False, None, []
    # What AttributeEnd takes back. WorldBegin takes back the transform alone.
    state = {"place": [0, 0, 0], "axes": None, "seen": True, "inward": False, "light": False, "media": ['""', '""']}
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
                state["place"] = numbers
            elif word == "ConcatTransform":
                state["axes"] = [numbers[4 * k:4 * k + 3] for k in range(4)]  # by columns: x, y, z, origin
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
                state["seen"] = kind != '"interface"'
            elif word == "AreaLightSource":
                state["light"] = True
                assert values["twosided"] == ["true"]
            elif word in ("LightSource", "Shape"):
                assert state["media"][1] == '""', f"{word} {kind} stands in {state['media'][1]}"
                assert "filename" not in values or os.path.exists(text_of(values["filename"][0]))
            elif word == "Texture" and kind != '"checkerboard"' and "filename" in values:
                assert os.path.exists(text_of(values["filename"][0])), values
            if word != "Shape" or not state["seen"]:
                continue
            scene.lights += state["light"]
            scene.inward += state["inward"] and not state["light"]
            axes = state["axes"]
            if kind == '"sphere"':
                scene.spheres.append((state["place"], float(values["radius"][0])))
            elif kind == '"disk"':
                assert all(abs(dot(axes[i], axes[k]) - (i == k)) < 1e-9 for i in range(3) for k in range(3))
                radius, inner = float(values["radius"][0]), float(values["innerradius"][0])
                scene.add_flat("disk", axes[3], scale(radius, axes[0]), scale(radius, axes[1]), inner / radius)
            else:
                p = [float(v) for v in values["P"]]
                corners = [p[k:k + 3] for k in range(0, len(p), 3)]
                scene.add_flat("quad" if len(corners) == 4 else "triangle", corners[0], sub(corners[1], corners[0]),
                               sub(corners[-1], corners[0]))
        elif word == "ReverseOrientation":
            state["inward"] = not state["inward"]
        elif word == "MediumInterface":
            state["media"], at = words[at:at + 2], at + 2
        elif word == "ActiveTransform":
            at += 1
        elif word == "AttributeBegin":
            stack.append(dict(state))
        elif word == "AttributeEnd":
            state = stack.pop()
        elif word == "Option":
            assert words[at:at + 2] == ['"disabletexturefiltering"', "true"]
            at += 2
        else:
            assert word == "WorldBegin", f"what is {word}?"
            state["place"], state["axes"] = [0, 0, 0], None
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
    sides = {}  # of lights, by their middles: the sum of the normals on whose sides they shine
    for shape in root.iter("shape"):
        if shape.find("bsdf").get("type") == "null":
            continue
        light = shape.find("emitter") is not None
        shines = lambda middle, normal: sides.setdefault(tuple(round(c, 3) for c in middle), []).append(normal)
        if shape.get("type") == "sphere":
            center = shape.find("point")
            scene.spheres.append(([float(center.get(k)) for k in "xyz"], number(shape, "radius")))
            flipped = shape.find("boolean[@name='flip_normals']") is not None
            scene.inward += flipped and not light
            if light:
                shines(scene.spheres[-1][0], [-1, 0, 0] if flipped else [1, 0, 0])
        else:
            m = vector(shape.find("transform/matrix").get("value"))
            x, y, _, middle = ([m[4 * row + column] for row in range(3)] for column in range(4))
            if light:
                shines(middle, unit(cross(x, y)))
            if shape.get("type") == "rectangle":
                scene.add_flat("quad", sub(middle, add(x, y)), scale(2, x), scale(2, y))
            elif shape.get("type") == "disk":
                assert abs(dot(x, x) - dot(y, y)) < 1e-5 * dot(x, x) and abs(dot(x, y)) < 1e-5 * dot(x, x)
                scene.add_flat("disk", middle, x, y)
            else:
                check_mesh(shape.find("string[@name='filename']").get("value"))
                scene.add_flat("triangle", middle, x, y)
    for normals in sides.values():
        total = [sum(n[k] for n in normals) for k in range(3)]
        assert dot(total, total) < 1e-6, f"a light shines on one side: {normals}"
        scene.lights += len(normals) // 2
    envmap = root.find("emitter[@type='envmap']")
    if envmap is not None:
        sky = Picture(envmap.find("string").get("value"))
        assert sky.width >= 2 and sky.height >= 3, (sky.width, sky.height)
        angle = math.radians(float(envmap.find("transform/rotate").get("angle")))
        x, y, z = turned(unit(SKY_TOWARDS), -angle, 1)
        u, v = math.atan2(x, -z) / (2 * math.pi), math.acos(y) / math.pi
        scene.sky = scale(number(envmap, "scale"), sky.at(u * sky.width - 0.5, v * (sky.height - 1)))
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
            scene.inward += shape["inward"] and not light
            scene.lights += light
        else:
            for kind in ("quad", "triangle", "disk"):
                for *place, inner in shape.get(kind + "s", []):
                    scene.add_flat(kind, *map(world, place), inner)
                    scene.lights += light
    sky = data["background"]
    if sky["type"] == "image":
        picture = Picture(sky["file"])
        x, y, z = turned(unit(world(SKY_TOWARDS)), math.radians(-90 - sky["rotate_y"]), 2)
        u, v = 0.5 - math.atan2(y, x) / (2 * math.pi), math.acos(z) / math.pi
        scene.sky = scale(sky["scale"], picture.at(u * picture.width - 0.5, v * picture.height - 0.5))
    for texture in data["textures"]:
        assert texture["type"] != "image" or Picture(texture["file"])
    camera = data["camera"]
    half = math.tan(math.radians(camera["vfov"]) / 2)
    # Blender's camera looks along its -z, x to the right, y up.
    right, up, forward = (world(camera[k]) for k in ("right", "up", "forward"))
    assert all(abs(a - b) < 1e-9 for a, b in zip(cross(right, up), scale(-1, forward)))
    scene.ray = pinhole(world(camera["at"]), forward, right, up, half * aspect, half)
    return scene


def read(file, width, height):
    """The scene, and a line of it: the number of shapes, of inward normals of what is no light, and of lights."""
    text = open(file, encoding="utf-8").read()
    scene = {"pbrt": read_pbrt, "xml": read_xml, "py": read_script}[file.rsplit(".", 1)[1]](text, width / height)
    return scene, f"{len(scene.spheres) + len(scene.flats)} shapes, {scene.inward} inward, {scene.lights} lights"


def distances(scene, width, height):
    """How far away the first surface is, of each pixel; 0: there is none. A PFM, bottom row first."""
    rows = [[scene.distance(*scene.ray((x + 0.5) / width, (y + 0.5) / height)) for x in range(width)] for y in range(height)]
    numbers = [t if t < math.inf else 0.0 for row in reversed(rows) for t in row for _ in range(3)]
    return b"PF\n%d %d\n-1.0\n" % (width, height) + struct.pack(f"<{len(numbers)}f", *numbers)
