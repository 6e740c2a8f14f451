#!/usr/bin/env python3
"""Fails when something lies in the repository that does not belong there.

Usage: check_tree.py ROOT

1. The top level holds the names below and no others.
2. No file is larger than 1 MB, unless LARGE_FILES names it: every clone carries it for ever.
3. No tracked file is ignored: .gitignore would hide the next one of its kind.
4. Files that the program, the scripts and the benchmarks leave behind are ignored.
The first two hold for all files that git tracks or would add, which are those that are neither tracked nor ignored.
Exit code 77 (skipped) where there is no git, as in an unpacked archive.
"""
import pathlib
import subprocess
import sys

TOP_LEVEL = """app assets core shaders tests third_party .ci .github .clang-format .clang-tidy .gitignore CMakeLists.txt
CMakePresets.json LICENSE README.md run test""".split()
LARGEST_FILE = 1_000_000  # bytes
LARGE_FILES = []  # paths of files that may be larger, each with a comment that says why
# One name for each kind of file that runs leave.
LEFT_BEHIND = """showroom.png all.exr out.pfm out.hdr smoke.svg smoke.csv stats.json bench.json charts/cover.svg
showroom-001.png app/showroom-001.exr showroom-chart-001.csv app/showroom-chart-001.svg img_x16_1.bin
reference-cover-4096-0123456789abcdef.pfm reference-cover-4096-0123456789abcdef.txt build/reference-cover-1-0.pfm
cover.exr.tmp-1234 build/release/tyndall compile_commands.json tests/__pycache__/check_tree.pyc""".split()


def git(root, *words, **options):
    """What a git command prints as a list separated by zeros."""
    command = ["git", "-c", f"safe.directory={root}", "-C", str(root), *words]
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=True, **options)
    return sorted({name for name in done.stdout.decode().split("\0") if name})


def check(root):
    problems = []
    files = git(root, "ls-files", "-z", "--cached", "--others", "--exclude-standard")
    for name in sorted({file.split("/")[0] for file in files} - set(TOP_LEVEL)):
        problems.append(f"{name}: not a name of the top level; delete it, move it into a folder, or, if runs leave "
                        "such files behind, name it in .gitignore (tests/check_tree.py lists the allowed names)")
    for file in files:
        path = root / file
        size = path.stat().st_size if path.is_file() and not path.is_symlink() else 0
        if size > LARGEST_FILE and file not in LARGE_FILES:
            problems.append(f"{file}: {size} bytes, at most {LARGEST_FILE} are allowed (LARGE_FILES in "
                            "tests/check_tree.py names the exceptions)")
    for file in git(root, "ls-files", "-z", "--cached", "--ignored", "--exclude-standard"):
        problems.append(f"{file}: tracked, but hidden by .gitignore")
    ignored = git(root, "check-ignore", "--no-index", "-z", "--stdin", input="\0".join(LEFT_BEHIND).encode())
    for file in sorted(set(LEFT_BEHIND) - set(ignored)):
        problems.append(f"{file}: runs leave such files behind, but .gitignore does not name them")
    return problems


if __name__ == "__main__":
    try:
        found = check(pathlib.Path(sys.argv[1]).resolve())
    except (OSError, subprocess.CalledProcessError) as error:
        print(f"skipped: git cannot list the files: {error}")
        sys.exit(77)
    for problem in found:
        print(problem)
    sys.exit(1 if found else 0)
