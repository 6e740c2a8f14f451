"""Pictures that hold NaN and infinity, and names that hold anything, of files, scenes, objects, materials and methods:
what is written is well-formed, messages are one line each, and pictures carry the names unchanged."""

import json
import os
import re
import shutil

import pytest
from program import load, pfm, read, run, write
from well_formed import well_formed

GREY, NAN, INF = (0.5, 0.5, 0.5), float("nan"), float("inf")


def fails(pixels, place):
    """compare of one picture and of a baseline, with and without limits, in all its forms."""
    line = f"{pixels} of 128 pixels (is|are) not finite, the first at {re.escape(place)}"
    for limits in "", "--max-relmse 1e30":
        run(f"compare r/a.pfm k/a.pfm {limits}", 1, re.compile(f"^tyndall: check failed: [rk]/a.pfm: {line}", re.M))
        run(f"compare r --baseline k {limits} --report report.html --junit junit.xml", 1,
            re.compile(f"^tyndall: a.pfm: [rk]/a.pfm: {line}", re.M), out=re.compile("^FAILED a.pfm", re.M))
        assert re.search(f"<failure.*{line}", read("junit.xml").decode())
        assert re.search(line, read("report.html").decode())
        well_formed("report.html", "junit.xml")
    compared = json.loads(run("compare r/a.pfm k/a.pfm --json --heatmap heat.png", 1))
    assert re.search(line, json.dumps(compared["not_finite"])) and read("heat.png")
    return compared


@pytest.mark.parametrize("rendered, kept, pixels, place", [
    ({"x3y1": (0, NAN, 0), "x2y7": (NAN, NAN, NAN)}, {}, 2, "3,1 (green is nan)"),
    ({}, {"x0y6": (-INF, 0, 0)}, 1, "0,6 (red is -inf)"),
    ({"x15y0": (0, 0, INF)}, {"x15y0": (0, 0, INF)}, 1, "15,0 (blue is inf)")])
def test_not_finite(rendered, kept, pixels, place):
    """Equal to nothing, wherever it is."""
    pfm("r/a.pfm", 16, 8, *GREY, **rendered)
    pfm("k/a.pfm", 16, 8, *GREY, **kept)
    fails(pixels, place)


def test_all_not_finite():
    """FLIP takes NaN for black: its map shows it as what differs most."""
    pfm("r/a.pfm", 16, 8, NAN, NAN, NAN)
    pfm("k/a.pfm", 16, 8, 0, 0, 0)
    assert fails(128, "0,0 (red is nan)")["flip"] == 1
    assert json.loads(run("compare k/a.pfm k/a.pfm --json --max-flip 0"))["not_finite"] == []


def test_baselines_take_finite_pictures():
    """They are not changed for the good ones beside others."""
    pfm("good/a.pfm", 16, 8, *GREY)
    pfm("r/a.pfm", 16, 8, *GREY)
    pfm("r/b.pfm", 16, 8, *GREY, x4y2=(0, NAN, 0))
    run("compare good --baseline k --update --max-flip 0.5")
    for folder in ("k", "new"):
        run(f"compare r --baseline {folder} --update --max-flip 0.1", 2, "r/b.pfm",
            "1 of 128 pixels is not finite, the first at 4,2 (green is nan)", "expected finite values")
    write("r/b.pfm", "none\n")
    run("compare r --baseline k --update --max-flip 0.1", 3, "r/b.pfm")
    pfm("reference.pfm", 16, 8, 0.5, 0.5, INF)
    run("chart cornell-box --size 16x8 --budget 1 -q -o chart.svg --reference reference.pfm", 2, "reference.pfm",
        "128 of 128 pixels are not finite, the first at 0,0 (blue is inf)")


CLIPPED = re.compile(r"^tyndall: a.pfm: relMSE among the 3 values outside \[0, 1\], which FLIP clips, is 0.01332.*, "
                     "expected at most 0.01$", re.M)


@pytest.mark.parametrize("code, kept, rendered, options, words", [
    (1, (5, 5, 5), (6, 5, 5), "", [CLIPPED]),
    (0, (5, 5, 5), (5.5, 5, 5), "", []),  # 0.25 / 25.01 / 3
    (0, (5, 5, 5), (6, 5, 5), "--max-flip 0.03", []),
    (0, (5, 5, 5), (6, 5, 5), "--max-relmse 1", []),
    (0, (0.5, 0.5, 0.5), (0.51, 0.5, 0.5), "", [])])  # relMSE of 0.01 is not asked of what FLIP sees
def test_what_flip_clips(code, kept, rendered, options, words):
    """The default check: it may differ by relMSE 0.01, and the page has the measured value."""
    pfm("k/a.pfm", 16, 8, *GREY, x1y1=kept)
    pfm("r/a.pfm", 16, 8, *GREY, x1y1=rendered)
    run("compare k --baseline k --update")
    run(f"compare r --baseline k --report report.html {options}", code, *words, lines=9)
    assert not words or "relMSE outside" in read("report.html").decode()


NAMES = [os.fsdecode(name) for name in [
    b"ctl\x01x", b"esc\x1b[31m", b"del\x7f", b"bytes\xffutf", b"cut\xc3", b"surrogate\xed\xa0\x80",
    b"long form\xc0\xaf", b"non\xef\xbf\xbe", b"\xef\xbf\xbf", b"line\nfeed", b"return\r", b"tab\t",
    b"next\xc2\x85line", b"separator\xe2\x80\xa8", b"turned\xe2\x80\xae", b'"quotes" \'and\'',
    b"<b>&amp; & ]]>", b"--> <!--", b"per%cent %s {} {0}", b"-dash", rb"back\slash\n", b"$HOME `id`", b" spaces ",
    "Grüße, 世界 🙂".encode(), b"#?*", "ä".encode() * 125, b"\x01" * 250]]


