"""render: what it writes and says, and that the picture depends on nothing but scene and settings."""

import json
import os
import pathlib
import re
import shutil
import struct
import subprocess

import pytest
from program import (HAS_EXR, PROGRAM, ROOT, files, image_hash, instruction_sets, interrupted, load, pixels_of, png,
                     read, rendered, run, same_picture, write)

BOX = "cornell-box --size 40x30 --spp 4"
EXR = ["exr"] * HAS_EXR
CORNELL = ROOT / "assets/scenes/cornell-box.json"


def test_formats():
    """Every format is written; nothing is said of a short render, and nothing printed."""
    names = ["a.png", "a.pfm", "a.hdr", *(["A.EXR"] * HAS_EXR)]
    assert not run(f"render {BOX} {' '.join('--output=' + name for name in names)} --stats a.json")
    assert read("a.png")[1:4] == b"PNG" and read("a.pfm").startswith(b"PF\n40 30\n")
    same_picture("a.pfm", "a.pfm")
    if HAS_EXR:
        same_picture("A.EXR", "a.pfm")
    run("compare a.hdr a.pfm --max-relmse 0.001")
    run("compare a.png a.pfm --max-flip 0.1")


def test_figures():
    """They are true; files/stats has their names."""
    stats = rendered(BOX)
    assert [stats[key] for key in ("scene", "width", "height")] == ["cornell-box", 40, 30]
    assert stats["spp"] == 4 and stats["samples"] == 4 * 40 * 30
    assert stats["split_events"] == 0  # no glass
    assert stats["rays"] >= stats["samples"] and 0 < stats["shadow_rays"] < stats["rays"]
    assert 0 < stats["seconds_render"] <= stats["seconds_total"] >= stats["seconds_build"] >= 0
    assert abs(stats["mrays_per_s"] * stats["seconds_render"] * 1e6 / stats["rays"] - 1) < 1e-6
    assert stats["threads"] >= 1 and stats["lanes"] >= 1 and stats["isa"]
    assert {"boxes", "quads", "lambertian", "lights"} <= set(stats["kernel_features"])
    assert not {"media", "metal", "dielectric"} & set(stats["kernel_features"])
    assert [stats[key] for key in ("integrator", "sampler", "fresnel")] == ["mis", "sobol", "exact"]
    assert 0 < stats["relative_error_estimate"] < 10 and stats["rejected_samples"] == 0
    assert 1e6 < stats["peak_memory_bytes"] < 1e9
    assert re.fullmatch("[0-9a-f]{16}", stats["image_hash"])
    assert rendered("cornell-box --size 8x8 --spp 1")["relative_error_estimate"] is None  # of one sample


@pytest.mark.parametrize("arguments", [
    f"{BOX} -t 1", f"{BOX} -t 2", f"{BOX} -t 7", f"'{CORNELL}' --size 40x30 --spp 4", "- --size 40x30 --spp 4"])
def test_same_picture_by(arguments):
    """Threads, and the way in which the scene comes, do not change the picture."""
    found = rendered(arguments, given=CORNELL.read_bytes() if arguments[0] == "-" else b"")["image_hash"]
    assert found == image_hash(BOX)


def test_settings():
    assert image_hash(f"{BOX} --seed 1") != image_hash(BOX)
    write("edited.json", CORNELL.read_text().replace('"vfov": 40', '"vfov": 30'))
    assert image_hash(f"{BOX} --set /camera/vfov=30") == image_hash("edited.json --size 40x30 --spp 4")


@pytest.mark.parametrize("ending", ["png", *EXR])
def test_opened_again(ending):
    """A picture is the scene that made it, with the settings that were used."""
    first = image_hash("cornell-box --size 24x18 --spp 3 --seed 5 --max-depth 4 --exposure 1 --fresnel schlick --set "
                       "/camera/look_from=[278,278,-700] --set /materials/white/albedo=[0.5,0.6,0.7] "
                       f"-o again.png{' -o again.exr' * HAS_EXR}")
    assert image_hash(f"again.{ending} -o second.png") == first
    assert read("again.png") == read("second.png")


def test_opened_again_with_a_texture():
    pathlib.Path("deep/er").mkdir(parents=True)
    assert image_hash("earth --size 24x18 --spp 2 -o deep/er/earth.png") == image_hash("deep/er/earth.png")


