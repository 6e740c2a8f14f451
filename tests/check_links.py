#!/usr/bin/env python3
"""Fails when a page of the project (*.md) leads to something that is not there.

Usage: check_links.py ROOT

Links and pictures inside the repository must exist, and anchors be headings of the page that they are in. Files that the
text names as code, such as `core/film/film.h`, must exist below the root or below the page's folder, and so must the tests
that it names as CTest does: `shapes/sphere` is tests/shapes/sphere_test.cpp. The first page has at most 150 lines.
"""
import pathlib
import re
import sys

FENCE = re.compile(r"^```(\w*)\n(.*?)^```\s*$", re.MULTILINE | re.DOTALL)
CODE = re.compile(r"`([^`]+)`")
LONGEST_FIRST_PAGE = 150  # lines; what is longer belongs on the page of what it is about
INVENTED = re.compile(r"/(velvet|stripes|cylinder)(_test)?\.")  # files of the examples "how to add ..."


def list_pages(root):
    skipped = {"build", ".git"}
    return sorted(p for p in root.rglob("*.md") if p.relative_to(root).parts[0] not in skipped)


def anchors_of(page):
    """Of a page's headings: in lower case, without punctuation, with hyphens for spaces, numbered where equal."""
    anchors = set()
    for heading in re.findall(r"^#+\s+(.*?)\s*$", FENCE.sub("", page.read_text(encoding="utf-8")), re.MULTILINE):
        base = re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-")
        anchor, count = base, 0
        while anchor in anchors:
            count += 1
            anchor = f"{base}-{count}"
        anchors.add(anchor)
    return anchors


def check_links(page, root):
    """Yields what is wrong with the links of a page."""
    text = CODE.sub("", FENCE.sub("", page.read_text(encoding="utf-8")))
    targets = re.findall(r"\]\(\s*([^)\s]+)[^)]*\)", text) + re.findall(r'(?:src|href)="([^"]+)"', text)
    for target in targets:
        if re.match(r"[a-z]+:", target):
            continue
        path, _, anchor = target.partition("#")
        file = (page.parent / path).resolve() if path else page
        if not file.exists() or root not in [file, *file.parents]:
            yield f"link to {target}: there is no such file"
        elif anchor and anchor not in anchors_of(file):
            yield f"link to {target}: no heading of that page has this anchor"


def check_names(page, root):
    """Yields the files and tests that a page names but that do not exist."""
    tests = root / "tests"
    for code in CODE.findall(FENCE.sub("", page.read_text(encoding="utf-8"))):
        if re.fullmatch(r"[\w.-]+/[\w./-]+\.(h|cpp|frag|vert|py|sh|cmake|json|md)", code) and not INVENTED.search(code):
            if not any((folder / code).exists() for folder in (root, page.parent)):
                yield f"{code}: there is no such file"
        elif re.fullmatch(r"[a-z]+/[a-z_]+", code) and not any((f / code).exists() for f in (root, page.parent)):
            room, name = code.split("/")
            files = [code + end for end in ("_test.cpp", ".sh", "_slow.sh", "_nightly.sh")] + [f"{room}/test_{name}.py"]
            lists = (tests / "CMakeLists.txt").read_text()
            listed = re.search(rf"NAME {code}\b|_test\({name} ", lists)
            if (tests / room).is_dir() and not listed and not any((tests / file).exists() for file in files):
                yield f"{code}: there is no such test"


def check(root):
    problems = []
    for page in list_pages(root):
        name = page.relative_to(root)
        problems += [f"{name}: {problem}" for problem in [*check_links(page, root), *check_names(page, root)]]
    lines = len((root / "README.md").read_text(encoding="utf-8").splitlines())
    if lines > LONGEST_FIRST_PAGE:
        problems.append(f"README.md: {lines} lines, at most {LONGEST_FIRST_PAGE} are allowed on the first page")
    return problems


if __name__ == "__main__":
    found = check(pathlib.Path(sys.argv[1]).resolve())
    for problem in found:
        print(problem)
    sys.exit(1 if found else 0)
