#!/usr/bin/env python3
"""Makes the assets that are computed: the scenes with random numbers, the planet's map and the pictures of skies.

    python3 assets/make_assets.py            everything
    python3 assets/make_assets.py cover      only what is named: cover, bouncing-spheres, next-week, planet, skies

Needs Python 3.8 and nothing else. Every run gives the same files: random numbers come from
random.Random(seed).random(), whose sequence Python guarantees, and are rounded before they are written. All other
scenes in assets/scenes are edited by hand and are not touched.
"""

import json
import math
import random
import sys
from pathlib import Path

from make_planet import planet_png
from make_sky import bright_sun_hdr, clear_sky_hdr, hdr

ASSETS = Path(__file__).resolve().parent
SCENES = ASSETS / "scenes"
TEXTURES = ASSETS / "textures"
WIDTH = 118  # a value that fits into this many columns stays on one line
ENTRY_WIDTH = 150  # the same for a whole material, texture or object


# --- Scene files --------------------------------------------------------------------------------------------------

def one_line(value):
    """JSON on one line: {"key": [1, 2, 3]}, with a space inside the braces."""
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{json.dumps(k)}: {one_line(v)}" for k, v in value.items()) + " }" if value else "{}"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(one_line(v) for v in value) + "]"
    return json.dumps(value)


def pretty(value, indent=0, used=0, broken=False):
    """JSON text. `used`: columns taken before the value on its line; `broken`: one entry per line even if it fits."""
    flat = one_line(value)
    width = ENTRY_WIDTH if isinstance(value, dict) and "type" in value else WIDTH
    if not isinstance(value, (dict, list)) or not value or (not broken and used + len(flat) <= width):
        return flat
    pad = " " * (indent + 2)
    if isinstance(value, dict):
        parts = [f"{json.dumps(k)}: " + pretty(v, indent + 2, indent + 5 + len(k)) for k, v in value.items()]
        opening, closing = "{", "}"
    else:
        parts = [pretty(v, indent + 2, indent + 3) for v in value]
        opening, closing = "[", "]"
    return opening + "\n" + ",\n".join(pad + part for part in parts) + "\n" + " " * indent + closing


def scene_text(comment, scene):
    """A scene file: comment lines, then the scene with one material, texture and object per line."""
    lines = ["// " + line for line in comment]
    entries = []
    for key, value in scene.items():
        broken = key in ("textures", "materials", "objects")
        entries.append(f"  {json.dumps(key)}: " + pretty(value, 2, 5 + len(key), broken))
    return "\n".join(lines) + "\n{\n" + ",\n".join(entries) + "\n}\n"


def write_scene(name, comment, scene):
    path = SCENES / f"{name}.json"
    path.write_text(scene_text(comment, scene), encoding="utf-8")
    print(path.relative_to(ASSETS.parent))


# --- Scenes with random numbers -----------------------------------------------------------------------------------

def draw(rng, low=0.0, high=1.0):
    """Uniform in [low, high), rounded to four decimals."""
    return round(low + (high - low) * rng.random(), 4)


def small_spheres(rng, bounce):
    """The 22 x 22 jittered small spheres of the first book's cover: (materials, objects).

    bounce: the diffuse ones move up by up to 0.5 while time runs from 0 to 1.
    """
    materials, objects = {}, []
    for a in range(-11, 11):
        for b in range(-11, 11):
            choice = rng.random()
            center = [round(a + 0.9 * rng.random(), 4), 0.2, round(b + 0.9 * rng.random(), 4)]
            if math.dist(center, (4, 0.2, 0)) <= 0.9:
                continue
            sphere = {"type": "sphere", "center": center}
            if choice < 0.8:
                name = f"diffuse-{len(objects)}"
                albedo = [round(rng.random() * rng.random(), 4) for _ in range(3)]
                materials[name] = {"type": "lambertian", "albedo": albedo}
                if bounce:
                    sphere["center_end"] = [center[0], round(center[1] + draw(rng, 0, 0.5), 4), center[2]]
            elif choice < 0.95:
                name = f"metal-{len(objects)}"
                albedo = [draw(rng, 0.5, 1) for _ in range(3)]
                materials[name] = {"type": "metal", "albedo": albedo, "fuzz": draw(rng, 0, 0.5)}
            else:
                name = "glass"
            objects.append({**sphere, "radius": 0.2, "material": name})
    return materials, objects


