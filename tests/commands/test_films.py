"""Films: shards, merging, going on; sweeps and animations, whose pictures have the bits of render; changed textures."""

import csv
import json
import os
import pathlib
import re
import shlex
import shutil
import struct
import subprocess

import pytest
from program import (HAS_EXR, PROGRAM, ROOT, image_hash, instruction_sets, interrupted, load, pfm, png, read, rendered,
                     run, write)

SMOKE = "cornell-smoke --size 32x24"
KEYED = {
    "tyndall": 1, "image": {"width": 24, "height": 16}, "render": {"seed": 5}, "background": [0.5, 0.7, 1],
    "camera": {"look_from": [0, 0, 5], "look_at": [0, 0, 0], "vfov": 40},
    "animation": {"frames": 4, "curve": "linear", "keys": {"/materials/gold/fuzz": {"0": 0, "3": 0.3}}},
    "materials": {"gold": {"type": "metal", "albedo": [0.8, 0.6, 0.2], "fuzz": 0.3}},
    "objects": [{"type": "sphere", "center": [0, 0, 0], "radius": 1, "material": "gold"}]}


def shard(samples, name, more=""):
    run(f"render {SMOKE} --samples {samples} {more} -q -o {name}")


def test_shards(exr):
    """Merged in any order they give the picture of one render."""
    for samples, name in ("0:4", "a.exr"), ("4:9", "b.exr"), ("9:13", "c.exr"):
        shard(samples, name)
    run("merge c.exr a.exr b.exr -o all.exr -o all.pfm -o all.png", loud=True)
    whole = rendered(f"{SMOKE} --spp 13 -o one.pfm")
    assert read("all.pfm") == read("one.pfm")
    again = rendered("all.png")
    assert (again["image_hash"], again["spp"]) == (whole["image_hash"], 13)
    # A sum that cannot be written is a failure; where there are no chains, it is the same with and without them.
    os.symlink("/dev/full", "full.pfm")
    run("merge a.exr b.exr c.exr -o full.pfm", 3, "full.pfm")
    shard("0:9", "plain.exr", "--caustics scatter")
    run("merge plain.exr c.exr -o plain.pfm", loud=True)
    assert read("plain.pfm") == read("one.pfm")


def test_going_on(exr):
    whole = rendered(f"{SMOKE} --spp 13")
    run(f"render {SMOKE} --spp 5 -q -o going.exr")
    going = rendered(f"{SMOKE} --spp 13 --resume -o going.exr")
    assert going["image_hash"] == whole["image_hash"] and going["samples"] == 13 * 32 * 24
    assert 0 < going["rays"] < whole["rays"]
    words = ("--resume", "13 samples a pixel", "more than the 2 asked for")
    few = rendered(f"{SMOKE} --spp 2 --resume -o going.exr", *words)
    assert few["image_hash"] == whole["image_hash"]


def test_chains():
    """With another integrator they are ignored, and that is said."""
    balls = "stress-caustic-glass --size 16x12 -q"
    alone = f"render {balls} --spp 1 --integrator path"
    run(f"{alone} --caustics chains -o path.pfm", 0, "--caustics chains", "ignored", "path")
    run(f"{alone} -o same.pfm")
    assert read("path.pfm") == read("same.pfm")


def rows_of(table):
    return list(csv.DictReader(table.splitlines()))


SWEEP = "sweep showroom --size 32x18 --spp 4 -q"
FUZZ = "--vary /materials/gold/fuzz=0:0.4:3"


def test_sweep():
    """Pictures with the bits of render --set, a sheet, a table with the error of each difference."""
    run(f"{SWEEP} {FUZZ} -o s.png --csv s.csv --each e%v.pfm")
    rows = rows_of(read("s.csv").decode())
    assert [row["value"] for row in rows] == ["0", "0.2", "0.4"]
    for row in rows:
        value = row["value"]
        stats = rendered(f"showroom --set /materials/gold/fuzz={value} --size 32x18 --spp 4 -o one.pfm")
        assert read("one.pfm") == read(f"e{value}.pfm") and stats["image_hash"] in row.values()
    keys = ("mean", "change", "change_error", "difference_error", "spp")
    number = [{key: float(row[key]) for key in keys} for row in rows]
    middle = number[1]
    assert middle["change"] == 0 and middle["difference_error"] == 0
    for row in (number[0], number[2]):
        assert abs(row["change"] - (row["mean"] / middle["mean"] - 1)) < 1e-6
        assert row["difference_error"] > 0 and row["change_error"] > 0 and row["spp"] == 4
    run("convert s.png -o middle.json")
    assert load("middle.json")["materials"]["gold"]["fuzz"] == 0.2


