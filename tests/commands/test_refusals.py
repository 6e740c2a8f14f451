"""What each command refuses: arguments, exit code, words of the one line that it says. No row changes a file. What the
options alone decide is in app/cli/options, and wrong names of outputs are in app/files/outputs."""

import os
import pathlib
import re
import shutil

import pytest
from program import HAS_EXR, PROGRAM, ROOT, pfm, run, write

SCENE = """{ "tyndall": 1, "image": { "width": 8, "height": 8 },
  "textures": { "t": { "type": "image", "file": "texture.png" } },
  "materials": { "m": { "type": "lambertian", "albedo": "t" } },
  "objects": [ { "type": "sphere", "center": [0, 0, -2], "radius": 1, "material": "m" } ] }"""
FILM = """{ "tyndall": 1, "image": { "width": 24, "height": 16 }, "render": { "seed": 5, "spp": 4 },
  "animation": { "frames": 4, "keys": { "/materials/gold/fuzz": { "0": 0, "3": 0.3 } } },
  "materials": { "gold": { "type": "metal", "albedo": [0.8, 0.6, 0.2], "fuzz": 0.3 } },
  "objects": [{ "type": "sphere", "center": [0, 0, 0], "radius": 1, "material": "gold" }] }"""
NEVER = "--spp 1000000 -q"  # so that what is refused too late is seen by the time that it takes
BOX = "render cornell-box -o a.png"
SWEEP = "sweep showroom --size 32x18 --spp 4 -q"
FUZZ = "--vary /materials/gold/fuzz=0:0.4:3"
SMALL = "render cornell-box --size 8x8 -q"


@pytest.fixture(scope="module")
def inputs(tmp_path_factory):
    """The files that rows name."""
    folder = tmp_path_factory.mktemp("inputs")
    os.chdir(folder)
    run(f"{SMALL} --spp 2 -o texture.png -o reference.pfm -o picture.ppm")
    run(f"{SMALL} --spp 4 --adaptive -o adaptive.png")
    for name, text in {"scene.json": SCENE, "film.json": FILM,
                       "wide.json": '{ "tyndall": 1, "camera": { "vfov": 400 } }',
                       "layer.json": SCENE.replace("texture.png", "texture.png:R"), "broken.json": "not a scene\n",
                       "float.json": SCENE.replace("texture.png", "reference.pfm"), "text.png": "text\n",
                       "large.ppm": "P6 99999 99999 255\n", "texts/notes.txt": "text\n", "sub/kept.txt": ""}.items():
        write(name, text)
    pathlib.Path("taken.png").mkdir()
    for link, target in {"linked.json": "scene.json", "here": ".", "chart.csv": "reference.pfm"}.items():
        os.symlink(target, link)
    os.link("scene.json", "hard.json")
    pfm("wider.pfm", 16, 9, 0.5, 0.5, 0.5)
    pfm("grey.pfm", 16, 8, 0.5, 0.5, 0.5)
    pfm("noise.pfm", 16, 8, 0.5, 0.5, 0.5)
    pfm("noise.error.pfm", 16, 7, 0.1, 0.1, 0.1)
    wrong = ('{"texture.png": {"max_flop": 1}}', '{"texture.png": {"max_flip": -1}}', "[1]", "x")
    for number, kept in enumerate(wrong):
        write(f"kept{number}/tolerances.json", kept)
        shutil.copy("texture.png", f"kept{number}")
    if HAS_EXR:
        for name, options in {"0": "--samples 0:2", "2": "--samples 2:4", "gap": "--samples 9:13", "one": "--spp 1",
                              "four": "--spp 4", "adaptive": "--spp 4 --adaptive", "left": "--region 0,0,4,8",
                              "lean": "--spp 2 --exr-film no"}.items():
            run(f"{SMALL} {options} -o {name}.exr", loud=True)
        run("render stress-caustic-glass --size 16x12 --samples 0:2 -q -o chains.exr", loud=True)
        run("render stress-caustic-glass --size 16x12 --samples 2:4 --caustics scatter -q -o scatter.exr", loud=True)
    return folder


