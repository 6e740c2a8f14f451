"""The program under test, run as users run it, and what tests look at afterwards."""

import contextlib
import functools
import json
import os
import pathlib
import re
import shlex
import signal
import struct
import subprocess
import tempfile
import time
import zlib

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = os.environ["TYNDALL_PROGRAM"]


def files():
    """All files below the folder, each with its size and the time of its last change."""
    found = {path: path.lstat() for path in pathlib.Path().rglob("*")}
    return {str(path): (at.st_size, at.st_mtime_ns) for path, at in found.items() if not path.is_dir()}


def run(command, code=0, *words, out=(), loud=False, lines=None, given=b"", by=(), **variables):
    """Runs the command and returns what it printed, or what it said where it was refused (exit code 2 and more).

    Fails unless the exit code is this one, standard error holds the words (texts or patterns) and standard output those
    of "out". Only one line may be said, where there are words or the command is refused, else none, or so many "lines";
    it begins with "tyndall: ". What is refused prints nothing and changes no file. None of that is asked of "loud" ones.
    "by": a command that starts the program; "variables": of the environment.
    """
    before = files()
    arguments = shlex.split(command) if isinstance(command, str) else command
    done = subprocess.run([*by, PROGRAM, *arguments], input=given, capture_output=True, env=os.environ | variables,
                          timeout=600)
    printed, said = (text.decode(errors="surrogateescape") for text in (done.stdout, done.stderr))
    wrong = []
    if done.returncode != code:
        wrong.append(f"found exit code {done.returncode}, expected {code}")
    for name, text, expected in ("standard error", said, words), ("standard output", printed, out):
        for word in expected if isinstance(expected, (tuple, list)) else [expected]:
            if not (word.search(text) if hasattr(word, "search") else word in text):
                wrong.append(f"expected {word!r} in {name}")
    most = int(bool(words) or code > 1) if lines is None else lines
    if not loud and code != 1 and (
            said.count("\n") > most or (said or code > 1) and not said.startswith("tyndall: ")):
        wrong.append(f'expected at most {most} lines that begin with "tyndall: " on standard error')
    if not loud and code > 1:
        if printed:
            wrong.append("expected nothing on standard output")
        if files() != before:
            wrong.append(f"files have changed: {set(files().items()) ^ set(before.items())}")
    told = [f"tyndall {command}", *wrong, f"standard error: {said}", f"standard output: {printed[:2000]}"]
    assert not wrong, "\n".join(told)
    return said if code > 1 else printed


def read(name):
    return pathlib.Path(name).read_bytes()


def load(name):
    """A file of strict JSON, which has neither NaN nor infinity."""
    return json.loads(read(name), parse_constant=lambda constant: pytest.fail(f"{name}: {constant} is not JSON"))


def rendered(arguments, *words, **options):
    """Renders quietly, into x.pfm unless outputs are named; returns the figures."""
    output = "" if re.search(r" (-o|--output)\b", arguments) else "-o x.pfm"
    run(f"render {arguments} {output} -q --stats x.json", 0, *words, **options)
    return load("x.json")


def image_hash(arguments):
    return rendered(arguments, loud=True)["image_hash"]


def same_picture(*names):
    run(["compare", *names, "--max-rmse", "0"], loud=True)


@functools.cache
def instruction_sets():
    """Those of this program that this machine runs."""
    version = subprocess.run([PROGRAM, "version"], capture_output=True, text=True).stdout
    return re.search("this CPU runs ([a-z0-9 ]+)", version)[1].split()


@contextlib.contextmanager
def running(command, by=(), **options):
    """The command in the background; what it says goes to the file "said", what it prints to "printed"."""
    with open("said", "wb") as said, open("printed", "wb") as printed:
        process = subprocess.Popen([*by, PROGRAM, *shlex.split(command)], stdin=subprocess.DEVNULL, stdout=printed,
                                   stderr=said, **options)
    try:
        yield process
    finally:
        process.kill()
        process.wait()


def wait_worked(process, seconds):
    """Until it has used that much processor time, so that on a busy machine it has come as far as on a quiet one."""
    ticks = seconds * os.sysconf("SC_CLK_TCK")
    while sum(map(int, pathlib.Path(f"/proc/{process.pid}/stat").read_text().rsplit(")", 1)[1].split()[11:13])) < ticks:
        assert process.poll() is None, f"the command ended too early: {read('said').decode()}"
        time.sleep(0.05)


@functools.cache
def begun():
    """Seconds of work after which a small render has surely begun, however slow this build and this machine are."""
    with tempfile.TemporaryDirectory() as folder:
        before = os.times()
        small = "render cornell-box --size 64x64 --spp 1 -q -o a.pfm"
        subprocess.run([PROGRAM, *small.split()], cwd=folder, check=True)
        after = os.times()
    return 0.1 + 3 * (after.children_user + after.children_system - before.children_user - before.children_system)


def wait_until(happens, seconds=60):
    end = time.monotonic() + seconds
    while not happens():
        assert time.monotonic() < end, "it does not happen"
        time.sleep(0.05)


def interrupted(command, seconds, code=130, by_signal=signal.SIGINT, **options):
    """Runs the command, sends the signal after so much work, and returns what it said."""
    with running(command, **options) as process:
        wait_worked(process, seconds)
        process.send_signal(by_signal)
        found = process.wait(600)
        assert found == code, f"{command}: exit code {found}, expected {code}: {read('said').decode()}"
    return read("said").decode()


def write(name, content):
    pathlib.Path(name).parent.mkdir(parents=True, exist_ok=True)
    pathlib.Path(name).write_bytes(content if isinstance(content, bytes) else content.encode())


def pfm(name, width, height, *colour, **pixels):
    """A picture of one colour, but for some pixels: x3y1=(red, green, blue), y down."""
    rows = [[colour] * width for _ in range(height)]
    for place, other in pixels.items():
        x, y = map(int, place[1:].split("y"))
        rows[y][x] = other
    data = b"".join(struct.pack("<3f", *pixel) for row in reversed(rows) for pixel in row)
    write(name, b"PF\n%d %d\n-1.0\n" % (width, height) + data)


def pixels_of(name):
    """Of a PFM: rows from above of (red, green, blue)."""
    _, size, _, data = read(name).split(b"\n", 3)
    width, height = map(int, size.split())
    values = [struct.unpack_from("<3f", data, 12 * i) for i in range(width * height)]
    return [values[y * width:(y + 1) * width] for y in reversed(range(height))]


def png(name, row, alpha=False, rows=1, level=9):
    """A PNG of equal rows of bytes."""
    def chunk(tag, data):
        return struct.pack(">I", len(data)) + tag + data + struct.pack(">I", zlib.crc32(tag + data))
    head = struct.pack(">IIBBBBB", len(row) // (3 + alpha), rows, 8, 6 if alpha else 2, 0, 0, 0)
    data = zlib.compress((b"\0" + bytes(row)) * rows, level)
    write(name, b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", data) + chunk(b"IEND", b""))


with tempfile.TemporaryDirectory() as folder:
    HAS_EXR = subprocess.run([PROGRAM, *f"render quads --size 8x8 --spp 1 -q -o {folder}/a.exr".split()],
                             capture_output=True).returncode == 0
