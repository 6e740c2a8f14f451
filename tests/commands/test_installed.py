"""What "cmake --install" puts where: a program that works without the sources, its manual, completion for three shells;
and the libraries, found by CMake and by pkg-config, used from C and C++. tests/library and tests/python test those."""

import gzip
import os
import pathlib
import re
import shutil
import subprocess

import pytest
from program import HAS_EXR, PROGRAM, ROOT, image_hash, pixels_of, read, run, same_picture, write

BUILD = pathlib.Path(PROGRAM).parent
STRICT = "-Wall -Wextra -Wpedantic -Werror -Wconversion -Wshadow"
INSTALLED = """bin/tyndall share/tyndall/scene.schema.json share/tyndall/scenes/showroom.json
share/man/man1/tyndall.1.gz share/bash-completion/completions/tyndall share/zsh/vendor-completions/_tyndall
share/fish/vendor_completions.d/tyndall.fish share/applications/tyndall.desktop share/mime/packages/tyndall.xml
share/icons/hicolor/scalable/apps/tyndall.svg share/doc/tyndall/copyright include/tyndall/watch.h
include/tyndall/tyndall.h""".split()
pytestmark = pytest.mark.skipif(not (BUILD / "cmake_install.cmake").exists(), reason=f"{BUILD} is no build folder")


def shell(command, code=0, **environment):
    """What a command prints, without the assets of the sources."""
    done = subprocess.run(["bash", "-c", f"unset TYNDALL_ASSETS; {command}"], capture_output=True, text=True,
                          env=os.environ | environment)
    assert done.returncode == code, f"{command}: {done.stdout}{done.stderr}"
    return done.stdout + done.stderr * (code > 0)


@pytest.fixture(scope="module")
def tree(tmp_path_factory):
    """An installed tree, moved elsewhere: it works wherever it is."""
    folder = tmp_path_factory.mktemp("tree")
    shell(f"cmake --install '{BUILD}' --prefix {folder}/there --strip")
    (folder / "there").rename(folder / "moved")
    return folder / "moved"


@pytest.fixture
def moved(tree, monkeypatch):
    monkeypatch.setenv("PATH", f"{tree}/bin:{os.environ['PATH']}")
    return tree


def library_of(tree, name):
    """The library's folder, and what pkg-config says. It shows no more names than it should, and looks nowhere else."""
    library, = tree.rglob(f"lib{name}.so.0")
    dynamic = shell(f"readelf -d {library}")
    assert f"[lib{name}.so.0]" in dynamic
    assert not re.search("RPATH|RUNPATH|TEXTREL", dynamic)
    flags = shell(f"pkg-config --cflags --libs {name}", PKG_CONFIG_PATH=f"{library.parent}/pkgconfig").strip()
    return library, flags


def test_files(tree):
    assert all((tree / name).stat().st_size for name in INSTALLED)
    everything = list(tree.rglob("*"))
    assert not [path for path in everything if re.match(r"\..*|__pycache__|.*\.md~", path.name)]
    assert not [path for path in everything if path.is_symlink() and not re.match(r"libtyndall.*\.so", path.name)]
    if re.search(", Release$", run("version"), re.M):  # sanitizers keep the names of the sources
        shell(f"! grep -rlF -- '{ROOT}' {tree}")


def test_program(moved):
    assert shell("tyndall scenes") == run("scenes")
    shell("tyndall render earth --size 16x9 --spp 1 -q -o earth.pfm")
    run("render earth --size 16x9 --spp 1 -q -o same.pfm")
    assert read("earth.pfm") == read("same.pfm")
    version = shell("tyndall version")
    assert re.search("^compiler ", version, re.M)
    if not re.search("^guard  *none$", version, re.M):  # so it works with the headers by which it reads programs
        shell(f"tyndall convert '{ROOT}/assets/examples/book/main.cc' -o main.json")


