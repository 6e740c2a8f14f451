#!/usr/bin/env python3
"""Fails when a file includes what its room may not see, or when files include each other in a circle.

Usage: check_layers.py ROOT

The rooms of the house are listed below, lowest first. A file may include headers of its own room and of rooms on lower
levels; rooms on one level do not see each other. Within a room a header and the source of the same name count as one
unit, and units may not need each other in a circle: then neither could be understood, tested or replaced alone.
"""
import pathlib
import re
import sys

LEVELS = [
    ["core/system"],
    ["core/base"],
    ["core/shapes", "core/materials", "core/media", "core/textures", "core/film"],
    ["core/image"],
    ["core/accuracy", "core/clean"],
    ["core/scene"],
    ["core/compile"],
    ["core/trace"],
    ["core/guide", "core/specular"],
    ["core/transport"],
    ["core/reuse"],
    ["core/targets"],
    ["core/render"],
    ["core/files"],
    ["core/api"],
    ["app/text"],
    ["app/book", "app/book/inside", "app/manual", "app/python"],
    ["app/files"],
    ["app/curves"],
    ["app/report", "app/export"],
    ["app/comparison"],
    ["app/check"],
    ["app/window/system"],
    ["app/window/document", "app/window/picture"],
    ["app/window/tools"],
    ["app/window/edit", "app/window/accuracy", "app/window/gallery"],
    ["app/window/handles"],
    ["app/window/panels"],
    ["app/window/menus", "app/window/rendering", "app/window/variations", "app/window/timeline"],
    ["app/window/inspector"],
    ["app/window"],
    ["app/cli", "app/watch", "app/web"],
    ["app"],
]
LEVEL = {room: level for level, rooms in enumerate(LEVELS) for room in rooms}

# What is linked to a reader's program, and opens its files in the place of the system.
IN_PROGRAMS = "app/book/inside/files.cpp"
# Headers from outside, and the only files that may include them.
RESERVED = [
    (r"(GLFW|glad|GL|EGL|X11)/|(backends/)?imgui", r"app/(window|web)/"),
    (r"emscripten/", r"app/web/"),
    (r"CLI/", r"app/cli/"),
    (r"fmt/", r"app/"),
    (r"hwy/", r"core/base/lanes_simd\.h$"),
    (r"nlohmann/", r"app/|core/scene/json[a-z_]*\.cpp$"),
    (r"(stb/)?stb_(truetype|easy_font)", r"app/report/contact_sheet\.cpp$"),
    (r"(OpenEXR|Imath)/|Imf|Imath|(stb/)?stb_image|jpeglib|jerror|png\.h", r"core/image/(image_io[a-z_]*\.cpp|image_io_exr\.h)$"),
    (r"iostream$", r"app/"),
    # The system's one door: not even its headers let others see what is behind it.
    (r"(sys|linux|net|netinet|arpa)/|(unistd|fcntl|poll|c?signal|pthread|sched|dlfcn|link|spawn|termios|ifaddrs|netdb|pwd|"
     r"dirent|glob|execinfo|ucontext|time)(\.h)?$", rf"core/system/[a-z_]+\.cpp$|{IN_PROGRAMS}$"),
    (r"(windows|winsock2|ws2tcpip|io|direct|psapi|shellapi|shlobj)\.h$", r"core/system/([a-z_]+_windows\.cpp|windows_api\.h)$"),
]
# Words of the language, and the only files that may use them: the rest is the same for every system, and gives the same
# bits with every C library. What measures pictures may differ in the last one, and so may references in double.
WORDS = [
    (r"#.*\b(_WIN32|WIN32|_WIN64|__MINGW\w*|_MSC_VER|_UCRT)\b", r"core/system/"),
    (r"std::(a?sin|a?cos|a?tan|atan2|exp2?|log2?|log1p|expm1|pow|hypot|cbrt)\(",
     r"app/|core/accuracy/|core/base/math\.h$|core/render/measure\.cpp$|core/shapes/specular_deflection\.h$"),
]
GENERATED = {"shaders.h"}
# What the house and a reader's program write to each other, for both.
SHARED = {"app/book/tyndall/book/functions.h"}
# Headers for programs of others: no part of the house, and they include nothing of it.
FOR_READERS = ("app/book/tyndall/", "app/watch/tyndall/", "core/api/tyndall/")
# Sizes, as (from here on a warning is printed, from here on the check fails). A file or a room that grows beyond the
# first is to be split by topic, never by count.
LINES_OF_FILE = (300, 450)
FILES_IN_ROOM = (30, 45)


