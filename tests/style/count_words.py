#!/usr/bin/env python3
"""Fails when identifiers of core or app use a word of the old dialect more often than LIMITS allows.

Usage: count_words.py ROOT

Names in the code are the field's terms: who has read "Physically Based Rendering", and nothing of this project, should guess
right. Counted are whole parts of identifiers (snake_case or CamelCase) in the C++ files of core and app, once an occurrence:
`lamp_radius` and `LampSide` both count for "lamp". Comments and texts do not count. Names of files count, once a file.
"""
import collections
import pathlib
import re
import sys

TOKEN = re.compile(r'''(?P<skip>R"(?P<mark>[^\s()\\]{0,16})\(.*?\)(?P=mark)"|//(?:[^\n\\]|\\.|\\\n)*|/\*.*?\*/|"(?:[^"\\\n]|\\.)*"'''
                   r'''|^[ \t]*#[ \t]*include[^\n]*|'(?:[^'\\\n]|\\.)+'|\.?\d(?:[eEpP][+-]|'(?=\w)|[\w.])*)|(?P<name>[A-Za-z_]\w*)''',
                   re.DOTALL | re.MULTILINE)
PART = re.compile(r"[A-Z]+(?![a-z])|[A-Z]?[a-z]+")

# Word: how often it may stand, and why. In place of it: what to write.
LIMITS = {
    "dice": (0, "sampler"), "crew": (0, "thread_pool"), "lone": (0, "single"), "crowds": (0, "overlap"),
    "glint": (0, "subpixel_light"), "glints": (0, "subpixel_lights"),
    "lamp": (0, "light"), "lamps": (0, "lights"), "pane": (0, "slab"), "panes": (0, "slabs"),
    "ball": (0, "sphere"), "balls": (0, "spheres"), "fog": (0, "medium"), "smoke": (0, "medium"),
    "chain": (0, "specular_path"), "asked": (0, "query"), "asks": (0, "query, connect_probability"),
    "share": (3, "fraction, reflectance, reuse: only FILE_SHARE_READ and its like"), "shares": (0, "fractions, reuses"),
    "company": (0, "group"), "hull": (0, "enclosing_walls"), "sight": (0, "visibility, view_ray"),
    "companions": (0, "linked_objects"), "grain": (0, "drag_rounding"), "spared": (0, "exempt"), "evenly": (0, "is_diffuse"),
    "orders": (0, "request"), "director": (0, "render_loop"), "wishes": (0, "request"), "facts": (0, "model"),
    "broken": (0, "parse_error"),
    "chains": (12, "specular: only Caustics::chains, which users write as --caustics chains"),
    "word": (80, "sequence, random_bits, label, ints: only words of a text and of memory"),
    "words": (80, "sequences, ints, arguments: only words of a text and of memory"),
    "way": (10, "path, to_light, direction, motion: only the way of a drag or a file, as users say it"),
    "ways": (0, "paths, directions"),
    "turn": (5, "deflection, rotate, phi: only whose turn it is"), "turns": (0, "revolutions"), "turned": (0, "rotated"),
    "unit": (140, "tile_job, quantum, unit_vector: only units of measure, unit_interval, unit_vector"),
    "units": (4, "tiles: only units of measure"),
    "along": (35, "point_at, exiting: only along an axis"),
    "most": (8, "max: only at_most"), "least": (16, "min: only at_least"),
    "needs": (8, "features: only the verb"),
    "density": (50, "pdf, of a direction: only of a medium and of pixels on a screen"),
    "narrow": (8, "lobe_width: only the verb, and is_narrow_lobe"),
}


def parts_of(name):
    return {part.lower() for part in PART.findall(name)}


def count(text):
    """How often each word stands in a text of C++."""
    words = collections.Counter()
    for match in TOKEN.finditer(text):
        if match.group("name"):
            words.update(parts_of(match.group("name")) & LIMITS.keys())
    return words


def check(root):
    words, places = collections.Counter(), collections.defaultdict(collections.Counter)
    for folder in ("core", "app"):
        for path in sorted((root / folder).rglob("*")):
            if path.suffix not in (".h", ".cpp"):
                continue
            here = count(path.read_text(encoding="utf-8"))
            here.update(parts_of(path.stem) & LIMITS.keys())
            words += here
            for word, number in here.items():
                places[word][str(path.relative_to(root))] += number
    for word, (limit, instead) in LIMITS.items():
        if words[word] > limit:
            files = ", ".join(f"{file} ({number})" for file, number in places[word].most_common(4))
            yield f'"{word}" stands in {words[word]} identifiers, at most {limit} are allowed ({instead}): {files}'


if __name__ == "__main__":
    # What the counting rests on: parts of names count, texts and comments do not.
    sample = 'int lamp_radius = LampSide(a.lamp_)  /* lamp */ + "lamp" + lampshade;  // lamp\nR"(lamp)"'
    assert count(sample) == {"lamp": 3}, count(sample)
    found = list(check(pathlib.Path(sys.argv[1]).resolve()))
    for problem in found:
        print(problem)
    sys.exit(1 if found else 0)
