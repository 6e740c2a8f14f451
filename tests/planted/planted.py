#!/usr/bin/env python3
"""Plants the faults of bugs_core.py and bugs_app.py, one at a time, and says which of them the tests find.

Usage: planted.py ROOT [WORK [WORDS]]
ROOT: of the sources; WORK: a folder for the build with the faults; WORDS: only faults whose file or description holds one of these.
With ROOT alone: only whether all faults still fit the sources

All faults are compiled into one build of a copy of the sources, each behind a question whether it is wanted (planted.h), which
the environment answers when a test runs. Kernels are the scalar ones alone: they and those of all instruction sets share
their sources. For each fault the tests run that its entry names, and all quick ones if those pass. Exit code 1: more than one
fault in twenty survived, or one does not fit the sources any more, or tests fail without any.
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import time

from bugs_app import APP
from bugs_core import CORE

BUGS = CORE + APP
JOBS = os.environ.get("TYNDALL_PLANTED_JOBS", str(len(os.sched_getaffinity(0))))
NOT_COPIED = {"build", ".git"}
# Tests of the sources themselves, which the copy would not pass, of other programs, and one that counts the rays of several
# instruction sets.
NOT_RUN = "^(check_|style/|peers/|targets/trace$)"


def parts(change):
    """What stands before a change, the old text, the new one, and what stands behind."""
    before, rest = change.split("«")
    middle, after = rest.split("»")
    old, new = middle.split(" → ")
    return before, old, new, after


def switched(number, old, new):
    """C++ that does what the new text says if the fault is wanted, else what the old one says."""
    asks = f"is_planted({number})"
    if old.endswith(";") or new.endswith(";"):
        return f"{{ if ({asks}) {{ {new} }} else {{ {old} }} }}"
    return f"({asks} ? ({new}) : ({old}))"


def with_faults(path, text):
    """The text of a source with all of its faults behind their questions."""
    places = []
    for number, (_, file, change, _) in enumerate(BUGS, 1):
        if file == path:
            before, old, new, after = parts(change)
            start = text.index(before + old + after) + len(before)
            places.append((start, start + len(old), switched(number, old, new)))
    for start, end, replacement in sorted(places, reverse=True):
        text = text[:start] + replacement + text[end:]
    header = os.path.relpath("tests/planted/planted.h", os.path.dirname(path))
    return f'#include "{header}"\n#line 1\n{text}' if places else text


def check_that_all_fit(root):
    """Ends the program where a file does not hold once what a fault changes, or a test has gone."""
    for what, file, change, tests in BUGS:
        before, old, _, after = parts(change)
        if (root / file).read_text().count(before + old + after) != 1:
            sys.exit(f'planted: {file} does not hold once what "{what}" changes; its entry has to follow it')
        for test in tests.split():
            folder, name = os.path.split(test)
            places = (f"{test}_test.cpp", test, f"{folder}/test_{name}.py")
            if not any((root / "tests" / place).exists() for place in places):
                sys.exit(f'planted: "{what}" names {test}, which is not there')


def copy(root, copied):
    """Brings the sources into the copy. What is the same stays as it is, so that it is not compiled anew."""
    kept = set()
    for folder, folders, names in os.walk(root):
        folders[:] = [name for name in folders if name not in NOT_COPIED]
        for name in names:
            source = pathlib.Path(folder, name)
            path = source.relative_to(root).as_posix()
            content = source.read_bytes()
            if any(bug[1] == path for bug in BUGS):
                content = with_faults(path, content.decode()).encode()
            target = copied / path
            kept.add(target)
            if not target.exists() or target.read_bytes() != content:
                target.parent.mkdir(parents=True, exist_ok=True)
                target.write_bytes(content)
                shutil.copymode(source, target)
    for old in [path for path in copied.rglob("*") if path.is_file() and path not in kept]:
        old.unlink()


def build(root, work, slow):
    """Builds the copy with all faults. Returns where."""
    folder = work / "build"
    copy(root, work / "sources")
    configure = ["cmake", "--preset", "release", "-B", folder, "-DTYNDALL_SIMD=OFF"]
    compile_all = ["cmake", "--build", folder, "--parallel", JOBS, "--target", "all"] + ["slow_tests"] * slow
    for command in (configure, compile_all):
        result = subprocess.run(command, cwd=work / "sources", stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        if result.returncode != 0:
            sys.exit(f"planted: {' '.join(map(str, command))} failed:\n{result.stdout[-8000:]}")
    return folder


def first_failure(folder, fault, *selection):
    """Runs tests with a fault, up to the first that fails. Returns its name, or None."""
    result = subprocess.run(["ctest", "--stop-on-failure", "-j", JOBS, "-E", NOT_RUN, *selection], cwd=folder, text=True,
                            env={**os.environ, "TYNDALL_FAULT": str(fault)}, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    failed = re.search(r"tests FAILED:\s+\d+ - (\S+) ", result.stdout)
    if "No tests were found" in result.stdout or (result.returncode != 0 and not failed):
        sys.exit(f"planted: ctest {' '.join(selection)}: {result.stdout}")
    return failed[1] if failed else None


def named(tests):
    return "^(" + "|".join(map(re.escape, sorted(tests))) + ")$"


def main():
    root = pathlib.Path(sys.argv[1]).resolve()
    check_that_all_fit(root)
    if len(sys.argv) == 2:
        return 0
    work, words = pathlib.Path(sys.argv[2]).resolve(), sys.argv[3:]
    chosen = [(number, os.path.dirname(file), what, tests.split()) for number, (what, file, _, tests) in enumerate(BUGS, 1)
              if not words or any(word in what or word in file for word in words)]
    tests = {test for *_, own in chosen for test in own}
    folder = build(root, work, any(test.endswith("_slow") for test in tests))
    failed = first_failure(folder, 0, "-R", named(tests))
    if failed:
        sys.exit(f"planted: without any fault {failed} fails")
    rooms = {}
    for number, room, what, tests in chosen:
        start = time.monotonic()
        by = first_failure(folder, number, "-R", named(tests)) or first_failure(folder, number, "-LE", "slow|nightly")
        seconds = time.monotonic() - start
        row = rooms.setdefault(room, [0, 0, 0, 0])
        for column, count in enumerate((1, bool(by) and "_slow" not in by, bool(by), seconds)):
            row[column] += count
        result = f"found by {by}" if by else "SURVIVED"
        print(f"{number:3} {room}: {what}: {result} ({seconds:.1f} s)", flush=True)
    rooms["all"] = [sum(column) for column in zip(*rooms.values())]
    print("\n| room | faults | found by quick tests | by all tests | seconds |\n|---|---|---|---|---|")
    for room, (faults, quick, found, seconds) in rooms.items():
        print(f"| {room} | {faults} | {quick} | {found} | {seconds:.0f} |")
    return 0 if rooms["all"][2] >= 0.95 * rooms["all"][0] else 1


if __name__ == "__main__":
    sys.exit(main())