def big_spheres():
    """The three large spheres of the cover: (materials, objects)."""
    materials = {
        "glass": {"type": "dielectric", "refractive_index": 1.5},
        "brown": {"type": "lambertian", "albedo": [0.4, 0.2, 0.1]},
        "bronze": {"type": "metal", "albedo": [0.7, 0.6, 0.5], "fuzz": 0},
    }
    objects = [
        {"name": "glass ball", "type": "sphere", "center": [0, 1, 0], "radius": 1, "material": "glass"},
        {"name": "brown ball", "type": "sphere", "center": [-4, 1, 0], "radius": 1, "material": "brown"},
        {"name": "metal ball", "type": "sphere", "center": [4, 1, 0], "radius": 1, "material": "bronze"},
    ]
    return materials, objects


COVER_CAMERA = {
    "look_from": [13, 2, 3], "look_at": [0, 0, 0], "vup": [0, 1, 0], "vfov": 20,
    "defocus_angle": 0.6, "focus_distance": 10,
}
GROUND = {"name": "ground", "type": "sphere", "center": [0, -1000, 0], "radius": 1000, "material": "ground"}


def make_cover():
    small_materials, small_objects = small_spheres(random.Random(1), bounce=False)
    materials, objects = big_spheres()
    write_scene("cover", [
        "Ray Tracing in One Weekend, \"A Final Render\": the picture on the book's cover.",
        "The book draws the small spheres at random; here they were drawn once. It takes 500 samples a pixel.",
    ], {
        "tyndall": 1,
        "name": "Cover",
        "image": {"width": 1200, "height": 675},
        "camera": COVER_CAMERA,
        "background": {"type": "gradient", "bottom": [1, 1, 1], "top": [0.5, 0.7, 1.0]},
        "render": {"max_depth": 50, "spp": 100},
        "materials": {"ground": {"type": "lambertian", "albedo": [0.5, 0.5, 0.5]}, **materials, **small_materials},
        "objects": [GROUND, *objects, *small_objects],
    })


def make_bouncing_spheres():
    small_materials, small_objects = small_spheres(random.Random(2), bounce=True)
    materials, objects = big_spheres()
    write_scene("bouncing-spheres", [
        "Ray Tracing: The Next Week, \"Motion Blur\", with the checkered ground of \"Texture Mapping\".",
        "The diffuse spheres rise by up to 0.5 while the shutter is open. Random numbers were drawn once.",
    ], {
        "tyndall": 1,
        "name": "Bouncing spheres",
        "image": {"width": 400, "height": 225},
        "camera": {**COVER_CAMERA, "shutter": [0, 1]},
        "background": [0.7, 0.8, 1.0],
        "render": {"max_depth": 50, "spp": 100},
        "textures": {"checker": {"type": "checker", "scale": 0.32, "even": [0.2, 0.3, 0.1], "odd": [0.9, 0.9, 0.9]}},
        "materials": {"ground": {"type": "lambertian", "albedo": "checker"}, **materials, **small_materials},
        "objects": [GROUND, *objects, *small_objects],
    })