def test_sweep_of_other_values():
    """Two axes, types, standard output, names of values; of a black picture nothing is a part; the time is shared."""
    rows = rows_of(run(f"{SWEEP} --vary /materials/gold/type=metal,lambertian --vary /camera/vfov=30:40:2 --csv -"))
    assert [(row["value"], row["value_2"]) for row in rows] == [
        ("metal", "30"), ("lambertian", "30"), ("metal", "40"), ("lambertian", "40")]
    run(f"{SWEEP} --vary /render/seed=1,2 --each %v.ppm --gamma2")
    assert read("1.ppm") and read("2.ppm")
    rows = rows_of(run("sweep stress-caustic-mirror --size 32x18 --spp 4 -q --set /materials/lamp/radiance=[0,0,0] "
                       "--vary /camera/vfov=30:40:2 --csv -", loud=True))
    assert [list(row.values())[4:6] for row in rows] == [["", ""]] * 2
    run("sweep showroom --vary /camera/vfov=30:40:4 --size 64x36 --total-time 0.4 -q --csv t.csv")
    assert 0.2 < sum(float(row["seconds"]) for row in rows_of(read("t.csv").decode())) < 4


def test_sweep_that_goes_on(exr):
    """Pictures in EXR are kept, and refused if they are of something else."""
    run(f"{SWEEP} {FUZZ} --each k%v.exr --csv a.csv")
    before = os.stat("k0.4.exr").st_ctime_ns
    os.remove("k0.exr")
    run(f"{SWEEP} {FUZZ} --each k%v.exr --csv b.csv", loud=True)
    assert os.stat("k0.4.exr").st_ctime_ns == before
    first, again = ([row | {"seconds": None} for row in rows_of(read(name).decode())] for name in ("a.csv", "b.csv"))
    assert first == again
    other = f"sweep showroom {FUZZ} --size 32x18 --spp 5 -q --each k%v.exr"
    run(other, 2, "k0.exr", "4 samples", "--fresh")
    run(f"{other} --fresh")


@pytest.fixture
def film():
    write("film.json", json.dumps(KEYED))
    return "animate film.json --spp 4 -q"


def hash_in(name):
    return re.search(b'image_hash": *"([0-9a-f]+)"', read(name))[1].decode()


def test_frames(film):
    """They are those of render with their values and seed, also by --frame; other commands ignore keys."""
    os.mkdir("f")
    run(f"{film} -o f/%04d.png")
    assert sorted(os.listdir("f")) == ["0000.png", "0001.png", "0002.png", "0003.png"]
    for n in range(4):
        want = image_hash(f"film.json --spp 4 --set /materials/gold/fuzz=0.{n} --seed {5 + n}")
        assert hash_in(f"f/000{n}.png") == want == image_hash(f"film.json --spp 4 --frame {n}")
    assert image_hash("film.json --spp 4") == image_hash("""film.json --spp 4 --set '/animation={"frames": 1}'""")
    run(f"{film} --seed-per-frame off -o off-%d.png")
    assert hash_in("off-2.png") == image_hash("film.json --spp 4 --set /materials/gold/fuzz=0.2")
    assert image_hash("f/0002.png") == hash_in("f/0002.png")
    run("animate metal-spheres --size 16x9 --spp 1 --turntable --frames 3 -q -o t%d.png")
    assert hash_in("t0.png") != hash_in("t1.png")
    run(f"{film} --gamma2 -o g%d.ppm")
    run("render film.json --spp 4 --frame 2 --gamma2 -q -o still.ppm")
    assert read("g2.ppm") == read("still.ppm")