def test_region():
    """It holds the same pixels as the whole picture."""
    run(f"render {BOX} -q -o a.pfm")
    assert rendered(f"{BOX} --region 8,4,24,20 -o part.pfm")["width"] == 16
    assert pixels_of("part.pfm") == [row[8:24] for row in pixels_of("a.pfm")[4:20]]


def test_limits():
    """The scene's own count, time, and error."""
    assert rendered("cornell-box --size 8x8")["spp"] == 200
    assert rendered("cornell-box --size 8x8 --set /render={}")["spp"] == 64
    assert 0.3 <= rendered("cornell-box --size 64x64 --time 0.3")["seconds_render"] < 20
    assert rendered("metal-spheres --size 16x16 --target-error 0.05")["relative_error_estimate"] <= 0.05


def test_warning_of_rare_paths():
    rendered("stress-light-and-fuzz --size 16x16 --spp 4", "not converged: rare bright paths")


@pytest.mark.parametrize("isa", instruction_sets())
def test_instruction_set(isa):
    run(f"render {BOX} -q -o a.pfm")
    assert rendered(f"{BOX} --isa {isa}")["isa"] == isa
    run("compare x.pfm a.pfm --max-relmse 0.05")


def test_instruction_sets_that_are_not_built():
    """One that this processor has is refused with the command that builds it."""
    assert "built_sets" in json.loads(run("inspect quads --json"))
    missing = re.search(r"could run ([a-z0-9 ]*);", run("version"))
    for isa in missing[1].split() if missing else []:
        for command in ("render quads --spp 1 -o x.png", "sweep quads --vary /camera/vfov=30:40:2 -o x.png",
                        "inspect quads --measure"):
            run(f"{command} --isa {isa}", 2, re.compile(f'found "{isa}".*TYNDALL_INSTRUCTION_SETS=all ./run'))


@pytest.mark.parametrize("ending", ["png", "pfm", "hdr", "ppm", *EXR])
def test_standard_output(ending):
    """It gets what a file gets; so does a pipe."""
    scene = "cornell-box --size 20x16 --spp 2 -q"
    run(f"render {scene} -o file.{ending}")
    with open("stream", "wb") as stream:
        done = subprocess.run([PROGRAM, "render", *scene.split(), "-o", "-", "--format", ending], stdout=stream,
                              stderr=subprocess.PIPE, check=True)
    assert not done.stderr
    if ending in ("exr", "png"):  # which carry how long the run took
        same_picture("stream", f"file.{ending}")
    else:
        assert read("stream") == read(f"file.{ending}")
    assert len(run(f"render {scene} -o - --format {ending}")) > 100


def test_named_pipe():
    """It is written to, not replaced, and opened only when the picture is there."""
    os.mkfifo("pipe.pfm")
    with subprocess.Popen(["cat", "pipe.pfm"], stdout=subprocess.PIPE) as reader:
        run("render cornell-box --size 20x16 --spp 2 -q -o pipe.pfm -o file.pfm")
        assert reader.stdout.read() == read("file.pfm")
    assert pathlib.Path("pipe.pfm").is_fifo()


def test_read_from_pipes():
    """Pictures, and scenes. EXR is not read in order, and says so."""
    run(f"render {BOX} -q -o file.png")
    shell = ["bash", "-c", '"$0" compare <(cat file.png) <(cat file.png) --max-rmse 0']
    run("", by=shell)
    run("", by=["bash", "-c", '"$0" render <(echo "{ \\"tyndall\\": 1 }") --size 4x4 --spp 1 -q -o none.png'])
    if HAS_EXR:
        run(f"render {BOX} -q -o file.exr -o file.pfm")
        run("", 3, "an EXR in a pipe", by=["bash", "-c", '"$0" compare <(cat file.exr) file.png'])
        run("", by=["bash", "-c", '"$0" merge file.exr -o - --format pfm >merged.pfm'])
        assert read("merged.pfm") == read("file.pfm")


