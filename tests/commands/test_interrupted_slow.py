"""Signals and checkpoints: the picture so far is written, and a render that was stopped or killed goes on by the same
command to the same bits."""

import json
import os
import pathlib
import re
import shutil
import signal
import subprocess

import pytest
from program import (HAS_EXR, PROGRAM, ROOT, begun, image_hash, instruction_sets, interrupted, load, read, rendered, run,
                     running, same_picture, wait_until, wait_worked, write)
from test_films import KEYED

LONG = "render cornell-box --size 64x64 --spp 10000000 -q"
IMAGES = "-o long.png" + " -o long.exr" * HAS_EXR
BEGUN = begun()
LATER = 3 * BEGUN  # when a render of many pixels is in the middle of a pass


@pytest.mark.parametrize("name", ["HUP", "XCPU", "USR2", "ALRM", "TERM", "INT"])
def test_signals(name):
    number = signal.Signals[f"SIG{name}"]
    interrupted(f"{LONG} {IMAGES} --stats long.json", BEGUN, 128 + number, number)
    assert read("long.png") and 1 <= load("long.json")["spp"] < 10000000
    if HAS_EXR and name == "INT":  # continued, it is the picture of a render that was not interrupted
        spp = load("long.json")["spp"] // 64 * 64 + 128
        stats = rendered(f"cornell-box --size 64x64 --spp {spp} --resume -o long.exr", loud=True)
        assert stats["samples"] == 64 * 64 * spp
        assert stats["image_hash"] == image_hash(f"cornell-box --size 64x64 --spp {spp}")


def test_signal_within_a_pass():
    """Its samples are kept, which some pixels have and others have not: that is said in a line, in the figures and in
    the files. Where all have the same number nothing is said; a signal hardly ever comes between two passes."""
    long = "render cornell-box --size 600x600 -t 1 -q -o uneven.png" + " -o uneven.exr" * HAS_EXR
    for attempt in range(1, 6):
        for name in pathlib.Path().glob("uneven.*"):
            name.unlink()
        said = interrupted(f"{long} --spp 10000000 --stats uneven.json", attempt * LATER)
        stats = load("uneven.json")
        least, most = stats["least_spp"], stats["most_spp"]
        assert stats["spp"] == least
        if least == most:
            assert not said
            continue
        assert re.fullmatch(f"tyndall: .*{least} to {most} samples.*\n", said)
        assert f'"least_spp": {least}'.encode() in read("uneven.png")
        assert f'"most_spp": {most}'.encode() in read("uneven.png")
        assert 360000 * least < stats["samples"] < 360000 * most
        if least + 1 < most:
            break
    assert least + 1 < most, "no signal came within a pass: this test has found nothing out"
    if not HAS_EXR:
        return
    # Going on makes it even; where fewer samples are asked for than some pixels have, that is said.
    shutil.copy("uneven.exr", "copy.exr")
    run(f"{long} --spp {least}", 0, f"has {least} to {most} samples a pixel already, more than the {least} asked for; "
        "it is written as it is", loud=True)
    shutil.copy("copy.exr", "uneven.exr")
    run(f"{long} --spp {least + 1} --stats again.json", 0,
        f"more than the {least + 1} asked for; all pixels get as many", loud=True)
    again = load("again.json")
    assert again["least_spp"] == again["most_spp"] == most
    run("merge copy.exr -o merged.pfm", 0, f"{least} to {most} samples")


def test_uneven_pictures():
    """So is it for the picture that SIGUSR1 asks for; with adaptive sampling numbers differ by design."""
    with running("render cornell-box --size 600x600 --spp 10000000 -t 1 -q -o told.png --stats told.json") as render:
        wait_worked(render, LATER)
        render.send_signal(signal.SIGUSR1)
        wait_until(lambda: os.path.exists("told.json") and read("told.json"))
        least, most = load("told.json")["least_spp"], load("told.json")["most_spp"]
        assert least == most or f"{least} to {most} samples" in read("said").decode()
    said = interrupted("render showroom --size 80x80 --adaptive --spp 100000 -q -o a.png --stats a.json", LATER)
    assert load("a.json")["least_spp"] != load("a.json")["most_spp"] and "samples" not in said


def test_asked_by_a_signal():
    """SIGUSR1 writes the picture so far, and the render goes on, to the end of one which was not asked."""
    long = "cornell-box --size 64x64 --spp 4000"
    with running(f"render {long} -o asked.pfm -o asked.png --stats asked.json -q") as render:
        for work in (BEGUN, 2 * BEGUN):
            wait_worked(render, work)
            for name in pathlib.Path().glob("asked.*"):
                name.unlink()
            render.send_signal(signal.SIGUSR1)
            wait_until(lambda: os.path.exists("asked.json") and read("asked.json"))
            assert read("asked.pfm") and read("asked.png") and 1 <= load("asked.json")["spp"] < 4000
        assert render.wait(600) == 0
    assert load("asked.json")["spp"] == 4000
    assert load("asked.json")["image_hash"] == image_hash(long)


