#!/usr/bin/env python3
"""Fails when a page of the project (*.md) or a text of --help shows a command that does not work.

Usage: check_commands.py TYNDALL SCRATCH ROOT [PAGE]
TYNDALL: the program; SCRATCH: a folder to work in; ROOT: of the sources; PAGE: the only page to check

Commands are the lines of blocks that are fenced as "sh", the pieces of code in the text that begin with "tyndall" or
"./run", and the examples of "tyndall COMMAND --help". They run in the order in which a page shows them, in a folder of the
page, made small by SMALL; PLACEHOLDERS says what words in capitals stand for, and which smaller thing stands for a large one.
Commands that open the window run without a display, and must say so. What only reads runs once for the same files. Commands that take minutes whatever their size (is_long) and those with "..." or "…" do not run:
their options are looked up in the texts of --help, as are all other options that a page names.
"""
import json
import os
import pathlib
import re
import resource
import shlex
import shutil
import subprocess
import sys

from check_links import CODE, FENCE, list_pages

SMALL = {
    "render": ["--size", "32x18", "-q"],
    "sweep": ["--size", "32x18", "--spp", "1", "-q"],
    "animate": ["--size", "32x18", "--spp", "1", "-q", "--fresh"],
    "chart": ["--size", "16x9", "--budget", "0.5", "-q"],
    "verify": ["-q"],
}
LIMITS = {"--samples", "--replay"}  # options of render that exclude --spp
PLACEHOLDERS = {
    "SCENE": "cornell-box", "IMAGE": "a.exr", "REFERENCE": "b.exr", "PART": "a.exr b.exr", "PART...": "a.exr b.exr",
    "FILM.exr": "fog.exr", "DIR": "kept",
    "FILE": "made.png", "FILE.png": "made.png", "FILE.svg": "made.svg", "FILE.json": "made.json", "NAME.png": "out.png",
    "SHEET.png": "sheet.png", "POINTER=FROM:TO:STEPS": "/camera/vfov=30:40:3", "N": "2",
    "MAIN.cc": "main.cc", "COMMAND": "render", "NAME": "plate/reflected-n1.5-0deg", "POINTER=VALUE": "/camera/vfov=30", "X,Y,SAMPLE": "1,1,0",
    "fog-ball/": "fog-ball/depth1-albedo0.5-b0",
}
OTHER_OPTIONS = {"--all", "--nightly", "--preset", "--build", "--target", "--cflags", "--libs",  # of ./test, CMake, pkg-config
                 "--install", "--no-skip",  # of CMake, doctest
                 "--factory-startup", "--agree", "--longest"}  # of Blender, tests/peers


def commands_of(text):
    """The commands of a page, in order."""
    found = []
    for match in re.finditer(FENCE.pattern + r"|" + CODE.pattern, text, FENCE.flags):
        language, block, code = match.groups()
        if language == "sh":
            found += [line for line in block.splitlines() if line.strip() and not line.lstrip().startswith("#")]
        elif code and re.match(r"(tyndall|\./run|build/release/tyndall)(\s|$)", code):
            found.append(" ".join(code.split()))
    return found


def replace_placeholders(command):
    """Without what is optional ("[NAME…]"), and with something real for words in capitals."""
    command = re.sub(r" \[[^\]\d]*[A-Z][^\]]*\]", "", command).replace("PART…", "PART").replace("IMAGE…", "IMAGE")
    return " ".join(PLACEHOLDERS.get(word, word) for word in command.split(" "))


def options_of(text):
    return set(re.findall(r"(?<![\w-])--[a-z][a-z-]+", text))


def is_long(words):
    whole_verify = words[0] == "verify" and not any("/" in word for word in words)
    return whole_verify or "--thorough" in words or words[:2] == ["chart", "all"]