def test_threads():
    """As many as processors which the process may use; the figures say what decided it. Quotas: system/processors."""
    small = "cornell-box --size 16x16 --spp 2"

    def decided(more="", **options):
        stats = rendered(f"{small} {more}", **options)
        return stats["threads"], stats["threads_from"]
    processors = sorted(os.sched_getaffinity(0))
    assert decided("-t 3") == (3, "option")
    assert decided()[0] == len(processors)
    if len(processors) == 1 or not shutil.which("taskset"):
        pytest.skip("one processor, or no taskset: bound processes were not tested")
    assert decided(by=["taskset", "-c", str(processors[0])]) == (1, "affinity")
    assert load("x.json")["image_hash"] == image_hash(small)


def test_adaptive():
    room = "showroom --size 60x40 --spp 40"
    stats = rendered(f"{room} --adaptive -o a.png -o a.pfm")
    assert stats["spp"] == 40 and stats["adaptive"] is True and stats["samples"] <= 60 * 40 * 40
    assert stats["least_spp"] < 40 < stats["most_spp"]
    # The setting is the scene's: in the picture, in its normal form, and by --set.
    for same in ("a.png", f"{room} --set /render/adaptive=true", f"{room} --adaptive -t 1"):
        assert image_hash(same) == stats["image_hash"], same
    run("convert a.png -o a-scene.json")
    assert load("a-scene.json")["render"]["adaptive"] is True
    even = rendered("a.png --set /render/adaptive=false")
    assert (even["adaptive"], even["least_spp"], even["most_spp"]) == (False, 40, 40)
    if HAS_EXR:
        run("render showroom --size 60x40 --spp 20 --adaptive -q -o going.exr")
        assert image_hash(f"{room} --adaptive --resume -o going.exr") == stats["image_hash"]


def test_adaptive_interrupted():
    """The picture so far, with the mean of its samples."""
    interrupted("render showroom --size 60x40 --spp 10000000 --adaptive -o long.png --stats long.json -q", 2)
    stats = load("long.json")
    assert stats["least_spp"] < stats["spp"] < stats["most_spp"]
    assert json.loads(run("convert long.png -o -"))["render"]["spp"] == stats["spp"]


def test_adaptive_in_a_chart():
    run("chart showroom --size 40x30 --budget 0.3 -q --method even= --method adaptive=--adaptive -o chart.svg")
    assert "\nadaptive,16," in read("chart.csv").decode()


def test_denoised():
    """Filtered pictures: only when asked, labelled, the film untouched."""
    scene = "cornell-box --size 48x40 --spp 4"
    raw = rendered(f"{scene} -o raw.pfm")
    clean = rendered(f"{scene} -o clean.pfm -o clean.png --denoise")
    assert clean["image_hash"] == raw["image_hash"] and read("raw.pfm") != read("clean.pfm")
    assert (raw["denoised"], clean["denoised"]) == (False, True)
    assert raw["denoised_relative_error_estimate"] is raw["denoised_hash"] is None
    assert 0 < clean["denoised_relative_error_estimate"] < clean["relative_error_estimate"] / 2
    assert 0 < clean["seconds_denoise"] < 60
    assert re.search(b'"denoised": *true', read("clean.png"))
    run("render clean.png -q -o again.pfm")
    assert read("again.pfm") == read("raw.pfm")
    target = rendered("cornell-box --size 192x160 --target-error 0.1 --denoise")
    assert target["denoised_relative_error_estimate"] <= 0.1 < target["relative_error_estimate"]


def test_denoised_films(exr):
    """The same of a render, of merged parts and of a film that is read again."""
    scene = "cornell-box --size 48x40"
    raw = rendered(f"{scene} --spp 4 -o raw.pfm")
    clean = rendered(f"{scene} --spp 4 -o clean.pfm -o whole.exr --denoise")
    run("denoise whole.exr -o read.pfm -o read.exr --stats read.json", loud=True)
    assert read("read.pfm") == read("clean.pfm")
    assert load("read.json")["denoised_hash"] == clean["denoised_hash"]
    assert load("read.json")["image_hash"] == raw["image_hash"]
    for name in ("whole.exr", "read.exr"):
        for channel in (b"denoised.R", b"denoised.G", b"denoised.B", b"denoised.error"):
            assert channel in read(name)
        same_picture(name, "raw.pfm")
    for part in ("0:2", "2:4"):
        run(f"render {scene} --samples {part} -q -o part-{part[0]}.exr")
    run("merge part-2.exr part-0.exr --denoise -o merged.pfm", loud=True)
    assert read("merged.pfm") == read("clean.pfm")