def test_baselines_of_odd_names():
    """Tolerances are found again, each by its name; and each failure is one line."""
    for name in NAMES:
        pfm(f"r/{name}.pfm", 16, 8, *GREY)

    def check(code, pattern, lines, **options):
        printed = run("compare r --baseline k --report report.html --junit junit.xml", code, loud=True, **options)
        assert len(re.findall(pattern, printed, re.M)) == lines
        well_formed("report.html", "junit.xml")
    assert run("compare r --baseline k --update --max-flip 0.5").count("\n") == len(NAMES)
    assert all(read(f"r/{name}.pfm") == read(f"k/{name}.pfm") for name in NAMES)
    well_formed("k/tolerances.json")
    check(0, "^ok ", len(NAMES))
    kept = load("k/tolerances.json")
    assert len(kept) == len(NAMES) and {"ctl\x01x.pfm", "bytes\\xffutf.pfm"} <= set(kept)
    write("k/tolerances.json", json.dumps({name: limits | {"max_flip": 0.0001} for name, limits in kept.items()}))
    for name in NAMES:
        pfm(f"r/{name}.pfm", 16, 8, 0.9, 0.5, 0.5)
    one_line_each = "(tyndall: .*{}\n){{%d}}" % len(NAMES)
    check(1, "\n", len(NAMES), by=[*SAID_TO_FILE])
    assert re.fullmatch(one_line_each.format("FLIP is .*, expected at most 0.0001"), read("said").decode())
    shutil.rmtree("r")
    os.mkdir("r")
    check(1, "\n", len(NAMES), by=[*SAID_TO_FILE])
    assert re.fullmatch(one_line_each.format("it was not rendered.*"), read("said").decode())


SAID_TO_FILE = ["sh", "-c", 'exec "$0" "$@" 2>said']
ODD = "ctl \x01 \x1b \n \t \x7f \x85 \u2028 \ufffe \uffff ]]> <b> & \"q\" 'a' \\ % {} \U0001f642 " + "ä" * 200
SCENE = {
    "tyndall": 1, "image": {"width": 8, "height": 8}, "textures": {ODD: {"type": "solid", "color": [0.5, 0.5, 0.5]}},
    "materials": {ODD: {"type": "lambertian", "albedo": ODD}, "lamp": {"type": "light", "radiance": [1, 1, 1]}},
    "objects": [{"name": ODD, "type": "sphere", "center": [0, 0, -3], "radius": 1, "material": ODD},
                {"name": "lamp", "type": "sphere", "center": [0, 3, -3], "radius": 1, "material": "lamp"}]}


def test_scenes_of_odd_names(exr):
    write("odd.json", json.dumps(SCENE | {"name": ODD}))
    run("convert odd.json -o normal.json")
    run("render odd.json --spp 2 -q -o odd.png -o odd.exr --stats stats.json", loud=True)
    well_formed("normal.json", "stats.json")
    for image in ("odd.png", "odd.exr"):
        run(f"convert {image} -o back.json")
        normal, back = load("normal.json"), load("back.json")
        assert all(normal[key] == back[key] for key in ("name", "textures", "materials", "objects"))
    write("inspected.json", run("inspect odd.png --json"))
    well_formed("inspected.json")
    box = [line for line in run("inspect cornell-box").splitlines() if not line.startswith("  ")]
    assert run("inspect odd.exr").count("\n") == len(box)
    run("render odd.json --replay 4,4,0")
    write("bad.json", json.dumps(SCENE).replace("solid", "sol\\u0001\\nid"))
    run("render bad.json -o bad.png", 2, "bad.json")
    # A texture behind a folder's name that JSON cannot hold.
    folder = os.fsdecode(b"folder\xff")
    os.mkdir(folder)
    shutil.copy("odd.png", f"{folder}/t.png")
    write(f"{folder}/scene.json", json.dumps(SCENE | {"textures": {ODD: {"type": "image", "file": "t.png"}}}))
    run(["convert", f"{folder}/scene.json", "-o", "outside.json"])
    well_formed("outside.json")
    run("inspect outside.json", 2, "outside.json", "/textures/", "xff/t.png")


def test_charts_of_odd_names():
    write("odd.json", json.dumps(SCENE | {"name": ODD}))
    pfm("r.pfm", 8, 8, *GREY)
    methods = ["--method", b'a <b> & "c" \x01\x1b\xff\n=', "--method", "--> ]]>="]
    assert run(["chart", "odd.json", "--budget", "0.3", "-q", "-o", "chart.svg", *methods]).count("\n") == 3
    well_formed("chart.svg")
    for name in NAMES[:24]:
        write(f"./{name}.json", json.dumps(SCENE))
        options = "--budget 0.05 -q --reference r.pfm --method x=".split()
        run(["chart", f"./{name}.json", "-o", f"./{name}.svg", *options])
        well_formed(f"./{name}.svg")


@pytest.mark.parametrize("name", NAMES)
def test_messages_of_odd_names(name):
    write("odd.json", json.dumps(SCENE))
    pfm("odd.pfm", 8, 8, *GREY)
    for code, word, *command in [
            (2, "found", "render", f"./{name}.nothing", "-o", "a.png"),
            (2, "twice", "render", "odd.json", "-o", f"./{name}.png", "-o", f"./{name}.png"),
            (3, "cannot read", "compare", f"./{name}.pfm", "odd.pfm"),
            (3, "there is no folder", "render", "odd.json", "-o", f"./{name}/a.png"),
            (2, "found", "render", "odd.json", "-o", "a.png", "--set", f"/name{name}=1"), (2, "found", f"x{name}")]:
        run(command, code, word)