def test_ignored_signals():
    """What was ignored at the start stays ignored: nohup, and "trap ''"."""
    ignored = ("HUP", "XCPU", "USR1", "USR2", "ALRM", "TERM")
    by = ["bash", "-c", f"trap '' {' '.join(ignored)}; exec \"$0\" \"$@\""]
    with running(f"{LONG} -o ignored.pfm --stats ignored.json", by=by) as render:
        wait_worked(render, BEGUN)
        for name in ignored:
            render.send_signal(signal.Signals[f"SIG{name}"])
        wait_worked(render, LATER)
        assert not os.path.exists("ignored.json")
        render.send_signal(signal.SIGINT)
        assert render.wait(600) == 130


def test_limit_of_processor_time():
    """SIGXCPU comes every second, also while the picture is written."""
    by = ["bash", "-c", 'ulimit -S -t 1; exec "$0" "$@"']
    with running(f"{LONG} -o limit.pfm", by=by) as render:
        assert render.wait(600) == 152 and read("limit.pfm")


def test_two_signals():
    """The second one ends at once, even where the first one cannot be heeded."""
    with running(f"{LONG} -o twice.png") as render:
        wait_worked(render, BEGUN)
        for name in ("STOP", "TERM", "INT", "CONT"):
            render.send_signal(signal.Signals[f"SIG{name}"])
        assert render.wait(600) in (130, 143)


def test_chart_interrupted():
    """It writes what there is."""
    run("render cornell-box --size 32x32 --spp 4096 --sampler random --seed 5 -q -o reference.pfm")
    interrupted("chart cornell-box --size 32x32 --budget 20 -q --reference reference.pfm -o cut.svg", 4)
    assert read("cut.svg") and len(read("cut.csv").splitlines()) > 3


BOX = "cornell-box --size 64x64"


def killed(arguments):
    """Starts it with checkpoints ten times a second, and kills it after the second of its checkpoints. On one thread,
    so that no machine is through before."""
    with running(f"render {arguments} --checkpoint 0.1 -t 1 -q -o k.exr") as render:
        seen = set()

        def two_checkpoints():
            assert render.poll() is None, "the command ended too early"
            if os.path.exists("k.exr"):
                seen.add(os.stat("k.exr").st_ino)
            return len(seen) > 1
        wait_until(two_checkpoints)
    return read("k.exr")


def test_checkpoints(exr):
    whole = image_hash(f"{BOX} --spp 3000")
    film = killed(f"{BOX} --spp 3000")
    assert b"unfinished" in film

    # What does not fit is refused, with the difference and the way out, and left as it is; nor is a further output gone
    # on with, nor where the output is to hold no film.
    for arguments, word in [
            (f"{BOX} --spp 3000 --seed 3", "seed 0"), (f"{BOX} --spp 3000 --sampler random", "sampler sobol"),
            ("cornell-box --size 64x63 --spp 3000", "64x64"),
            (f"{BOX} --spp 3000 --set /camera/vfov=30", "another scene"),
            (f"{BOX} --spp 3000 --region 0,0,64,63", "region"), (f"{BOX} --samples 4:3000", "from 0"),
            (f"{BOX} --spp 3000 --isa scalar", "instruction set"), (f"{BOX} --samples 0:1", "samples up to"),
            (f"{BOX} --spp 3000 --resume --isa scalar", "instruction set"),
            (f"{BOX} --spp 3000 -o first.exr", "first .exr output"),
            (f"{BOX} --spp 3000 --exr-film no", "first .exr output")]:
        if word != "instruction set" or instruction_sets() != ["scalar"]:
            run(f"render {arguments} -q -o k.exr", 2, "k.exr", word, "--fresh")
    write("first.exr", film)
    assert rendered(f"{BOX} --spp 3000 -o first.exr -o k.exr", "goes on from", loud=True)["image_hash"] == whole
    assert read("first.exr") == read("k.exr")

    # The same command goes on by itself, and says so; what fewer samples ask for is written as it is.
    write("k.exr", film)
    run(f"render {BOX} --spp 1 -q -o k.exr", 0, "more than the 1 asked for", lines=2)
    write("k.exr", film)
    stats = rendered(f"{BOX} --spp 3000 -o k.exr -o k.pfm", "goes on from", loud=True)
    assert stats["image_hash"] == whole and stats["samples"] == 64 * 64 * 3000

    # Complete: nothing is rendered. Without other outputs not even the file is touched.
    before = os.stat("k.exr").st_ctime_ns
    run(f"render {BOX} --spp 3000 -q -o k.exr", 0, "already complete: 3000 samples a pixel")
    assert os.stat("k.exr").st_ctime_ns == before
    os.remove("k.pfm")
    again = rendered(f"{BOX} --spp 3000 -o k.exr -o k.pfm", "already complete")
    assert read("k.pfm") and again["rays"] == 0 and again["image_hash"] == whole


