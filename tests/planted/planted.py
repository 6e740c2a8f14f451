#!/usr/bin/env python3
"""Plants the bugs of bugs.py, one by one, in a copy of the sources, and says which of them the tests catch.

Usage: planted.py ROOT WORK [WORDS]   ROOT: of the sources; WORK: a folder for the copy and its build, which is kept and
makes the next run quicker; WORDS: only bugs whose room or description holds one of these

For each bug the files that depend on it are built, and the tests named beside it run; where those pass, all quick tests of
core. Only the scalar kernels are built, because bugs lie in sources that all of them share. Exit code 1: a bug survived,
or does not fit the sources any more, or the tests fail without any.
"""
import os
import pathlib
import shlex
import shutil
import subprocess
import sys
import time

from bugs import BUGS, LIBRARY

OPTIONS = ["-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_CXX_FLAGS_RELEASE=-O1 -g0", "-DTYNDALL_WINDOW=OFF", "-DTYNDALL_SIMD=OFF",
           "-DTYNDALL_QUICK_BUILD=OFF", "-DTYNDALL_WERROR=OFF"]
COPIED = ["CMakeLists.txt", "core", "app", "assets", "shaders", "tests", "third_party", "LICENSE"]
LONGEST_TEST = 300  # seconds; a test that hangs has caught its bug


def run(command, folder, **options):
    return subprocess.run(command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, **options)


class Copy:
    """A copy of the sources and its build."""

    def __init__(self, root, work):
        self.tree, self.build = work / "tree", work / "build"
        self.tree.mkdir(parents=True, exist_ok=True)
        for name in COPIED:
            self.update(root / name, self.tree / name)
        self.must(["cmake", "-S", str(self.tree), "-B", str(self.build), "-G", "Ninja"] + OPTIONS, self.tree)
        self.link = self.link_command()

    def update(self, source, target):
        """Copies what differs, so that what does not is not built again."""
        if source.is_dir():
            target.mkdir(exist_ok=True)
            wanted = {p.name for p in source.iterdir() if p.name != "__pycache__"}
            for old in list(target.iterdir()):
                if old.name not in wanted:
                    shutil.rmtree(old) if old.is_dir() else old.unlink()
            for name in wanted:
                self.update(source / name, target / name)
        elif not target.exists() or target.read_bytes() != source.read_bytes():
            shutil.copyfile(source, target)

    def must(self, command, folder):
        result = run(command, folder)
        if result.returncode != 0:
            sys.exit(f"planted: {shlex.join(command)} failed:\n{result.stdout[-4000:]}")

    def link_command(self):
        lines = run(["ninja", "-t", "commands", "core_tests"], self.build).stdout.strip().splitlines()
        return shlex.split(lines[-1].split("&&")[1])

    def objects(self, tests):
        """The objects of the tests' program that are not tests, and those of `tests`."""
        wanted = {f"tests/CMakeFiles/core_tests.dir/{test}_test.cpp.o" for test in tests}
        return [word for word in self.link if word.endswith(".o") and ("_test.cpp" not in word or word in wanted)]

    def ninja(self, targets):
        return run(["ninja", "-j", os.environ.get("TYNDALL_PLANTED_JOBS", str(os.cpu_count()))] + targets, self.build)

    def test(self, tests, library):
        """Builds and runs tests. Returns what failed, or None if nothing did."""
        objects = self.objects(tests)
        built = self.ninja(objects + (["libtyndall_core.a"] if library else []))
        if built.returncode != 0:
            sys.exit("planted: the bug cannot be compiled:\n" + built.stdout[-4000:])
        words = [word for word in self.link if not word.endswith(".o")]
        at = words.index("-o") + 1
        words[at] = str(self.build / "planted_tests")
        self.must(words[:at + 1] + objects + words[at + 1:], self.build)
        try:
            result = run([words[at]], self.build, timeout=LONGEST_TEST)
        except subprocess.TimeoutExpired:
            return "a test that does not end"
        if result.returncode == 0:
            return None
        names = [line.removeprefix("TEST CASE:").strip() for line in result.stdout.splitlines() if line.startswith("TEST CASE:")]
        return names[0] if names else f"exit code {result.returncode}"

    def test_all(self):
        built = self.ninja(["core_tests"])
        if built.returncode != 0:
            sys.exit("planted: core_tests cannot be built:\n" + built.stdout[-4000:])
        result = run(["tests/core_tests"], self.build, timeout=20 * LONGEST_TEST)
        return None if result.returncode == 0 else "another quick test"


def main():
    root, words = pathlib.Path(sys.argv[1]).resolve(), sys.argv[3:]
    copy = Copy(root, pathlib.Path(sys.argv[2]).resolve())
    chosen = [bug for bug in BUGS if not words or any(word in bug[0] or word in bug[1] for word in words)]
    for room, what, file, old, *_ in chosen:
        if (copy.tree / file).read_text().count(old) != 1:
            sys.exit(f"planted: {file} does not hold once what is to be changed for \"{what}\"; bugs.py has to follow it")
    clean = copy.test(sorted({test for bug in chosen for test in bug[5].split()}), LIBRARY)
    if clean:
        sys.exit(f"planted: without any bug this fails: {clean}")
    caught = 0
    for number, (room, what, file, old, new, tests, library) in enumerate(chosen, 1):
        source, start = copy.tree / file, time.monotonic()
        text = source.read_text()
        try:
            source.write_text(text.replace(old, new))
            by = copy.test(tests.split(), library) or copy.test_all()
        finally:
            source.write_text(text)
        caught += by is not None
        print(f"{number:2} {room:10} {what}: {'caught by: ' + by if by else 'SURVIVED'} ({time.monotonic() - start:.0f} s)", flush=True)
    print(f"{caught} of {len(chosen)} planted bugs were caught")
    return 0 if caught == len(chosen) else 1


if __name__ == "__main__":
    sys.exit(main())