def make_next_week():
    rng = random.Random(3)
    ground = []
    for i in range(20):
        for j in range(20):
            x, z, height = -1000 + 100 * i, -1000 + 100 * j, draw(rng, 1, 101)
            ground.append({"type": "box", "min": [x, 0, z], "max": [x + 100, height, z + 100], "material": "ground"})
    cluster = [{"type": "sphere", "center": [draw(rng, 0, 165) for _ in range(3)], "radius": 10, "material": "white"}
               for _ in range(1000)]
    blue_ball = {"type": "sphere", "center": [360, 150, 145], "radius": 70}
    write_scene("next-week", [
        "Ray Tracing: The Next Week, \"A Scene Testing All New Features\": the book's final scene.",
        "The book draws the ground's heights and the cluster of spheres at random; here they were drawn once.",
        "It takes 10000 samples a pixel.",
    ], {
        "tyndall": 1,
        "name": "Next week",
        "image": {"width": 800, "height": 800},
        "camera": {"look_from": [478, 278, -600], "look_at": [278, 278, 0], "vup": [0, 1, 0], "vfov": 40,
                   "shutter": [0, 1]},
        "background": [0, 0, 0],
        "render": {"max_depth": 40, "spp": 100},
        "textures": {
            "planet": {"type": "image", "file": "../textures/planet.png"},
            "marble": {"type": "noise", "scale": 0.2, "style": "marble"},
        },
        "materials": {
            "ground": {"type": "lambertian", "albedo": [0.48, 0.83, 0.53]},
            "lamp": {"type": "light", "radiance": [7, 7, 7]},
            "orange": {"type": "lambertian", "albedo": [0.7, 0.3, 0.1]},
            "glass": {"type": "dielectric", "refractive_index": 1.5},
            "brushed metal": {"type": "metal", "albedo": [0.8, 0.8, 0.9], "fuzz": 1.0},
            "planet": {"type": "lambertian", "albedo": "planet"},
            "marble": {"type": "lambertian", "albedo": "marble"},
            "white": {"type": "lambertian", "albedo": [0.73, 0.73, 0.73]},
        },
        "objects": [
            {"name": "lamp", "type": "quad", "corner": [123, 554, 147], "u": [300, 0, 0], "v": [0, 0, 265],
             "material": "lamp"},
            {"name": "moving ball", "type": "sphere", "center": [400, 400, 200], "center_end": [430, 400, 200],
             "radius": 50, "material": "orange"},
            {"name": "glass ball", "type": "sphere", "center": [260, 150, 45], "radius": 50, "material": "glass"},
            {"name": "metal ball", "type": "sphere", "center": [0, 150, 145], "radius": 50,
             "material": "brushed metal"},
            {"name": "blue ball", **blue_ball, "material": "glass"},
            {"name": "blue fog in the ball", "type": "medium", "boundary": blue_ball, "density": 0.2,
             "albedo": [0.2, 0.4, 0.9]},
            {"name": "mist", "type": "medium", "boundary": {"type": "sphere", "center": [0, 0, 0], "radius": 5000},
             "density": 0.0001, "albedo": [1, 1, 1]},
            {"name": "planet", "type": "sphere", "center": [400, 200, 400], "radius": 100, "material": "planet"},
            {"name": "marble ball", "type": "sphere", "center": [220, 280, 300], "radius": 80, "material": "marble"},
            {"name": "cluster", "type": "group",
             "transform": [{"rotate_y": 15}, {"translate": [-100, 270, 395]}], "objects": cluster},
            {"name": "ground", "type": "group", "objects": ground},
        ],
    })


# --- Main ---------------------------------------------------------------------------------------------------------

def make_planet():
    path = TEXTURES / "planet.png"
    path.write_bytes(planet_png(1024, 512))
    print(path.relative_to(ASSETS.parent))


def make_skies():
    """The skies of scenes, and those of assets/verify: one radiance, and one texel of 2^20 in a sky of 1."""
    sunny = [[[float(2 ** 20 if (x, y) == (20, 9) else 1)] * 3 for x in range(64)] for y in range(32)]
    verify = ASSETS / "verify"
    for path, picture in ((TEXTURES / "clear-sky.hdr", clear_sky_hdr()), (TEXTURES / "bright-sun.hdr", bright_sun_hdr()),
                          (verify / "even-sky.hdr", hdr([[[0.5] * 3] * 16] * 8)), (verify / "sun-sky.hdr", hdr(sunny))):
        path.write_bytes(picture)
        print(path.relative_to(ASSETS.parent))


MAKERS = {"cover": make_cover, "bouncing-spheres": make_bouncing_spheres, "next-week": make_next_week,
          "planet": make_planet, "skies": make_skies}


def main(names):
    unknown = [name for name in names if name not in MAKERS]
    if unknown:
        print(f"make_assets: unknown: {', '.join(unknown)}; known: {', '.join(MAKERS)}", file=sys.stderr)
        return 2
    SCENES.mkdir(exist_ok=True)
    TEXTURES.mkdir(exist_ok=True)
    for name in names or MAKERS:
        MAKERS[name]()
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
