"""The program under test, run as users run it, and what tests look at afterwards."""

import os
import pathlib
import shlex
import struct
import subprocess
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = os.environ["TYNDALL_PROGRAM"]


def files():
    """All files below the folder, each with its size and the time of its last change."""
    found = {path: path.lstat() for path in pathlib.Path().rglob("*")}
    return {str(path): (at.st_size, at.st_mtime_ns) for path, at in found.items() if not path.is_dir()}


def run(command, code=0, *words, out=(), loud=False, given=b"", by=(), **variables):
    """Runs the command and returns what it printed, or what it said where it was refused (exit code 2 and more).

    Fails unless the exit code is this one, standard error holds the words (texts or patterns) and standard output those
    of "out". Without words nothing may be said, unless it may be loud. A refusal is one line that begins with
    "tyndall: "; nothing is printed and no file changes. "by": a command that starts the program; "variables": of the
    environment.
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
    if code == 0 and not words and not loud and said:
        wrong.append("expected nothing on standard error")
    if code > 1:
        if said.count("\n") != 1 or not said.startswith("tyndall: "):
            wrong.append('expected one line that begins with "tyndall: " on standard error')
        if printed:
            wrong.append("expected nothing on standard output")
        if files() != before:
            wrong.append(f"files have changed: {set(files().items()) ^ set(before.items())}")
    told = [f"tyndall {command}", *wrong, f"standard error: {said}", f"standard output: {printed[:2000]}"]
    assert not wrong, "\n".join(told)
    return said if code > 1 else printed


def read(name):
    return pathlib.Path(name).read_bytes()


def write(name, content):
    pathlib.Path(name).parent.mkdir(parents=True, exist_ok=True)
    pathlib.Path(name).write_bytes(content if isinstance(content, bytes) else content.encode())


def pfm(name, width, height, *colour):
    """A picture of one colour."""
    write(name, b"PF\n%d %d\n-1.0\n" % (width, height) + struct.pack("<3f", *colour) * (width * height))


with tempfile.TemporaryDirectory() as folder:
    HAS_EXR = subprocess.run([PROGRAM, *f"render quads --size 8x8 --spp 1 -q -o {folder}/a.exr".split()],
                             capture_output=True).returncode == 0