def test_manual(moved):
    """It names all commands and options, and man has nothing to complain about; so does completion for fish."""
    page = gzip.decompress((moved / "share/man/man1/tyndall.1.gz").read_bytes()).decode()
    fish = (moved / "share/fish/vendor_completions.d/tyndall.fish").read_text()
    for command in set(re.findall(r"^  ([a-z]+)  ", shell("tyndall --help"), re.M)) - {"help"}:
        for option in re.findall("^  (?:-[a-z],)?--([a-z0-9-]+)", shell(f"tyndall {command} --help"), re.M):
            assert "\\fB\\-\\-" + option.replace("-", "\\-") in page, f"{option} of {command}"
            assert f" {option} " in fish or re.search(f"-l {option}( |$)", fish, re.M), f"{option} of {command}"
    write("tyndall.1", page)
    if shutil.which("man"):
        assert not shell("LC_ALL=C.UTF-8 MANWIDTH=100 man --warnings -E UTF-8 -l tyndall.1 2>&1 >page")
    for command in ("zsh -n {}/share/zsh/vendor-completions/_tyndall",
                    "desktop-file-validate {}/share/applications/tyndall.desktop"):
        if shutil.which(command.split()[0]):
            shell(command.format(moved))


@pytest.mark.parametrize("words, offered", [
    ("ren", "render"), ("render --samp", "--sampler --samples"), ("render cover --integrator ''", "mis nee path"),
    ("render cover --caustics = c", "chains"), ("render cover --dither ''", "off on"),
    ("render cornell", "cornell-box cornell-smoke"), ("render 'a s'", "a scene.json"),
    ("render cover -o 'a '", "a scene.json"), ("render cover --spp ''", "")])
def test_completion(moved, words, offered):
    """What bash, and fish, offer for the last word."""
    write("a scene.json", "")
    found = shell(f"""compopt() {{ :; }}
      . {moved}/share/bash-completion/completions/tyndall
      COMP_WORDS=(tyndall {words}); COMP_CWORD=$((${{#COMP_WORDS[@]}} - 1))
      _tyndall
      printf '%s\\n' "${{COMPREPLY[@]}}" | sort""")
    assert " ".join(found.split("\n")).strip() == offered
    if words.endswith("--integrator ''") and shutil.which("fish"):
        said = shell(f"fish --no-config -c 'source {moved}/share/fish/vendor_completions.d/tyndall.fish; "
                     "complete -C \"tyndall render cover --integrator \"'", HOME=os.getcwd())
        assert sorted(line.split("\t")[0] for line in said.splitlines()) == offered.split()


USER = """#include <tyndall/tyndall.h>
#include <cstdio>
int main() {
  tyndall::Scene scene = tyndall::Scene::load("cornell-box");
  scene.set("/image/width", 16);
  scene.set("/image/height", 9);
#if __cplusplus >= 202002L
  const tyndall::Picture picture = tyndall::render(scene, {.spp = 2});
#else
  tyndall::RenderOptions options;
  options.spp = 2;
  const tyndall::Picture picture = tyndall::render(scene, options);
#endif
  std::puts(picture.hash().c_str());
}
"""
MODULE = """import tyndall
scene = tyndall.scene("cornell-box")
scene["/image/width"], scene["/image/height"] = 16, 9
print(scene.render(spp=2).hash)"""


def test_library(moved):
    """Used with all warnings, from C++17 and C++20, from a project of CMake's, and from Python."""
    library, flags = library_of(moved, "tyndall")
    own = " tyndall::v0::(Scene|Film|Picture|Error|render|compare|version|detail::)"
    own += "|(typeinfo|typeinfo name|vtable) for tyndall::v0::Error$"
    names = shell(f"nm -DC --defined-only {library}").splitlines()
    assert not [name for name in names if not re.search(own, name)]
    assert not re.search("NEEDED.*(glfw|GL|X11|imgui)", shell(f"readelf -d {library}"))
    write("user.cpp", USER)
    hashes = {image_hash("cornell-box --size 16x9 --spp 2")}
    for standard in (17, 20):
        shell(f"${{CXX:-c++}} -std=c++{standard} -O1 {STRICT} user.cpp -o user {flags}")
        hashes.add(shell("./user", LD_LIBRARY_PATH=str(library.parent)).strip())
    for module in moved.rglob("_tyndall*.so"):
        write("module.py", MODULE)
        hashes.add(shell("/usr/bin/python3 -B module.py", PYTHONPATH=str(module.parents[1])).strip())
    assert len(hashes) == 1
    shell(f"cmake -S '{ROOT}/assets/examples/cmake' -B example -DCMAKE_PREFIX_PATH={moved} && cmake --build example")
    assert len(re.findall(r"^/camera/vfov .*: mean 0\.[0-9]*, error 0\.", shell("example/sweep"), re.M)) == 3
    shell("example/sweep nothing", 2)