def test_frames_that_are_there(film):
    """They are kept; what is missing comes back to the same bits; what does not fit is refused, --fresh replaces it."""
    run(f"{film} -o %04d.png")
    before, whole = os.stat("0001.png").st_ctime_ns, read("0002.png")
    os.remove("0002.png")
    run(f"{film} -o %04d.png", 0, "3 of 4 frames")
    assert os.stat("0001.png").st_ctime_ns == before and read("0002.png") == whole
    os.remove("0003.png")
    scalar = [] if instruction_sets() == ["scalar"] else [("--spp 4 --isa scalar", "instruction set")]
    for options, word in [("--spp 5", "4 samples a pixel, expected 5"), ("--spp 4 --seed 6", "seed 5"),
                          ("--spp 4 --set /camera/vfov=41", "another scene"), ("--spp 4 --exposure 1", "exposure"),
                          ("--spp 4 --denoise", "filtered"), *scalar]:
        run(f"animate film.json -q {options} -o %04d.png", 2, "000", word, "--fresh")
    write("0000.png", read("0000.png")[:200])
    run(f"{film} -o %04d.png", 2, "0000.png", "--fresh")
    run("animate film.json --spp 5 -q --fresh -o %04d.png")
    assert hash_in("0001.png") == image_hash("film.json --spp 5 --frame 1")


def test_frames_without_settings(film):
    """A range; formats that say nothing of how they were made have a list that does."""
    run(f"{film} --frame-range 1:3 -o r%d.pfm")
    assert sorted(pathlib.Path().glob("r?.pfm")) == [pathlib.Path("r1.pfm"), pathlib.Path("r2.pfm")]
    run("render film.json --spp 4 --frame 2 -q -o one.pfm")
    assert read("one.pfm") == read("r2.pfm")
    kept = read("rframes.pfm.list").decode()
    assert kept.count("whole") == 2
    os.remove("r1.pfm")
    write("rframes.pfm.list", re.sub("^2 whole.*\n", "", kept, flags=re.M))  # as if killed while frame 2 was written
    write("r2.pfm", "cut")
    run(f"{film} --frame-range 1:3 -o r%d.pfm", loud=True)
    assert read("one.pfm") == read("r2.pfm") and read("r1.pfm")
    run(f"{film} --frame-range 1:3 --seed 9 -o r%d.pfm", 2, "r1.pfm", "rframes.pfm.list", "--fresh")
    os.remove("rframes.pfm.list")
    run(f"{film} --frame-range 1:3 -o r%d.pfm", 2, "r1.pfm", "--fresh")


def test_video(film):
    """It goes on where it was cut, to the bytes of one run; on standard output, too."""
    run(f"{film} -o film.y4m")
    whole = read("film.y4m")
    assert len(whole) == len(whole.splitlines(True)[0]) + 4 * (6 + 3 * 24 * 16)
    for size in (0, 50, 1000, 1300, 3000):
        write("film.y4m", whole[:size])
        run(f"{film} -o film.y4m", loud=True)
        assert read("film.y4m") == whole, size
    done = subprocess.run([PROGRAM, *film.split(), "-o", "-"], capture_output=True, check=True)
    assert done.stdout == whole
    run(f"{film} --seed 1 -o film.y4m", 2, "film.y4m", "--fresh")
    run(f"{film} --frame-range 0:2 -o film.y4m", 2, "film.y4m", "4 frames", loud=True)
    assert read("film.y4m") == whole
    if HAS_EXR:  # gives its frames without rendering them again
        run(f"{film} -o e%d.exr")
        run(f"{film} -o e%d.exr -o e.y4m", loud=True)
        assert read("e.y4m") == whole


def largest_difference(raw, width, height, cut, margin):
    """Of frames of RGB, whose size is a multiple of "cut", from f0.ppm, f1.ppm, ..., in pixels whose neighbours up to
    "margin" away have their colour."""
    w, h, worst = width // cut * cut, height // cut * cut, 0
    assert len(raw) == 4 * w * h * 3
    for n in range(4):
        rgb = read(f"f{n}.ppm")[-3 * width * height:]
        rows = [[rgb[3 * (y * width + x):][:3] for x in range(width)] for y in range(height)]
        for y in range(h):
            for x in range(w):
                around = rows[max(y - margin, 0):y + margin + 1]
                if len({c for row in around for c in row[max(x - margin, 0):x + margin + 1]}) == 1:
                    worst = max(worst, *(abs(a - b) for a, b in zip(rows[y][x], raw[3 * ((n * h + y) * w + x):][:3])))
    return worst