def unit_of(path):
    return str(path.with_suffix(""))


def find_circle(needs):
    """One circle of units as a list, or None. needs: unit -> the units it includes."""
    state = {}

    def visit(unit, way):
        state[unit] = "open"
        for other in sorted(needs.get(unit, ())):
            if state.get(other) == "open":
                return way[way.index(other):] + [other]
            if other not in state:
                circle = visit(other, way + [other])
                if circle:
                    return circle
        state[unit] = "done"
        return None

    for unit in sorted(needs):
        if unit not in state:
            circle = visit(unit, [unit])
            if circle:
                return circle
    return None


def check_size(what, size, limits, problems):
    warn, fail = limits
    if size > fail:
        problems.append(f"{what}: {size}, at most {fail} are allowed")
    elif size > warn:
        print(f"warning: {what}: {size}, more than {warn}")


def check(root):
    problems, needs, sizes = [], {}, {}
    files = sorted(p.relative_to(root) for top in ("core", "app") for p in (root / top).rglob("*") if p.suffix in (".h", ".cpp"))
    for file in files:
        if str(file).startswith(FOR_READERS):
            continue
        room = str(file.parent)
        if room not in LEVEL:
            problems.append(f"{file}: {room} is no room of the house (tests/check_layers.py lists them)")
            continue
        sizes[room] = sizes.get(room, 0) + 1
        lines = (root / file).read_text(encoding="utf-8").splitlines()
        check_size(f"lines of {file}", len(lines), LINES_OF_FILE, problems)
        for line in lines:
            own = re.match(r'\s*#\s*include\s*"([^"]+)"', line)
            other = re.match(r"\s*#\s*include\s*<([^>]+)>", line)
            if own and own[1] not in GENERATED | SHARED:
                header = pathlib.PurePosixPath(own[1])
                target = str(header.parent)
                if target not in LEVEL:
                    problems.append(f'{file}: "{header}" is not a path from the root (core/<room>/... or app/<room>/...)')
                elif not (root / header).exists():
                    problems.append(f"{file}: {header} does not exist")
                elif target != room and LEVEL[target] >= LEVEL[room]:
                    problems.append(f"{file}: {room} may not include {header}")
                elif unit_of(header) != unit_of(file):
                    needs.setdefault(unit_of(file), set()).add(unit_of(header))
            if re.match(r'\s*extern "C"', line) and room != "core/system" and str(file) != IN_PROGRAMS:
                problems.append(f"{file}: may not declare functions of the system or of libraries; core/system does")
            for words, allowed in WORDS:
                found = re.search(words, line)
                if found and not re.match(allowed, str(file)):
                    problems.append(f"{file}: may not use {found[0]}; only files that match {allowed} may")
            if other:
                for headers, allowed in RESERVED:
                    if re.match(headers, other[1]) and not re.match(allowed, str(file)):
                        problems.append(f"{file}: may not include <{other[1]}>; only files that match {allowed} may")
    for room, size in sizes.items():
        check_size(f"files in {room}", size, FILES_IN_ROOM, problems)
    circle = find_circle(needs)
    if circle:
        problems.append("files include each other in a circle: " + " -> ".join(circle))
    return problems


if __name__ == "__main__":
    found = check(pathlib.Path(sys.argv[1]))
    for problem in found:
        print(problem)
    sys.exit(1 if found else 0)