@pytest.fixture
def watch(moved, monkeypatch):
    """The library for programs with samples of their own, and ./probe of tests/app/watch, without a window."""
    if not (BUILD / "libtyndall-watch.so").exists():
        pytest.skip(f"{BUILD} has no library")
    library, flags = library_of(moved, "tyndall-watch")
    monkeypatch.setenv("LD_LIBRARY_PATH", str(library.parent))
    names = shell(f"nm -D --defined-only {library}")
    assert set(re.findall(r"\S+$", names, re.M)) == {"tyndall_watch", "tyndall_watch_fail"}
    shell(f"${{CXX:-c++}} -std=c++17 -O1 {STRICT} '{ROOT}/tests/app/watch/probe.cpp' -o probe {flags}")
    return flags


def test_watched_pictures(watch, moved):
    """Each pixel is the mean of its own samples, whatever the number of threads; formats go by the files' endings."""
    def wrong(name):
        rows = pixels_of(name)
        return [(x, y) for y, row in enumerate(rows) for x, pixel in enumerate(row) if pixel != (x, y, 4)]
    shell("./probe colours && ./probe place a.pfm && ./probe twice b.pfm")
    assert len(pixels_of("a.pfm")) == 30 and not wrong("a.pfm")
    assert read("a.pfm") == read("b.pfm") == read("again-b.pfm")
    assert shell("./probe threads c.pfm").strip() == "at most 3 at once"
    assert len(pixels_of("c.pfm")) == 64 and not wrong("c.pfm")
    for ending in ("png", "ppm", "hdr", *["exr"] * HAS_EXR):
        shell(f"./probe place a.{ending}")
    if HAS_EXR:
        same_picture("a.exr", "a.pfm")
    examples = f"{ROOT}/assets/examples/watch"
    shell(f"${{CC:-cc}} -std=c99 {STRICT} '{examples}/rings.c' -o rings {watch} -lm && ./rings rings.pfm")
    shell(f"python3 '{examples}/rings.py' python.pfm")
    assert read("python.pfm")
    # The program's own things stay as they were.
    assert shell("./probe process p.pfm").strip() == "rounds still signals C"
    if os.environ.get("TYNDALL_THOROUGH"):
        shell(f"cmake -S '{examples}' -B example -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH={moved}")
        shell("cmake --build example")
        shell("example/rings cmake.pfm && env -u LD_LIBRARY_PATH example/ball ball.png")
        assert read("rings.pfm") == read("cmake.pfm")


def test_watched_failures(watch):
    """What fails is told once, with its pixel and sample, and left out. What is wrong is one line."""
    for code, arguments, *words in [
            (1, "throws failed.pfm", "pixel (3, 4), sample 2: ", r"no mesh\nhere"),
            (1, "throws-other failed.pfm", "pixel (3, 4), sample 2: ", "no std::exception"),
            (1, "nan failed.pfm", "pixel (3, 4), sample 2: ", "found (1, nan, 1), expected finite numbers"),
            (1, "infinite failed.pfm", "pixel (3, 4), sample 2: ", "found (1, 1, inf)"),
            (2, "size x.png 0 10", "found a picture of 0x10 pixels, expected 1 to 65536"),
            (2, "size x.png -3 10", "expected 1 to 65536"), (2, "size x.png 10 70000", "expected 1 to 65536"),
            (2, "size x.png 2147483647 2147483647", "expected 1 to 65536"),
            (2, "size x.png 65536 65536", "65536x65536 pixels"), (2, "null", "found no function"),
            (2, "wrong-size", "size of the options: found 0"),
            (2, "wrong-threads x.png", "threads: found -1"),
            (2, "wrong-reference x.png", 'reference: found "cover", expected none beside output'),
            (2, "place x.jpg", 'found "x.jpg", expected a name that ends in .png'),
            (3, "place nowhere/x.png", "nowhere/x.png: cannot write: there is no folder nowhere"),
            (3, "place -", "no display", "option output")]:
        said = shell(f"./probe {arguments}", code)
        assert said.startswith("tyndall: ") and said.count("\n") == 1, arguments
        assert all(word in said for word in words), (arguments, said)
        if code == 1:
            os.remove("failed.pfm")
    lines = shell("./probe silent failed.pfm", 1).splitlines()
    told = "tyndall: 16 samples have failed; the first: pixel (0, 0), sample 0: found (nan, nan, nan)"
    assert len(lines) == 2 and any(line.startswith(told) for line in lines)