@pytest.mark.parametrize("size", ["64x48", "65x47"])
@pytest.mark.skipif(not shutil.which("ffmpeg") or not shutil.which("ffprobe"), reason="ffmpeg is not installed")
def test_colours_of_videos(size):
    """As FFmpeg reads them: the colours of the frames, and of the file that the page's command makes."""
    quads = {"red": ([-3, 0, 0], [1, 0, 0]), "green": ([0, 0, 0], [0, 1, 0]), "blue": ([-3, -2, 0], [0.05, 0.3, 0.6]),
             "brown": ([0, -2, 0], [0.5, 0.2, 0.05])}
    write("film.json", json.dumps({
        "tyndall": 1, "camera": {"look_from": [0, 0, 4], "look_at": [0, 0, 0], "vfov": 40},
        "animation": {"frames": 4, "keys": {"/objects/0/v": {"0": [0, 2, 0], "3": [0, 1.5, 0]}}},
        "materials": {name: {"type": "light", "radiance": colour} for name, (_, colour) in quads.items()},
        "objects": [{"type": "quad", "corner": corner, "u": [3, 0, 0], "v": [0, 2, 0], "material": name}
                    for name, (corner, _) in quads.items()]}))
    shown = re.search(r"tyndall animate film.json -o - \|.*?film\.mp4", run("animate --help"), re.S)[0]
    page = re.search("^tyndall animate.*film.mp4", (ROOT / "app/cli/README.md").read_text(), re.M)[0]
    assert shlex.split(shown.replace("\\\n", " ")) == shlex.split(page)
    os.mkdir("bin")
    write("bin/tyndall", f'#!/bin/sh\nexec "{PROGRAM}" "$@" -q --spp 1 --size {size}\n')
    os.chmod("bin/tyndall", 0o755)
    width, height = map(int, size.split("x"))
    run(f"animate film.json --spp 1 --size {size} -q -o f%d.ppm")
    raw = "-f rawvideo -pix_fmt rgb24 -y raw"
    path = {"PATH": f"{os.getcwd()}/bin:{os.environ['PATH']}"}

    def shell(command):
        return subprocess.run(["bash", "-c", command], check=True, capture_output=True, env=os.environ | path).stdout
    shell(f"set -o pipefail; tyndall animate film.json -o - | ffmpeg -v error -i - {raw}")
    assert largest_difference(read("raw"), width, height, 1, 0) <= 2
    shell(shown)
    told = shell("ffprobe -v error -show_streams film.mp4").decode().splitlines()
    assert {"codec_name=h264", "pix_fmt=yuv420p", "color_space=smpte170m", "color_range=tv", "color_primaries=bt709",
            "color_transfer=iec61966-2-1"} <= set(told)
    shell(f"ffmpeg -v error -i film.mp4 {raw}")
    assert largest_difference(read("raw"), width, height, 2, 6) <= 3


# What a picture is made of includes the pixels of its textures and its sky: where their files have changed since, each
# command does what it does for a changed scene. The same pixels under another name or stored otherwise are the same.
OTHER = "other pixels in its textures or sky"
SILENT = "does not say which pixels its textures and sky had; those of now are taken"
TEX = "render tex.json -q"
TURN = "animate tex.json --turntable --frames 2 --spp 4 -q"
VARY = "sweep tex.json --vary /camera/vfov=[30,40] --spp 4 -q --each v%v.exr"


def grey(name, light, level=9):
    png(name, [light] * 6, rows=2, level=level)


def write_textured(texture="t.png"):
    write("tex.json", json.dumps({
        "tyndall": 1, "image": {"width": 8, "height": 8}, "camera": {"vfov": 40},
        "background": {"type": "image", "file": "sky.pfm"}, "textures": {"t": {"type": "image", "file": texture}},
        "materials": {"m": {"type": "lambertian", "albedo": "t"}},
        "objects": [{"type": "quad", "corner": [-9, -1, -9], "u": [18, 0, 0], "v": [0, 0, 18], "material": "m"}]}))


@pytest.fixture
def textured(exr):
    grey("t.png", 100)
    pfm("sky.pfm", 2, 1, 0.5, 0.5, 0.5)
    write_textured()