class Commands:
    """Runs commands, each once in a folder."""

    def __init__(self, tyndall, scratch, root):
        self.tyndall, self.root, self.folder = tyndall, root, root
        self.environment = {k: v for k, v in os.environ.items() if k not in ("DISPLAY", "WAYLAND_DISPLAY")}
        self.overview = self.output(["--help"])
        names = re.findall(r"^  ([a-z]+) ", self.overview.split("Commands:")[1].split("Options:")[0], re.MULTILINE)
        self.help = {name: self.output([name, "--help"]) for name in names}
        self.with_exr = True
        self.read = set()
        self.make_fixtures(scratch)

    def output(self, words):
        return subprocess.run([self.tyndall, *words], cwd=self.folder, capture_output=True, check=True, text=True).stdout

    def make_fixtures(self, scratch):
        """What pages read without making it, and a root whose ./run and ./test build nothing."""
        shutil.rmtree(scratch, ignore_errors=True)
        self.fixtures = scratch / "fixtures"
        self.fixtures.mkdir(parents=True)
        for part in ("scenes", "textures", "verify"):
            shutil.copytree(self.root / "assets" / part, self.fixtures / "assets" / part)
        self.folder = self.fixtures
        self.output(["convert", "cornell-smoke", "-o", "fog.json"])
        keys = '{"frames": 60, "keys": {"/camera/vfov": {"0": 30, "59": 40}}}'
        self.output(["convert", "showroom", "--set", "/animation=" + keys, "-o", "film.json"])
        (self.fixtures / "f").mkdir()
        small = ["--size", "32x18", "-q"]
        self.output(["render", "cornell-smoke", "--spp", "2", *small, "-o", "out.png"])
        shutil.copy(self.fixtures / "out.png", self.fixtures / "snapshot.png")
        example = self.root / "assets/examples/book"
        shutil.copytree(example / "tracer", self.fixtures / "tracer")
        main = (example / "main.cc").read_text(encoding="utf-8")
        (self.fixtures / "main.cc").write_text(main.replace("width = 400", "width = 40"), encoding="utf-8")
        self.output(["render", "cornell-box", "--spp", "4", *small, "-o", "image.ppm"])
        try:
            for name, samples in (("a", "0:1"), ("b", "1:2"), ("A", "0:2"), ("B", "0:2"), ("reference", "0:4"), ("fog", "0:4")):
                self.output(["render", "cornell-smoke", "--samples", samples, *small, "-o", name + ".exr"])
            self.output(["compare", "a.exr", "--baseline", "kept", "--update"])
        except subprocess.CalledProcessError:
            self.with_exr = False  # a build without OpenEXR
        self.fake = scratch / "root"
        for name in ("third_party", "build/release", "bin"):
            (self.fake / name).mkdir(parents=True)
        for name in ("run", "test", "third_party/packages.sh", "third_party/switches.sh"):
            shutil.copy(self.root / name, self.fake / name)
        for link, target in {"build/release/tyndall": self.tyndall, "bin/cmake": "/bin/true", "bin/ctest": "/bin/true"}.items():
            (self.fake / link).symlink_to(target)
        self.environment |= {"TYNDALL_SKIP_PACKAGES": "1", "PATH": f"{self.fake}/bin:{os.environ['PATH']}"}

    def start_page(self, scratch, name):
        self.folder = scratch / name.replace("/", "-")
        shutil.copytree(self.fixtures, self.folder)

    def check(self, command):
        """Yields what is wrong with a command as a page shows it."""
        try:
            words = shlex.split(replace_placeholders(command), comments=True)
        except ValueError as error:
            yield f"the shell cannot read this: {error}"
            return
        words = words[:words.index("|")] if "|" in words[1:] else words
        while words and re.match(r"[A-Z_]+=", words[0]):
            words.pop(0)
        program, words = words[0], words[1:]
        if program in ("tyndall", "build/release/tyndall"):
            yield from self.check_tyndall([self.tyndall], words)
        elif program == "./run" and words != ["web"]:  # which serves until it is stopped
            yield from self.check_tyndall([self.fake / "run"], words[1:] if words[:1] == ["view"] else words)
        elif program == "./test":
            yield from self.run([self.fake / "test", *words], {0})
        else:
            yield from self.check_other(program, words)

    def check_tyndall(self, program, words):
        first = words[0] if words else "view"
        name = first if words and first in self.help else None
        if name and len(words) == 1 and name not in ("view", "scenes"):
            return  # the text speaks of a command
        needs_exr = not self.with_exr and any(".exr" in word or word == "kept" for word in words)
        if "…" in words or any("{" in word for word in words) or needs_exr or (name and is_long(words)):
            for option in sorted(options_of(" ".join(words)) - options_of(self.help[name or "view"])):
                yield f"{option} is no option of tyndall {name or 'view'}"
            return
        through_run = program != [self.tyndall]  # ./run renders, as there is no display
        renders = name == "render" or (through_run and not name and first != "--help")
        small = ["--spp", "1"] * (renders and not LIMITS & set(words)) + ["--trust"] * ("main.cc" in words)
        small += ["--time", "1"] if name == "compare" and "image.ppm" in words else SMALL.get("render" if renders else name, [])
        checks = name == "verify" or any(word.startswith("--max-") for word in words)
        opens_window = not through_run and (name == "view" or (not name and not re.match("help$|version$|-", first)))
        if opens_window or name == "inspect":
            files = (self.folder / word for word in words)
            reads = (*words, *(file.read_bytes() for file in files if file.is_file()))
            if reads in self.read:
                return
            self.read.add(reads)
        yield from self.run([*program, *words, *small], {3} if opens_window else {0, 1} if checks else {0})

    def run(self, command, expected):
        # A limit of processor time, as it does not depend on what else the machine is doing. CTest ends what only waits.
        done = subprocess.run(command, cwd=self.folder, env=self.environment, stdin=subprocess.DEVNULL, capture_output=True,
                              preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (240, 240)))
        if done.returncode not in expected:
            shown = " ".join(str(word) for word in command)
            yield f"exit code {done.returncode}: {shown}: {done.stderr.decode().strip()}"

    def check_other(self, program, words):
        if program == "cmake":
            lists = (self.root / "CMakeLists.txt").read_text() + (self.root / "tests/CMakeLists.txt").read_text()
            presets = [p["name"] for p in json.loads((self.root / "CMakePresets.json").read_text())["configurePresets"]]
            for option, word in zip(words, words[1:]):
                if option == "--preset" and word not in presets:
                    yield f"{word} is no preset of CMakePresets.json"
            for word in words[words.index("--target") + 1:] if "--target" in words else []:
                if not re.search(rf"add_(executable|library)\({word}\b", lists):
                    yield f"{word} is no target"
        elif program == "build/release/tyndall_bench":
            bench = (self.root / "tests/bench/main.cpp").read_text()
            for word in words:
                if "." not in word and f'"{word}"' not in bench:
                    yield f"{word} is neither a part nor an option of tyndall_bench"
        elif program != "alias" and not os.access(self.root / program, os.X_OK):
            yield f"{program} is neither known to tests/check_commands.py nor a program of the repository"

    def unknown_options(self, text):
        bench = (self.root / "tests/bench/main.cpp").read_text()
        known = options_of("".join(self.help.values()) + bench + self.overview) | set(OTHER_OPTIONS)
        for option in sorted(options_of(" ".join(CODE.findall(FENCE.sub("", text)))) - known):
            yield f"{option} is no option of any command"


def check(tyndall, scratch, root, only=None):
    commands = Commands(tyndall, scratch, root)
    problems = []
    for page in [only] if only else list_pages(root):
        name, text = str(page.relative_to(root)), page.read_text(encoding="utf-8")
        problems += [f"{name}: {problem}" for problem in commands.unknown_options(text)]
        commands.start_page(scratch, name)
        for command in commands_of(text):
            problems += [f"{name}: {command}: {problem}" for problem in commands.check(command)]
    for name, text in {} if only else commands.help.items():
        commands.start_page(scratch, "help-" + name)
        for example in re.findall(r"^  (tyndall .*)$", text, re.MULTILINE):
            problems += [f"tyndall {name} --help: {example}: {problem}" for problem in commands.check(example)]
    return problems


if __name__ == "__main__":
    found = check(*(pathlib.Path(argument).resolve() for argument in sys.argv[1:]))
    for line in found:
        print(line)
    sys.exit(1 if found else 0)