def test_dither():
    """PNG is dithered, unless that is switched off; nothing else is."""
    for name, options in ("on", ""), ("off", "--dither off"):
        run(f"render quads --size 32x24 --spp 2 -q -o {name}.png -o {name}.pfm {options}")
    assert read("on.pfm") == read("off.pfm") and read("on.png") != read("off.png")
    run("render off.png -o again.png -q")
    same_picture("again.png", "off.png")


def test_lean_films(exr):
    """The same picture in a smaller file."""
    run("render quads --size 128x96 --spp 2 -q -o lean.exr --exr-film no")
    run("render quads --size 128x96 --spp 2 -q -o full.exr -o full.pfm")
    same_picture("lean.exr", "full.pfm")
    assert len(read("lean.exr")) < len(read("full.exr")) * 2 / 3


def scene_of(picture, shape):
    """A white sky over an object that fills the picture."""
    return json.dumps({
        "tyndall": 1, "image": {"width": 64, "height": 64}, "background": [1, 1, 1], "render": {"max_depth": 1},
        "camera": {"look_from": [0, 0, 3], "look_at": [0, 0, 0], "vfov": 53.13010235415598},
        "textures": {"t": {"type": "image", "file": picture}},
        "materials": {"m": {"type": "lambertian", "albedo": "t"}}, "objects": [shape | {"material": "m"}]})


QUAD = {"type": "quad", "corner": [-1, -1, 1], "u": [2, 0, 0], "v": [0, 2, 0]}
CUBE = {"type": "box", "min": [-1, -1, -1], "max": [1, 1, 1]}
RED, GREEN, BLUE = [255, 0, 0], [0, 255, 0], [0, 0, 255]


@pytest.mark.parametrize("isa", instruction_sets())
@pytest.mark.parametrize("shape, more", [
    (QUAD, ""), (CUBE, ""), (CUBE | {"transform": [{"rotate_y": 90}]}, ""),
    (QUAD, """--set '/materials/m={"type":"light","radiance":"t"}'""")])
def test_edges_of_textures(shape, more, isa):
    """Half a texel at each side has the colour of its own edge alone."""
    png("columns.png", RED + GREEN + GREEN + BLUE)
    write("scene.json", scene_of("columns.png", shape))
    run(f"render scene.json {more} --spp 8 --isa {isa} -q -o edges.pfm")
    for x, (red, green, blue) in enumerate(pixels_of("edges.pfm")[31]):
        assert x > 7 or (red > 0.5 and green == 0 and blue == 0), x
        assert x < 56 or (blue > 0.5 and green == 0 and red == 0), x
        assert not 8 <= x < 56 or red == 0 or blue == 0, x


def test_colour_of_textures():
    """What the clean view and a replay know of the surface is the same colour."""
    png("columns.png", RED + GREEN + GREEN + BLUE)
    write("quad.json", scene_of("columns.png", QUAD))
    run("render quad.json --replay 2,32,0", out=re.compile("m .*\\(?1 0 0|colour +1 0 0|throughput +1 0 0"))
    if HAS_EXR:
        run("render quad.json --spp 8 -q -o quad.exr -o quad.pfm")
        run("compare quad.exr:Albedo quad.pfm --json --max-rmse 0.01", loud=True)


def test_alpha():
    """A line when it is loaded, one in inspect; none for pictures without. The picture is that without."""
    words = 'texture "t" has an alpha channel'
    png("columns.png", RED + GREEN + GREEN + BLUE)
    png("alpha.png", RED + [255] + GREEN + [0] + GREEN + [0] + BLUE + [255], alpha=True)
    for name, picture in ("quad.json", "columns.png"), ("alpha.json", "alpha.png"):
        write(name, scene_of(picture, QUAD))
    said = f"tyndall: alpha.json: {words}, which is not looked at: what is hidden beneath it is shown\n"
    run("render alpha.json --spp 8 -q -o alpha.pfm", 0, re.compile(f"\\A{re.escape(said)}\\Z"))
    run("render quad.json --spp 8 -q -o quad.pfm")
    assert read("alpha.pfm") == read("quad.pfm")
    assert run("inspect alpha.json").count(words) == 1
    assert json.loads(run("inspect alpha.json --json"))["textures_with_alpha"] == ["t"]
    assert "alpha" not in run("inspect quad.json")


