#!/usr/bin/env python3
"""Plants the bugs of bugs.py, one by one, and says which of them the tests catch.

Usage: planted.py ROOT [BUILD WORK [WORDS]]
ROOT: of the sources; BUILD: where they are built, with the tests; WORK: a folder for files; WORDS: only bugs whose
room or description holds one of these. With ROOT alone: only whether all bugs still fit the sources

A bug is a changed copy of one file, which is found before the file itself. Only what the bug names is compiled with it:
the tests that must catch it, which run up to the first failure, and the sources of the library that they see it by; all
else comes from BUILD. The same objects without the bug must pass. Bugs in kernels are planted in the scalar ones alone,
because they lie in sources that all of them share. Exit code 1: a bug survived, or does not fit the sources any more, or tests fail
without any.
"""
import concurrent.futures
import json
import os
import pathlib
import shlex
import subprocess
import sys
import time

from bugs import BUGS

# Where it is decided which kernels are used. Beside a bug in scalar ones they are compiled anew, so that it is these.
CHOICE = ["core/base/target.cpp", "core/targets/choose.cpp", "core/clean/clean.cpp"]
LONGEST_TEST = 600  # seconds; a test that hangs has caught its bug
JOBS = int(os.environ.get("TYNDALL_PLANTED_JOBS", len(os.sched_getaffinity(0))))


def run(command, folder, **options):
    return subprocess.run(command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, **options)


def must(command, folder):
    result = run(command, folder)
    if result.returncode != 0:
        sys.exit(f"planted: {shlex.join(command)} failed:\n{result.stdout[-4000:]}")
    return result.stdout


class Build:
    """What is built already, and how more is compiled and linked."""

    def __init__(self, root, build, work):
        self.root, self.build, self.work = root, build, work
        self.overlay = work / "overlay"
        (work / "clean").mkdir(parents=True, exist_ok=True)
        (work / "planted").mkdir(exist_ok=True)
        (work / "tyndall_targets.h").write_text("#define TYNDALL_BUILT_TARGETS Target::scalar\n"
                                                "#define TYNDALL_ALL_TARGETS Target::scalar\n")
        if not (work / "assets").exists():
            (work / "assets").symlink_to(root / "assets")  # a program finds its scenes beside itself
        entries = json.loads((build / "compile_commands.json").read_text())
        commands = {os.path.relpath(entry["file"], root): entry["command"] for entry in entries}
        self.of_library = self.command(commands["core/targets/scalar.cpp"])
        self.of_tests = self.command(commands["tests/main.cpp"])
        line = must(["ninja", "-t", "commands", "core_tests"], build).strip().splitlines()[-1]
        left_out = ("_test.cpp", "/Unity/", "libtyndall_app")
        self.link = [word for word in shlex.split(line.split("&&")[1]) if not any(part in word for part in left_out)]

    def command(self, text):
        """A command without its source and its object, and without instruction sets; assertions are on."""
        words = shlex.split(text)
        words = words[:1] + [f"-I{self.work}"] + words[1:words.index("-o")] + ["-O1", "-Wno-error", "-UNDEBUG"]
        return [word for word in words if word != "-DNDEBUG"]

    def compile(self, source, planted):
        """Compiles a file of the root, with what lies in the overlay if `planted`. Returns the object."""
        target = self.work / ("planted" if planted else "clean") / (source.replace("/", "_") + ".o")
        if not planted and target.exists() and target in self.made:
            return target
        words = list(self.of_tests if source.startswith("tests/") else self.of_library)
        file = self.root / source
        if planted:
            words.insert(next(i for i, word in enumerate(words) if word.startswith("-")), f"-I{self.overlay}")
            file = self.overlay / source if (self.overlay / source).exists() else file
        must(words + ["-o", str(target), "-c", str(file)], self.build)
        self.made.add(target)
        return target

    made = set()  # objects of this run; those of another may be of older sources

    def test(self, sources, planted):
        """Compiles these files and runs the tests among them. Returns what failed, or None if nothing did."""
        scalar = any(source.endswith("/scalar.cpp") for source in sources)
        choice = [source for source in CHOICE if scalar and source not in sources]
        with concurrent.futures.ThreadPoolExecutor(JOBS) as pool:
            objects = list(pool.map(lambda source: self.compile(source, planted), sources))
            objects += list(pool.map(lambda source: self.compile(source, False), choice))
        words = list(self.link)
        at = words.index("-o") + 1
        words[at] = str(self.work / "tests")
        # The first definition counts: that of these objects, not the library's.
        words[at + 1:at + 1] = ["-Wl,--allow-multiple-definition"] + [str(o) for o in objects]
        must(words, self.build)
        try:
            result = run([words[at], "--abort-after=1"], self.work, timeout=LONGEST_TEST)
        except subprocess.TimeoutExpired:
            return "a test that does not end"
        if result.returncode == 0:
            return None
        for line in result.stdout.splitlines():
            if line.startswith("TEST CASE:"):
                return line.removeprefix("TEST CASE:").strip()
        return f"exit code {result.returncode}"

    def plant(self, file, text):
        changed = self.overlay / file
        for old in self.overlay.rglob("*"):
            if old.is_file():
                old.unlink()
        changed.parent.mkdir(parents=True, exist_ok=True)
        changed.write_text(text)


def sources_of(bug):
    """What is compiled with the bug: its tests, the named sources of the library, and the file itself if it is one."""
    file, tests, library = bug[2], bug[5].split(), bug[6].split() if len(bug) > 6 else []
    own = [file] if file.endswith(".cpp") and file not in library else []
    return [f"tests/{test}_test.cpp" for test in tests] + library + own


def check_that_all_fit(root):
    """Ends the program where a bug's file does not hold once what it changes, or a test or source has gone."""
    for bug in BUGS:
        room, what, file, old = bug[:4]
        if (root / file).read_text().count(old) != 1:
            sys.exit(f"planted: {file} does not hold once what \"{what}\" changes; bugs.py has to follow it")
        for source in sources_of(bug):
            if not (root / source).exists():
                sys.exit(f"planted: \"{what}\" names {source}, which is not there")


def main():
    check_that_all_fit(pathlib.Path(sys.argv[1]))
    if len(sys.argv) == 2:
        return 0
    root, build, work = (pathlib.Path(argument).resolve() for argument in sys.argv[1:4])
    words = sys.argv[4:]
    built = Build(root, build, work)
    chosen = [bug for bug in BUGS if not words or any(word in bug[0] or word in bug[1] for word in words)]
    passed, caught = set(), 0
    for number, bug in enumerate(chosen, 1):
        room, what, file, old, new = bug[:5]
        text, sources, start = (root / file).read_text(), sources_of(bug), time.monotonic()
        if tuple(sources) not in passed:
            clean = built.test(sources, False)
            if clean:
                sys.exit(f"planted: without the bug \"{what}\" this fails: {clean}")
            passed.add(tuple(sources))
        built.plant(file, text.replace(old, new))
        by = built.test(sources, True)
        caught += by is not None
        result = f"caught by: {by}" if by else "SURVIVED"
        print(f"{number:2} {room:10} {what}: {result} ({time.monotonic() - start:.0f} s)", flush=True)
    print(f"{caught} of {len(chosen)} planted bugs were caught")
    return 0 if caught == len(chosen) else 1


if __name__ == "__main__":
    sys.exit(main())