# The beginning of a command, the exit code, and for each row the other arguments and words of what it says.
REFUSED = [
    ("", 2, [
        ("redner cornell-box -o a.png", 'unknown command "redner"', "render"),
        ("verify plaet", '"plaet"', 'did you mean "plate"?'),
        ("verify plate fog-bal/", '"fog-bal/"', "fog-ball"),
        ("inspect broken.json", "broken.json"),
        ("inspect picture.ppm", "picture.ppm", "an image without a scene in it"),
        ("inspect --accuracy", re.compile("tests/README.md.*tyndall_bench approximations")),
        ("missing.json", "missing.json"),
        ("render quads --size 20000x13500 --spp 1 -o a.png", "quads: /image: found 20000x13500", "2^28"),
        ("render quads --size 1x268435456 --spp 1 -o a.png",),
    ]),
    (BOX, 2, [
        ("--size 12", "--size", '"12"', "WIDTHxHEIGHT"),
        ("--size 70000x10", "width"),
        ("--region 0,0,601,10", "--region", "600"),
        ("--resume", "--resume", ".exr"),
        ("--checkpoint 1", "--checkpoint", ".exr"),
        ("-o a.png", "twice"),
        ("--stats a.png", "--stats", ".json"),
        ("--set /materials/nobody/fuzz=1", "/materials/nobody"),
        ("--set /camera/vfov=fast", "/camera/vfov", "fast"),
        ("--set /render/adaptive=1", "/render/adaptive", "found 1, expected true or false"),
        ("--adaptive --samples 0:4", "--samples", "adaptive"),
        ("--samples 0:4 --denoise", "--samples", "--denoise"),
        ("--spp 1 --denoise", "--denoise", "at least 2"),
        ("--gamma2", "--gamma2", ".ppm"),
        ("--frame 0", "--frame", "animation"),
        *[(f"--watch-at={wrong}", "--watch-at: found", "expected HOST or HOST:PORT")
          for wrong in (":14158", "host:", "host:0", "host:65536", "host:x", "[::1", "[::1]x", "[::1]:")],
    ]),
    ("render", 2, [
        ("missing.json -o a.png", "missing.json"),
        ("cornell-bxo -o a.png", "cornell-box"),
        (". -o a.png",),
        ("wide.json -o a.png", "wide.json", "/camera/vfov", "400"),
        ("layer.json -o a.png", "layer.json: /textures/t/file", 'found layer "R" of', "which has no layers"),
        ("float.json -o a.png", "reference.pfm", "floating-point"),
        ("adaptive.png --samples 0:4 -o a.png", "--samples", "adaptive"),
        ("film.json --frame 4 -o a.png", "--frame", "at most 3"),
        ("quads -o - --format jpg", "--format", "jpg"),
        ("quads -o - --format pgm", "ppm"),
        ("quads -o - --format png --stats -", "--stats -"),
        ("showroom --size 32x24 --replay 32,0,0", "--replay", "32,0", "32x24"),
        ("showroom --replay 1,2", "--replay", "X,Y,SAMPLE"),
        ("showroom --replay 1,2,-3", "--replay", "X,Y,SAMPLE"),
        ("showroom --replay 1,2,3 -o a.png", "--replay", "-o"),
        ("showroom --replay 1,2,3 --gamma2", "--gamma2"),
        ("showroom --replay 1,2,3 --watch-at localhost", "--replay and --watch-at"),
        ("missing.json --replay 1,2,3", "missing.json"),
    ]),
    (f"{BOX} --spp 100000", 3, [
        ("-o folder/a.png", "folder/a.png", "folder"),
        ("-o /proc/tyndall.png", "/proc/tyndall.png"),
        ("-o taken.png", "taken.png"),
        ("--stats folder/s.json", "folder/s.json"),
    ]),
    # No command writes over what it reads.
    (f"render scene.json {NEVER} -o new.png", 2, [
        *[(f"--stats {name}", "--stats", "input") for name in (
            "scene.json", "./scene.json", "sub/../scene.json", "here/scene.json", "linked.json", "hard.json")],
        ("-o texture.png", "--output", "input"),
        ("-o here/new.png", "--output", "twice"),
        ("--stats s.json -o ./sub/../new.png", "--output", "twice"),
    ]),
    ("", 2, [
        (f"render texture.png {NEVER} -o texture.png", "--output", "input"),
        ("convert linked.json -o scene.json", "--output", "input"),
        ("compare texture.png reference.pfm --heatmap texture.png", "--heatmap", "input"),
        ("compare reference.pfm texture.png --heatmap here/texture.png", "--heatmap", "input"),
        ("chart scene.json -q --reference reference.pfm -o chart.svg", "--output", "input"),
        ("view scene.json --ui-log texture.png", "--ui-log", "input"),
        ("view scene.json --reference reference.pfm --ui-log reference.pfm", "--ui-log", "input"),
    ]),
    ("compare", 2, [
        ("wider.pfm grey.pfm", "wider.pfm", "16x9", "16x8"),
        ("texture.png texture.png --gamma2", "--gamma2", "PPM"),
        ("texture.png texture.png --time 3", "--time", "scene"),
        ("picture.ppm quads other.ppm", "unexpected argument", "other.ppm"),
        ("picture.ppm missing.json", "missing.json"),
        *[(f"picture.ppm '{name}'", f"{name or 'REFERENCE'}: found", "expected a picture, or a scene")
          for name in ("metal-sphere", "none.txt", "sub", "")],
        ("grey.pfm grey.pfm --max-z 4", "--max-z: grey.pfm: found no grey.error.pfm beside it, expected an EXR"),
        ("noise.pfm noise.pfm --max-z 4", "noise.error.pfm: found 16x7 pixels, expected 16x8 as in noise.pfm"),
        *[(f"grey.pfm grey.pfm --max-z {value}", "--max-z: found") for value in (0, -1, "x")],
        ("grey.pfm cornell-box --max-z 4", "--max-z needs two pictures"),
        ("texture.png texture.png --update", "--baseline"),
        ("texture.png kept0/texture.png --baseline sub", "another picture of the name"),
        ("texts --baseline missing", "missing", "no such folder", "--update"),
        ("texts --baseline made --update",),
        ("texture.png --baseline sub --json", "--report"),
        ("texture.png --baseline sub --report texture.png", ".html"),
        ("texture.png --baseline kept0 --report kept0/tolerances.html", "tolerances.json", "no report's numbers"),
        ("texture.png --baseline sub --gamma2 --update", "--gamma2", "PPM"),
        *[(f"texture.png --baseline kept{number}", "tolerances.json", "found", "expected") for number in range(4)],
    ]),
    ("compare", 3, [
        ("missing.png missing.png", "missing.png"),
        ("text.png grey.pfm", "text.png"),
        ("grey.pfm grey.pfm --heatmap folder/heat.png", "folder"),
        ("large.ppm picture.ppm", "large.ppm", "99999 x 99999"),
        ("picture.ppm missing.png", "missing.png"),
    ]),
    ("convert", 2, [
        ("showroom -o a.obj", "a.obj"),
        ("reference.pfm -o a.json", "reference.pfm"),
        *[(f"{arguments} -o a.{ending}", *words, "has no equal") for ending in ("pbrt", "xml", "py")
          for arguments, *words in (("metal-spheres", "/fuzz", "expected 0"), ("perlin-spheres", "/textures", '"noise"'),
                                    ("cornell-box --set /render/fresnel=schlick", "/render/fresnel"))],
        ("checkered-spheres -o a.xml", "/textures", "checker", "has no equal"),
    ]),
    ("", 3, [
        ("convert showroom -o folder/a.json", "folder"),
        ("merge missing.exr -o m.png",),
    ]),
    (SWEEP, 2, [
        ("-o a.png --vary /materials/gold/fuzz=0:2:3", "step 3", "/materials/gold/fuzz=2", "found 2"),
        ("-o a.png --vary /materials/gild/fuzz=0:1:3", "gold"),
        ("-o a.png --vary /materials/gold/fuz=0:1:3", "fuzz"),
        ("-o a.png --vary /materials/gold/fuzz=0:1", "--vary", "FROM:TO:STEPS"),
        ("-o a.png --vary /image/width=10:20:3", "--vary", "size"),
        (f"-o a.png {FUZZ} {FUZZ}", "--vary", "twice, expected two values"),
        (f"-o a.exr {FUZZ}", "--output", ".png"),
        (f"--each a.pfm {FUZZ}", "--each", "%v"),
        (FUZZ, "SHEET.png"),
        ("-o a.png", "--vary"),
        ("-o a.png --vary /camera/vfov=30,40 --vary /render/seed=1,2 --vary /camera/focus_distance=1,2 "
         "--vary /camera/defocus_angle=1,2", "--vary", "found it 4 times"),
    ]),
    (SWEEP, 3, [(f"-o folder/a.png {FUZZ}", "folder")]),
    ("animate film.json --spp 4 -q", 2, [
        ("-o frame.png", "--output", "frame.png", "%04d"),
        ("-o %d-%d.png", "--output"),
        ("-o g%d.gif", "--output", ".png"),
        ("-o c%d.png --frame-range 2:9", "--frame-range", "4"),
        ("-o c%d.png --frame-range 2:2",),
        ("-o c%d.png --set /animation/keys/~1materials~1gold~1fuzz/3=1.5", "fuzz/3", "1.5"),
        ("-o c%d.png --seed 4294967294", "frame 2", "seed"),
    ]),
    ("animate", 2, [("cornell-box -q -o c%d.png", "--frames")]),
    ("animate film.json", 3, [("-o folder/%04d.png", "folder")]),
    ("chart cornell-box", 2, [("-o a.png", ".svg")]),
]
# The same of films, which are EXR.
REFUSED_FILMS = [
    ("merge", 2, [
        ("0.exr 2.exr -o 2.exr", "--output", "input"),
        ("0.exr gap.exr -o a.png", "gap.exr", "missing"),  # app/cli/merge has all wrong sets
        ("0.exr texture.png -o a.png", "texture.png", "film"),
        ("chains.exr scatter.exr -o a.png", "scatter.exr", "other settings"),
        ("adaptive.exr -o a.pfm", "adaptive"),
    ]),
    ("denoise", 2, [
        ("0.exr -o 0.exr", "--output", "input", "0.exr"),
        ("0.exr -o a.png --stats here/0.exr", "--stats", "input"),
        ("one.exr -o a.png", "one.exr", "fewer than 2 samples"),
        ("reference.pfm -o a.png", "reference.pfm", "no film"),
    ]),
    (SMALL, 2, [
        ("--seed 9 --spp 20 --resume -o four.exr", "four.exr"),
        ("--samples 4:20 --resume -o four.exr", "four.exr"),
        ("--spp 8 --resume -o adaptive.exr", "adaptive.exr", "other settings"),
        ("--spp 4 -o lean.exr --exr-film no --resume", "--exr-film"),
        ("--spp 4 -o lean.exr --exr-film no --checkpoint 5", "--exr-film"),
        ("--spp 2 --fresh --resume -o four.exr", "--fresh", "--resume"),
        ("--spp 2 --resume -o missing.exr", "--resume", "missing.exr"),
        ("--checkpoint -1 -o a.exr",),
    ]),
    ("", 2, [
        ("render stress-caustic-glass --size 16x12 --spp 4 --caustics scatter --resume -o chains.exr", "chains.exr",
         "other settings"),
        ("compare reference.pfm:R 0.exr", "reference.pfm:R: found a layer"),
        ("compare 0.exr:Albedo 0.exr --heatmap 0.exr",),
        ("compare texture.png 0.exr --max-z 4", "--max-z: texture.png: found a picture that does not say its noise",
         "tyndall render writes"),
        ("compare 0.exr:Albedo 0.exr --max-z 4",),
        ("compare one.exr 0.exr --max-z 4", "one.exr: found pixels with fewer than 2 samples"),
        ("compare one.exr --baseline texts --update --max-z 4", "fewer than 2 samples"),
        ("chart cornell-box --size 8x8 --budget 1 --reference 0.exr:Albdo -q -o a.svg",
         '0.exr: cannot read: found no layer "Albdo" (did you mean "Albedo"?), expected one of "Albedo", "Depth", "Ns"'),
        ("chart cornell-box --size 8x8 --budget 1 --reference left.exr -q -o a.svg", "left.exr",
         "data window 0,0,4,8 alone", "display window 0,0,8,8"),
    ]),
]


def rows(table):
    return [pytest.param(f"{start} {more}", code, words, id=f"{start} {more}".strip())
            for start, code, group in table for more, *words in group]


@pytest.mark.parametrize("command, code, words", rows(REFUSED))
def test_refused(inputs, monkeypatch, command, code, words):
    monkeypatch.chdir(inputs)
    run(command, code, *words)


@pytest.mark.parametrize("command, code, words", rows(REFUSED_FILMS))
def test_refused_films(inputs, monkeypatch, exr, command, code, words):
    monkeypatch.chdir(inputs)
    run(command, code, *words)
