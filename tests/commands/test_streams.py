"""What is printed, closed streams and limits of the system, and what is told for want of a display."""

import os
import pathlib
import re
import shutil
import subprocess

import pytest
from program import HAS_EXR, PROGRAM, ROOT, read, run, write

SMALL = "render cornell-box --size 16x16 --spp 1"


@pytest.mark.parametrize("command", ["-V", "version", "--version"])
def test_version(command):
    run(command, out=re.compile("^tyndall [0-9]"))


def test_without_assets():
    run("verify", 2, "cases.json", "TYNDALL_ASSETS", TYNDALL_ASSETS="/nowhere")
    run("scenes", 3, "TYNDALL_ASSETS", TYNDALL_ASSETS="/nowhere")


def test_without_exr():
    if not HAS_EXR:
        run("render cornell-box -o a.exr", 2, "a.exr", "OpenEXR")


def test_full_name_of_the_input():
    write("scene.json", '{ "tyndall": 1 }')
    run(f"render scene.json --spp 1000000 -q -o new.png --stats '{os.getcwd()}/scene.json'", 2, "--stats", "input")


def test_closed_and_full_output():
    """Commands that print data fail; a render that writes an image does not."""
    closed = ["sh", "-c", 'exec "$0" "$@" >&-']
    run("scenes", 3, "standard output", by=closed)
    run("render quads --size 8x8 --spp 1 -q -o - --format png", 3, "-: cannot write", by=closed)
    if os.access("/dev/full", os.W_OK):
        run("scenes", 3, "standard output", "space", by=["sh", "-c", 'exec "$0" "$@" >/dev/full'])
    run(f"{SMALL} -o closed.pfm", by=["sh", "-c", 'exec "$0" "$@" >&- 2>&- <&-'])
    run(f"{SMALL} -o open.pfm")
    assert read("closed.pfm") == read("open.pfm")


def test_limits_of_the_system():
    limit = ["sh", "-c", 'ulimit -v 600000; exec "$0" "$@"']
    if subprocess.run([*limit, PROGRAM, "-V"], capture_output=True).returncode:
        pytest.skip("a program with sanitizers does not start under a limit")
    run("render cornell-box --size 4000x4000 --spp 1 -q -o a.pfm", 2, "ulimit -v", by=limit)
    words = ["cannot start thread", "of 400", "ulimit -v", "--threads"]
    run("render cornell-box --size 8x8 --spp 1 -t 400 -q -o a.pfm", 3, *words, by=limit)


@pytest.mark.parametrize("command, instead", [
    ("", "tyndall render showroom -o showroom.png"),
    ("view cornell-box --seed 3", "tyndall render cornell-box --seed 3 -o cornell-box.png"),
    ("view cornell-box --reference a.exr --seed 3 --ui-log=log",
     "tyndall render cornell-box --seed 3 -o cornell-box.png"),
    ("--seed 3 cornell-box --spp 9", "tyndall render --seed 3 cornell-box --spp 9 -o cornell-box.png"),
])
def test_no_display(command, instead):
    run(command, 3, instead)


@pytest.mark.parametrize("name", [
    "my quads", "./it's", "./line\nfeed\x1b", b"./bytes\xff", r"./back\slash $HOME", "./\u2028", "./-dash"])
def test_command_instead_of_the_window(name):
    """The command that is named for want of a display works as it stands."""
    name = os.fsdecode(name)
    shutil.copy(ROOT / "assets/scenes/quads.json", f"{name}.json")
    pathlib.Path("bin").mkdir()
    os.symlink(PROGRAM, "bin/tyndall")
    if name == "my quads":
        run([f"{name}.json"], 3, "tyndall render 'my quads.json' -o 'my quads.png'")
    said = run([f"{name}.json"], 3, "tyndall render")
    command = said[said.index("tyndall render"):].strip() + " --size 8x8 --spp 1 -q"
    path = f"{os.getcwd()}/bin:{os.environ['PATH']}"
    subprocess.run(["bash", "-c", command], check=True, env=os.environ | {"PATH": path})
    assert os.path.getsize(f"{name}.png")


@pytest.mark.parametrize("given, more, code, words", [
    (b"P3\n2 1\n255\n1 2 3\n", "", 3, ["> image.ppm"]),
    (b'{ "tyndall": 1 }', "", 3, ["tyndall render - -o image.png"]),
    (b"", "", 2, ["standard input: found nothing", "P3 or P6"]),
    (b"P3\n2 x 255", "", 2, ["standard input", 'found "x"']),
    (b"P3 20", "", 2, ["standard input: ended where the height"]),
    (b"P3 2 1 255 1 2 3", "--size 4x4", 2, ["found a picture, expected a scene"]),
    (b"\xef\xbb\xbfP3\n2 1\n255\n1 2 3\n", "", 2, ["byte order mark", "P3 or P6"]),
    (b"\xff\xfeP\x003\x00\n\x00", "", 2, ["UTF-16", "P3 or P6"]),
    (b'\xef\xbb\xbf\n\n // a scene\n{ "tyndall": 1 }', "", 3, ["tyndall render -"]),
    (b'\n\n { "tyndall": x }', "", 2, ["line 3"]),
    (b'{ "tyndall": 1 }', "--gamma2", 2, ["--gamma2", "found a scene"]),
])
def test_piped(given, more, code, words):
    """A picture that a program writes: kept in a file instead. What is nothing, or no picture, is that."""
    run(f"view - {more}", code, *words, given=given)


def test_text_before_a_picture():
    """It is told at once, whatever follows, and whoever goes on writing."""
    with subprocess.Popen([PROGRAM, "view", "-"], stdin=subprocess.PIPE, stderr=subprocess.PIPE) as viewer:
        viewer.stdin.write(b"rendering...\nP3\n2 1\n255\n")
        viewer.stdin.flush()
        assert viewer.wait(60) == 2
        said = viewer.stderr.read().decode()
    assert said.startswith("tyndall: ") and said.count("\n") == 1
    assert all(word in said for word in ('standard input: found "rendering..."', "P3 or P6", "std::cerr"))