def test_finished_films(exr):
    """They are replaced, as any other file is; --resume goes on from them; --fresh starts over."""
    film = killed(f"{BOX} --spp 3000")
    run(f"render {BOX} --spp 3000 -q -o k.exr", loud=True)
    stats = rendered(f"{BOX} --spp 3 -o k.exr", re.compile(r"\A(?!.*k\.exr)"))
    assert (stats["spp"], stats["samples"]) == (3, 64 * 64 * 3)
    assert rendered(f"{BOX} --spp 7 --resume -o k.exr")["image_hash"] == image_hash(f"{BOX} --spp 7")
    assert rendered(f"{BOX} --spp 7 --fresh -o k.exr")["rays"] != 0
    write("k.exr", film)
    run(f"render {BOX} --spp 7 --seed 3 --fresh -q -o k.exr")
    write("k.exr", "text\n")
    run(f"render {BOX} --spp 2 -q -o k.exr", loud=True)
    write("text.exr", "text\n")
    run(f"render {BOX} --spp 2 --resume -q -o text.exr", 2, "text.exr", "no film")
    # A film from before films had a format version, of another version of the program.
    old = read(ROOT / "tests/image/film_of_format_0.exr")
    write("old.exr", old)
    tiny = "render cornell-box --size 8x6 --isa scalar -q -o old.exr"
    run(f"{tiny} --spp 2")
    write("old.exr", old)
    run(f"{tiny} --spp 5 --resume", 2, "old.exr", "film of version 0.1.0", "--fresh")


@pytest.mark.parametrize("arguments", [f"{BOX} --samples 5:3000", "showroom --size 64x48 --adaptive --spp 1500"])
def test_checkpoints_of_others(exr, arguments):
    """Shards and adaptive renders go on in the same way."""
    killed(arguments)
    stats = rendered(f"{arguments} -o k.exr", "goes on from", loud=True)
    one = rendered(f"{arguments} -o one.exr", loud=True)
    same_picture("k.exr", "one.exr")
    assert (stats["image_hash"], stats["samples"]) == (one["image_hash"], one["samples"])


def test_no_checkpoints(exr):
    """A named pipe gets the image once, at the end. Without checkpoints there is nothing before the end."""
    os.mkfifo("pipe.exr")
    with open("piped.exr", "wb") as piped, subprocess.Popen(["cat", "pipe.exr"], stdout=piped) as reader:
        run(f"render {BOX} --spp 100 -q -o pipe.exr")
        reader.wait()
    same_picture("piped.exr", "piped.exr")
    with running(f"render {BOX} --spp 10000000 --checkpoint 0 -q -o none.exr") as render:
        wait_worked(render, BEGUN)
        assert not os.path.exists("none.exr")


@pytest.fixture(scope="module")
def whole_film(tmp_path_factory):
    folder = tmp_path_factory.mktemp("whole")
    write(folder / "film.json", json.dumps(KEYED))
    command = "animate film.json --spp 3000 -q -o w%d.exr -o whole.y4m"
    subprocess.run([PROGRAM, *command.split()], cwd=folder, check=True)
    return folder


@pytest.mark.parametrize("seconds", [0.05, 0.3, 0.7, 1.5, 3])
def test_killed_films(exr, whole_film, seconds):
    """They go on by the same command to the same bits, also within a frame."""
    write("film.json", json.dumps(KEYED))
    with running("animate film.json --spp 3000 -t 1 --checkpoint 0.02 -q -o k%d.exr -o k.y4m") as render:
        try:
            render.wait(seconds)
        except subprocess.TimeoutExpired:
            pass
    run("animate film.json --spp 3000 -q -o k%d.exr -o k.y4m", loud=True)
    for n in range(4):
        same_picture(f"{whole_film}/w{n}.exr", f"k{n}.exr")
    assert read("k.y4m") == read(whole_film / "whole.y4m")


def test_interrupted_film(exr):
    """A signal within a frame keeps its film, and writes no picture that is not whole."""
    write("film.json", json.dumps(KEYED))
    interrupted("animate film.json --spp 1000000 -t 1 -q -o k%d.exr -o k%d.png", BEGUN)
    assert read("k0.exr") and not os.path.exists("k0.png")
