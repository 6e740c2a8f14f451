"""Outputs that nothing can take the place of: found before the first sample, written into when the picture is finished,
and never the reason for which a picture is lost."""

import contextlib
import os
import pathlib
import re
import shutil
import signal
import subprocess

import pytest
from program import (HAS_EXR, PROGRAM, begun, files, image_hash, load, read, rendered, run, running, same_picture,
                     wait_until, wait_worked, write)

SCENE = "cornell-box --size 24x16"
LONG = f"render {SCENE} --spp 10000000 -q"
IS_ROOT = os.getuid() == 0
needs_full = pytest.mark.skipif(not os.access("/dev/full", os.W_OK), reason="no /dev/full")
needs_mounts = pytest.mark.skipif(bool(subprocess.run(["unshare", "-rm", "true"], capture_output=True).returncode),
                                  reason="files cannot be mounted here")


@pytest.fixture(autouse=True)
def right(tmp_path, monkeypatch):
    """A temporary folder, and the picture that a render gives."""
    os.mkdir("temporary")
    monkeypatch.setenv("TMPDIR", f"{tmp_path}/temporary")
    run(f"render {SCENE} --spp 2 -q -o right.pfm")
    return read("right.pfm")


@contextlib.contextmanager
def ended_by_a_signal(command, code=3):
    """Runs a long command, the block while it runs, and then ends it."""
    with running(command) as process:
        wait_worked(process, begun())
        yield
        process.send_signal(signal.SIGTERM)
        assert process.wait(600) == code, read("said").decode()


def test_name_taken_meanwhile():
    """The picture goes to a name beside it, and the line says so."""
    for beside in ("a.new.pfm", "a.new-2.pfm"):
        with ended_by_a_signal(f"{LONG} -o a.pfm"):
            os.mkdir("a.pfm")
        assert re.search(f"a.pfm: cannot write: .*; it is in {beside} instead", read("said").decode())
        same_picture(beside, beside)
        os.rmdir("a.pfm")


def test_folder_gone_meanwhile():
    """The picture goes to a temporary one."""
    os.mkdir("gone")
    with ended_by_a_signal(f"{LONG} -o gone/a.pfm --stats gone/a.json"):
        os.rmdir("gone")
    for name in ("a.pfm", "a.json"):
        rescued = re.search(f"gone/{name}: .*; it is in (.*) instead", read("said").decode())[1]
        assert read(rescued) and re.fullmatch(f"{os.environ['TMPDIR']}/tyndall-....../{name}", rescued)


def test_streams():
    """Streams and open files take the bytes at the end."""
    run(f"render {SCENE} --spp 1 -q -o a.pfm --stats /dev/stdout", out="image_hash", loud=True)
    write("open.txt", "before\n")
    run(f"render {SCENE} --spp 1 -q -o a.pfm --stats /dev/stdout", loud=True,
        by=["bash", "-c", 'exec "$0" "$@" >>open.txt'])
    assert re.match("before\n(.|\n)*image_hash", read("open.txt").decode())


@needs_full
def test_others_are_written():
    """Where one of several outputs fails, the others are still written."""
    os.symlink("/dev/full", "full.png")
    os.symlink("/dev/full", "full.html")
    run(f"render {SCENE} --spp 1 -q -o full.png -o kept.png", 3, "full.png", "space", loud=True)
    assert read("kept.png")
    run("compare right.pfm --baseline kept --update", loud=True)
    run("compare right.pfm --baseline kept --report full.html --junit whole.xml", 3,
        "full.html: cannot write: No space", out="right.pfm", loud=True)
    assert b"</testsuite" in read("whole.xml")
    run("compare right.pfm right.pfm --heatmap full.png", 3, out="FLIP", loud=True)


def test_protected(right):
    """What the file system protects from everybody."""
    os.mkdir("protected")
    write("protected/a.pfm", "old\n")

    def change(flag, name):
        return subprocess.run(["chattr", flag, name], capture_output=True).returncode == 0
    if not change("+i", "protected/a.pfm"):
        pytest.skip("files cannot be protected here (chattr)")
    try:
        run(f"{LONG} -o protected/a.pfm", 3, "protected/a.pfm", "it may not be changed", "Operation not permitted")
        change("-i", "protected/a.pfm")
        change("+a", "protected")
        run(f"render {SCENE} --spp 2 -q -o protected/a.pfm", 0, "its folder may only be appended to")
        assert read("protected/a.pfm") == right
        run(f"{LONG} -o protected/b.pfm", 3, "protected/b.pfm", "its folder may only be appended to")
    finally:
        change("-i", "protected/a.pfm")
        change("-a", "protected")
    assert os.listdir("protected") == ["a.pfm"]


