"""Programs of readers of the books in place of scenes, and what is never compiled."""

import json
import math
import os
import re
import shutil

import pytest
from program import ROOT, files, pixels_of, read, run, write
from readers import BOOK, ball_of, headers, program, world

NUMBER = r"-?\d+(?:\.\d+)?(?:e-?\d+)?"


def same_scene(taken, wanted):
    """Two scenes, with options, are the same as far as a camera's members can tell it."""
    told = []
    for scene in taken, wanted:
        made = json.loads(run(f"convert {scene} -o -"))
        camera = made["camera"]
        to = [b - a for a, b in zip(camera["look_from"], camera["look_at"])]
        camera["look_at"] = [x / math.hypot(*to) for x in to]
        camera["vup"] = camera.get("vup", [0, 1, 0])[1] > 0
        told.append(json.dumps(made, sort_keys=True))
    texts, numbers = zip(*[(re.sub(NUMBER, "", text), list(map(float, re.findall(NUMBER, text)))) for text in told])
    assert texts[0] == texts[1] and numbers[0] == pytest.approx(numbers[1], 1e-9, 1e-9)


@pytest.mark.parametrize("name", ["first", "third", "newest"])
def test_editions(name):
    """Each program's scene is what it describes; its folder stays as it is. Options act on it as on any scene, and the
    picture carries it."""
    headers(".", name)
    shutil.copy(BOOK / f"{name}.cc", "main.cc")
    before = files()
    same_scene("main.cc", BOOK / f"{name}.json")
    assert files() == before
    if name == "newest":
        run("render main.cc --size 8x6 --set /camera/vfov=30 --max-depth 2 --spp 1 -q -o small.png")
        same_scene("small.png", f"{BOOK}/newest.json --set /image/width=8 --set /image/height=6 --set /camera/vfov=30 "
                   "--set /render/max_depth=2 --set /render/spp=1")


def test_own_samples():
    """What is no scene is shown by samples that the program computes itself: half of the sky, and a glow."""
    glowing = ("struct glowing : metal { using metal::metal; "
               "color emitted() const override { return color(0.25, 0, 0); } };")
    program("glow.cc", glowing + world(ball_of("make_shared<glowing>(color(0.5, 0.5, 0.5), 0.0)"),
                                       render="c.background = color(0.125, 0.25, 0.5); c.render(w);"))
    run("render glow.cc --spp 8 -q -o glow.pfm -o glow.png", 0, "glow.cc: glowing: it shines and scatters",
        "these are your own samples")
    picture = pixels_of("glow.pfm")
    assert picture[3][4] == (0.3125, 0.125, 0.25) and picture[7][0] == (0.125, 0.25, 0.5)
    assert b"own_samples" in read("glow.png")


def test_what_is_compiled():
    """A program is compiled only where it is named as the scene on the command line, and by no other way."""
    def is_compiled(command, code, **options):
        os.utime(os.environ["TMPDIR"], (0, 0))
        run(command, code, loud=True, **options)
        return os.stat(os.environ["TMPDIR"]).st_mtime != 0

    program("folder/main.cc", "int main() {}")
    texture = '{"type": "image", "file": "folder/main.cc"}'
    write("texture.json", f'{{"tyndall": 1, "textures": {{"t": {texture}}}}}')
    shutil.copy("folder/main.cc", "renamed.json")
    run("render showroom --size 8x8 --spp 1 -q -o picture.png")
    run("compare picture.png --baseline kept --update", loud=True)
    shutil.copy("folder/main.cc", "kept")
    for command, code in [
            ("inspect texture.json", 2), ("convert texture.json -o out.json", 2), ("inspect renamed.json", 2),
            ("compare folder/main.cc picture.png", 3), ("compare folder --baseline kept", 1),
            ("compare picture.png --baseline kept", 0),
            ("chart showroom --reference folder/main.cc --budget 1 -o chart.svg", 3),
            ("merge folder/main.cc -o out.exr", 2), ("denoise folder/main.cc -o out.png", 2),
            (["render", "showroom", "--set", f"/textures/t={texture}", "-o", "out.png"], 2)]:
        assert not is_compiled(command, code), command
    assert not is_compiled("inspect -", 2, given=read("folder/main.cc"))
    assert is_compiled("inspect folder/main.cc", 2)
    for file in (ROOT / "assets/desktop").rglob("*"):  # the desktop opens no C++ files by the program
        assert file.is_dir() or file.suffix == ".md" or not re.search(rb"\.(cc|cpp|cxx)|c\+\+", file.read_bytes())