def test_numbers_of_textures():
    """All 16 bits count, and what a file says of its pixels is told once."""
    for name, low in ("low.ppm", 0), ("high.ppm", 255):
        write(name, b"P6 1 1 65535\n" + bytes([128, low] * 3))
        write("scene.json", scene_of(name, QUAD))
        run(f"render scene.json --spp 4 -q -o {name}.pfm")
    run("compare low.ppm.pfm high.ppm.pfm --max-rmse 0.001", 1)
    write("beyond.ppm", "P3 1 1 255 256 0 -1\n")
    write("scene.json", scene_of("beyond.ppm", QUAD))
    run("render scene.json --spp 4 -q -o a.pfm", 0, "beyond.ppm: 2 of 3 numbers are outside of 0 to 255")


LIMITED = ["bash", "-c", 'ulimit -f 200; exec "$0" "$@"']  # kB


def test_full_disk(monkeypatch):
    """No half file is left, and what fits elsewhere is written. image/image_io_write has what was there before."""
    pathlib.Path("temporary").mkdir()
    monkeypatch.setenv("TMPDIR", f"{os.getcwd()}/temporary")
    big = ["big.pfm", *(["big.exr"] * HAS_EXR)]
    outputs = " ".join(f"-o {name}" for name in big)
    run(f"render cornell-box --spp 1 -q {outputs} -o small.png --stats figures.json", 3,
        *[f"{name}: cannot write" for name in big], by=LIMITED, loud=True)
    assert not set(big) & set(files()) and not os.listdir("temporary")
    assert load("figures.json")["spp"] == 1


def test_really_full_disk(monkeypatch):
    pathlib.Path("temporary").mkdir()
    monkeypatch.setenv("TMPDIR", f"{os.getcwd()}/temporary")
    pathlib.Path("disk").mkdir()
    if subprocess.run("mount -t tmpfs -o size=1m tmpfs disk", shell=True, capture_output=True).returncode:
        pytest.skip("no tmpfs can be mounted")
    try:
        run("render cornell-box --spp 1 -q -o disk/big.pfm -o kept.png", 3, "disk/big.pfm", "space",
            f"it is in {os.getcwd()}/temporary/tyndall-", loud=True)
        run("render cornell-box --spp 1 -q -o right.pfm")
        rescued, = pathlib.Path("temporary").glob("tyndall-*/big.pfm")
        assert read(rescued) == read("right.pfm") and read("kept.png") and not os.listdir("disk")
    finally:
        subprocess.run(["umount", "disk"], check=True)


@pytest.mark.parametrize("x, y, sample", [(3, 4, 0), (20, 11, 1), (31, 23, 6)])
@pytest.mark.parametrize("scene", ["showroom", "cornell-smoke", "next-week"])
def test_replay(scene, x, y, sample):
    """One path, in words and to the last bit of what the scalar kernel renders."""
    lines = run(f"render {scene} --size 32x24 --replay {x},{y},{sample}").splitlines()
    one = f"--region {x},{y},{x + 1},{y + 1} --samples {sample}:{sample + 1}"
    run(f"render {scene} --size 32x24 {one} --isa scalar -q -o one.pfm")
    assert lines[0] == "0 camera" and lines[-1].startswith("sample ")
    assert struct.pack("<3f", *map(float, lines[-1].split()[1:])) == read("one.pfm")[-12:]
    assert any(line.startswith("    throughput") for line in lines)


@pytest.mark.parametrize("command, expected", [
    ("cornell-box --replay 16,4,0 --set /camera/look_from=[278,278,-800]", "^    point       278 278 -800$"),
    ("cornell-box --replay 16,4,0 --set /camera/look_from=[278,278,-800]", r"^1 after [0-9.]+ meets .* \(white\), "),
    ("cornell-box --max-depth 0 --replay 16,12,0", "is cut at max_depth"),
    ("stress-caustic-shell --replay 10,20,1", "^    by chains   [0-9]"),
    ("stress-caustic-shell --replay 10,20,1 --caustics scatter", r"\A(?!(.|\n)*by chains)"),
])
def test_words_of_a_replay(command, expected):
    """What is met is named as in the file; places are the scene's own; light that chains found is said to be theirs."""
    run(f"render {command} --size 32x24", out=re.compile(expected, re.M))
