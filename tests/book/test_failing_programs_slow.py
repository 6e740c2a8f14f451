"""Programs, compilers and temporary folders that fail, each in one line, and what programs that are run leave alone."""

import os
import pathlib
import signal
import subprocess
import sys
import time

import pytest
from program import read, run, running, wait_until, write
from readers import BOOK, ball_of, has_guard, program, world

INPUT = "main() reads standard input"
OLD_INPUT = [("int n = 1; if (scanf(\"%d\", &n) > 0) n = 2;", [INPUT])] * os.path.exists("/proc/self/syscall")


@pytest.mark.parametrize("begin, words", [
    ("volatile int* volatile p = nullptr; *p = 1;", ["was ended by SIGSEGV", "before the colour of its first ray"]),
    ("throw 1;", ["was ended by SIGABRT", "an instance of 'int'"]),
    (r'std::cerr << "reading\nno model.obj\n"; exit(4);',
     ["ended with exit code 4 before the colour of its first ray", 'its last words: "no model.obj"']),
    ("for (int k = 0; k < 4096; ++k) if (!malloc(std::size_t(1) << 30)) exit(4); exit(5);", ["ended with exit code 4"]),
    ("return 0;", ["ended with exit code 0 before the colour of its first ray"]),
    ("int n = 1; std::cin >> n;", [INPUT]), *OLD_INPUT])
def test_failing_programs(begin, words):
    program("main.cc", world(ball_of(), begin))
    run("convert main.cc -o failed.json", 2, "main.cc", *words)


def test_forks():
    """What a program has started ends with it."""
    program("main.cc", world(ball_of(), "if (fork() == 0) { fork(); sleep(1000); }"))
    run("inspect main.cc")


def script(name, text):
    write(name, f"#!/bin/sh\n{text}\n")
    os.chmod(name, 0o755)
    return os.path.abspath(name)


@pytest.mark.parametrize("does, code, words", [
    ("kill -9 $$", 3, ["compiler was ended by SIGKILL", "while it compiled good.cc"]),
    ('echo "c++: fatal error: Killed signal terminated program cc1plus" >&2; exit 1', 3, ["was ended by SIGKILL"]),
    ('echo "cc1plus: error: No space left on device" >&2; exit 1', 3, ["No space left on device"])])
def test_failing_compilers(does, code, words):
    program("good.cc", world(ball_of()))
    run("inspect good.cc", code, *words, CXX=script("compiler", does))


def test_compilers_and_temporary_folders():
    program("good.cc", world(ball_of()))
    run("inspect good.cc", 3, 'CXX: found "./nothing", which cannot be run, expected a C++ compiler', CXX="./nothing")
    run("inspect good.cc", CXX=os.environ.get("CXX", "c++") + " -DUNUSED")
    run("inspect good.cc", 3, "no C++ compiler was found", "apt install g++", by=["env", "-u", "CXX", "PATH=/nowhere"])
    run("inspect good.cc", 3, "missing: cannot make a temporary folder", TMPDIR=os.path.abspath("missing"))
    if subprocess.run(["unshare", "-rm", "true"], capture_output=True).returncode:
        return
    os.mkdir("mounted")
    mount = 'mount -t tmpfs -o "$0" none mounted && TMPDIR=$PWD/mounted exec "$@"'
    for options, words in ("noexec", ["noexec", "TMPDIR names another"]), ("size=64k", ["No space left on device"]):
        run("inspect good.cc", 3, *words, by=["unshare", "-rm", "bash", "-c", mount, options])


def has_begun():
    """Whether the compiler below, or the program, has written something."""
    return any(path.stat().st_size for path in pathlib.Path(os.environ["TMPDIR"]).rglob("*")
               if path.is_file() and (path.name == "mark" or path.parent.name == "written"))


@pytest.mark.parametrize("command, name, doing", [
    *[("inspect", name, "compiled") for name in ("INT", "TERM", "HUP")], ("render -o x.png", "INT", "ran"),
    ("chart -o x.svg", "TERM", "ran")])  # it watches signals itself, too
def test_signals(command, name, doing):
    program("main.cc", 'int main() { std::ofstream("mark") << 1; for (volatile int i = 0;;) i = 1; }')
    variables = {"CXX": script("compiler", "echo 1 >mark; sleep 1000 & sleep 1000")} if doing == "compiled" else {}
    number = signal.Signals[f"SIG{name}"]
    with running(f"{command} main.cc", env=os.environ | variables) as process:
        wait_until(has_begun)
        process.send_signal(number)
        assert process.wait(600) == 128 + number
    assert read("said").decode() == f"tyndall: main.cc: interrupted while it {'was ' * (doing != 'ran')}{doing}\n"
    assert not read("printed")


def lacking(calls):
    return [sys.executable, BOOK / "lacking.py", calls]


def test_guard(monkeypatch):
    """A program that is only asked for its scene changes nothing outside of its temporary folder, by whichever layer of
    the guard there is. Where there is none, nothing is run."""
    program("kept/main.cc", world(ball_of(), """
        for (std::string name : {"picture.ppm", "../above.ppm", (getenv("HOME") + std::string("/home.ppm")).c_str()})
          if (!(std::ofstream(name) << 1).flush()) return 4;
        std::ofstream("added.ppm", std::ios::app) << 1;
        std::remove("removed.ppm");
        if (fork() == 0) {
          setsid();
          usleep(300000);
          std::rename("main.cc", "later.ppm");
          _exit(0);
        }"""))
    for name in "picture", "../above", "home", "added", "removed", "later":
        write(f"kept/{name}.ppm", "P3 1 1 255 1 2 3")
    monkeypatch.setenv("HOME", os.path.abspath("kept"))

    def content():
        return {name: read(name) for name in ["above.ppm"] + [f"kept/{name}" for name in sorted(os.listdir("kept"))]}
    before = content()
    for calls in "", "unshare", "landlock":
        if has_guard(lacking(calls)):
            run("inspect kept/main.cc", by=lacking(calls))
            time.sleep(0.4)
            assert content() == before, f"on a kernel without '{calls}'"
    for command in ("render kept/main.cc --spp 1 -q -o picture.png", "convert kept/main.cc -o kept.json",
                    "chart kept/main.cc --budget 1 -o chart.svg",
                    "render kept/main.cc --spp 64 -q --gamma2 -o mine.ppm", "compare mine.ppm kept/main.cc"):
        run(command, loud=True)
    for command in "convert", "render":  # a source file is never replaced
        run(f"{command} kept/main.cc -o kept/main.cc", 2)
    none = lacking("unshare landlock")
    assert not has_guard(none)
    run("inspect kept/main.cc", 2, "kept/main.cc: is not run", "namespaces", "Landlock", "--trust", by=none,
        TYNDALL_TRUST="1")
    assert content() == before
    run("inspect kept/main.cc --trust", by=none)
    assert not os.path.exists("kept/removed.ppm"), "the program does not run as it is"