def test_closed_folder(right):
    """A folder that takes no new files, and a file in it that may be written; as a user to whom permissions apply."""
    by = ["setpriv", "--reuid=65534", "--regid=65534", "--clear-groups"] * IS_ROOT
    for folder, mode in ("..", 0o755), (".", 0o777), ("temporary", 0o777):
        os.chmod(folder, mode)
    if subprocess.run([*by, PROGRAM, "scenes"], capture_output=True).returncode:
        pytest.skip("the program cannot be run as a user without privileges")
    os.mkdir("closed")
    shutil.copy("right.pfm", "closed/a.pfm")
    for name, mode in ("a.exr", 0o666), ("locked.pfm", 0o444):
        write(f"closed/{name}", "old\n")
        os.chmod(f"closed/{name}", mode)
    os.chmod("closed/a.pfm", 0o666)
    os.chmod("closed", 0o555)
    try:
        run(f"render {SCENE} --spp 2 -q -o closed/a.pfm --fresh", 0, "closed/a.pfm", "cannot be replaced",
            "its folder takes no new files (Permission denied)", by=by)
        assert read("closed/a.pfm") == right
        if HAS_EXR:
            run(f"render {SCENE} --spp 2 -q -o closed/a.exr", 0, "no checkpoints are kept", by=by)
            same_picture("closed/a.exr", "right.pfm")
        for name in ("locked.pfm", "none.pfm"):
            run(f"{LONG} -o closed/{name}", 3, f"closed/{name}", "Permission denied", by=by)
    finally:
        os.chmod("closed", 0o755)
    if IS_ROOT:  # a shared folder in which only the owner of a file may replace it
        os.mkdir("sticky")
        write("sticky/a.pfm", "old\n")
        os.chmod("sticky/a.pfm", 0o666)
        for name in ("sticky/a.pfm", "sticky"):
            os.chown(name, 12345, -1)
        os.chmod("sticky", 0o1777)
        run(f"render {SCENE} --spp 2 -q -o sticky/a.pfm", by=by)
        assert read("sticky/a.pfm") == right and os.stat("sticky/a.pfm").st_uid == 12345
        assert os.listdir("sticky") == ["a.pfm"]


# The program sees "real" mounted at the name of the same ending.
MOUNTED = ["unshare", "-rm", "bash", "-c", """for name in png pfm exr json; do
  [ ! -e a.$name ] || mount --bind real.$name a.$name || exit 99
done
exec "$0" "$@" """]


def mounting(command):
    return ["unshare", "-rm", "bash", "-c", command]


def put(*endings):
    for ending in endings:
        write(f"real.{ending}", f"old old old {ending}\n")
        write(f"a.{ending}", "")


@needs_mounts
def test_mounted(right):
    """All commands write by core/image/whole_file.h; here by one."""
    put("pfm", "png", "json")
    run(f"render {SCENE} --spp 2 -q -o a.pfm -o a.png --stats a.json", by=MOUNTED)
    assert read("real.pfm") == right and load("real.json")["spp"] == 2 and not read("a.pfm")
    same_picture("real.png", "real.png")


@needs_mounts
def test_mounted_without_room():
    """What is read only is found before the first sample. Without room the file stays, and the picture is elsewhere."""
    put("pfm")
    run(f"{LONG} -o a.pfm", 3, "a.pfm", "it is a mount point, and into it: Read-only file system",
        by=mounting('mount --bind real.pfm a.pfm && mount -o remount,bind,ro a.pfm && exec "$0" "$@"'))
    os.mkdir("temporary/disk")
    disk = """mount -t tmpfs -o size=64k disk temporary/disk && echo precious >temporary/disk/real.pfm &&
      mount --bind temporary/disk/real.pfm a.pfm && "$0" "$@"; code=$?; grep -q precious a.pfm || code=98; exit $code"""
    run("render cornell-box --size 200x200 --spp 1 -q -o a.pfm", 3, "a.pfm", "No space", "it is in a.new.pfm instead",
        by=mounting(disk), loud=True)


@needs_mounts
def test_mounted_meanwhile():
    """Written into like one that was mounted before."""
    put("pfm")
    run("render cornell-box --size 24x16 -t 1 --time 2 -q -o a.pfm",
        by=mounting('"$0" "$@" & sleep 0.5; mount --bind real.pfm a.pfm; wait $!'))
    same_picture("real.pfm", "real.pfm")


def stopped(name, command):
    """A command with mounted files, ended by the signal once it has worked and there is a checkpoint. What it said."""
    with running(command, by=MOUNTED) as process:
        wait_worked(process, begun())
        wait_until(lambda: os.path.exists("a.unfinished.exr") and read("a.unfinished.exr"))
        process.send_signal(signal.Signals[f"SIG{name}"])
        process.wait(600)
    return read("said").decode()


@needs_mounts
def test_mounted_films(exr):
    """Checkpoints go beside it, the same command goes on from there, and only the finished film is written into it."""
    box = "render cornell-box --size 64x64 -q"
    beside = "a.unfinished.exr"
    put("exr")
    assert re.search(f"a.exr: cannot be replaced, as it is a mount point; .*checkpoints go to {beside}",
                     stopped("KILL", f"{box} --spp 10000000 --checkpoint 0.2 -o a.exr"))
    assert read("real.exr") == b"old old old exr\n" and read(beside)
    run(f"{box} --spp 10000000 --seed 3 -o a.exr", 2, beside, "seed 0", "--fresh", by=MOUNTED)
    run(f"merge {beside} -o a.exr", loud=True, by=MOUNTED)
    assert f"{beside}: goes on from" in stopped("TERM", f"{box} --spp 10000000 -o a.exr")
    assert b"unfinished" in read("real.exr") and beside not in files()
    put("exr")
    stopped("KILL", f"{box} --spp 1000000 --checkpoint 0.2 -o a.exr")
    goes_on = rendered("cornell-box --size 64x64 --spp 5000 -o a.exr", loud=True, by=MOUNTED)
    assert goes_on["image_hash"] == image_hash(f"cornell-box --size 64x64 --spp {goes_on['spp']}")
    assert beside not in files()