@pytest.mark.parametrize("change", [lambda: grey("t.png", 255), lambda: pfm("sky.pfm", 2, 1, 1, 1, 1)])
def test_changed_textures(textured, change):
    interrupted(f"{TEX} --spp 400000 --threads 1 --checkpoint 0 -o a.exr", 0.3)
    run(f"{TEX} --samples 0:4 -o first.exr")
    run(f"{TURN} -o f%d.png")
    run(f"{TURN} -o f%d.ppm -o film.y4m")
    run(VARY)
    change()
    run(f"{TEX} --spp 400000 -o a.exr", 2, "a.exr", OTHER, "--fresh")
    run(f"{TEX} --spp 8 --resume -o first.exr", 2, "first.exr", OTHER, "--fresh")
    run(f"{TEX} --samples 4:8 -o second.exr")
    run("merge first.exr second.exr -o sum.exr", 2, "second.exr", OTHER, "as in first.exr")
    run(f"{TURN} -o f%d.png", 2, "f0.png", OTHER, "--fresh")
    run(f"{TURN} -o f%d.ppm", 2, "f0.ppm", "another scene", "--fresh")
    run(f"{TURN} -o film.y4m", 2, "film.y4m", "--fresh")
    run(VARY, 2, "v30.exr", OTHER, "--fresh")
    run("denoise first.exr -o clean.pfm", 0, "first.exr", "its textures or sky have other pixels now")
    for snapshot in ("f0.png", "first.exr"):
        run(f"render {snapshot} --spp 4 -q -o snapshot.pfm", 0, snapshot,
            "its textures or sky have other pixels now than when the picture was made")
    for command in (f"{TURN} -o f%d.png", f"{TURN} -o f%d.ppm", VARY):
        run(f"{command} --fresh")


def test_same_pixels(textured):
    """A finished film of other pixels is replaced. The same pixels agree: stored otherwise, or in another file."""
    run(f"{TEX} --spp 4 -o a.exr")
    grey("t.png", 255)
    run(f"{TEX} --spp 4 -o a.exr -o a.pfm")
    run(f"{TEX} --spp 4 -o now.pfm")
    assert read("a.pfm") == read("now.pfm")
    grey("t.png", 100)
    grey("again.png", 100, level=0)
    assert read("again.png") != read("t.png")
    run(f"{TEX} --samples 0:4 -o first.exr")
    shutil.copy("again.png", "t.png")
    run(f"{TEX} --samples 4:8 -o second.exr")
    write_textured("again.png")
    grey("t.png", 255)
    run(f"{TEX} --samples 8:12 -o third.exr")
    run("merge third.exr first.exr second.exr -o sum.exr -o sum.pfm")
    run(f"{TEX} --spp 12 -o whole.pfm")
    assert read("sum.pfm") == read("whole.pfm")
    run(f"{TEX} --spp 20 --resume -o sum.exr")


def unlabel(*names):
    """Makes films and pictures say nothing of pixels, as those of version 0.2.0."""
    for name in names:
        data = read(name)
        for label in (b"contents", b"checksum"):
            data = data.replace(b"tyndall:" + label, b"another:" + label)
        at = data.find(b"iTXtanother:contents")
        if at >= 0:
            data = data[:at - 4] + data[at + 8 + struct.unpack(">I", data[at - 4:at])[0]:]
        write(name, data)


def test_pictures_that_say_nothing_of_pixels(textured):
    """Those of version 0.2.0 are taken, and told. Where there are no pictures, nothing is written or said."""
    for samples, name in ("0:4", "first.exr"), ("4:8", "second.exr"):
        run(f"{TEX} --samples {samples} -o {name}")
    shutil.copy("first.exr", "going.exr")
    one = "animate tex.json --turntable --frames 1 --spp 4 -q -o f%d.png"
    run(one)
    unlabel("first.exr", "going.exr", "f0.png")
    run(f"{TEX} --spp 6 --resume -o going.exr", 0, f"going.exr: {SILENT}")
    run("merge second.exr first.exr -o sum.exr", 0, f"first.exr: {SILENT}")
    run("denoise first.exr -o clean.pfm", 0, f"first.exr: {SILENT}")
    run("render f0.png -q -o snapshot.pfm", 0, f"f0.png: {SILENT}")
    run(one, 0, f"f0.png: {SILENT}", lines=2)
    run("render cornell-box --size 8x8 --spp 2 -q -o box.png -o box.exr")
    assert b"tyndall:contents" not in read("box.png") + read("box.exr")
    run("render box.png -q -o again.pfm")
    run("denoise box.exr -o again.pfm")
