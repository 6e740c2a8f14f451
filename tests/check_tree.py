#!/usr/bin/env python3
"""Fails when something lies in the repository that does not belong there.

Usage: check_tree.py ROOT

Three rules, for all files that git tracks or would add (neither tracked nor ignored):
1. The top level holds the names below and no others.
2. No file is larger than 1 MB, unless LARGE_FILES names it: every clone carries it for ever.
3. No tracked file is ignored: .gitignore would hide the next one of its kind.
Exit code 77 (skipped) where there is no git, as in an unpacked archive.
"""
import pathlib
import subprocess
import sys

TOP_LEVEL = """app assets core shaders tests third_party .ci .github .clang-format .clang-tidy .gitignore CMakeLists.txt
CMakePresets.json CONTRIBUTING.md LICENSE README.md SECURITY.md run test""".split()
LARGEST_FILE = 1_000_000  # bytes
LARGE_FILES = []  # paths of files that may be larger, each with a comment that says why


def git_files(root, *options):
    command = ["git", "-c", f"safe.directory={root}", "-C", str(root), "ls-files", "-z", *options]
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=True)
    return sorted({name for name in done.stdout.decode().split("\0") if name})


def check(root):
    problems = []
    files = git_files(root, "--cached", "--others", "--exclude-standard")
    for name in sorted({file.split("/")[0] for file in files} - set(TOP_LEVEL)):
        problems.append(f"{name}: not a name of the top level; delete it, move it into a folder, or, if runs leave "
                        "such files behind, name it in .gitignore (tests/check_tree.py lists the allowed names)")
    for file in files:
        path = root / file
        size = path.stat().st_size if path.is_file() and not path.is_symlink() else 0
        if size > LARGEST_FILE and file not in LARGE_FILES:
            problems.append(f"{file}: {size} bytes, at most {LARGEST_FILE} are allowed (LARGE_FILES in "
                            "tests/check_tree.py names the exceptions)")
    for file in git_files(root, "--cached", "--ignored", "--exclude-standard"):
        problems.append(f"{file}: tracked, but hidden by .gitignore")
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
