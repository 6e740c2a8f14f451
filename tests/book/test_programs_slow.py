"""What readers' programs may have of their own, what is not taken for a scene, what fails, and what is left alone."""

import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import time

import pytest
from program import load, pixels_of, read, run, running, wait_until, write
from readers import BOOK, EXAMPLE, ball_of, has_guard, headers, program, world
from test_programs import same_scene

SECOND_BOOK = (BOOK / "newest.cc").read_text().split("int main")[0]


def test_example():
    """The program that the README's picture was made with: by its own headers, and as a scene, with the same balls."""
    shutil.copytree(EXAMPLE / "tracer", "tracer")
    text = (EXAMPLE / "main.cc").read_text()
    write("small.cc", text.replace("width = 400", "width = 40").replace("pixel = 100", "pixel = 400"))
    compiler = os.environ.get("CXX", "c++") + " -O2 -std=c++17 -Wall -Wextra -Werror"
    plain = subprocess.check_output(f"{compiler} -Itracer small.cc -o plain && ./plain", shell=True).split()[4:]
    run("render small.cc -Itracer -q -o tyndall.pfm")
    picture = pixels_of("tyndall.pfm")
    # Of the red ball's left half, where nothing is dark or clipped, so that means of bytes agree.
    errors = [int(plain[3 * (40 * y + x)]) - 256 * picture[y][x][0] ** 0.5
              for y in range(7, 16) for x in range(1, 8)]
    assert abs(sum(errors)) <= 4 * len(errors)


def test_columns_from_above():
    """A get_ray() whose second argument is 0 at the top, and loops that go down there, column by column."""
    headers(".", "third", {r"\+ t \* vertical": "+ (1 - t) * vertical"})
    write("main.cc", re.sub(r"int j = .*--j((?s:.*?))int i = .*\+\+i", r"int i = 0; i < width; ++i\1int j = 0; j < height; ++j",
                            (BOOK / "third.cc").read_text().replace("<< j", "")))
    same_scene("main.cc", BOOK / "third.json")


def test_numbers_and_files():
    """Random numbers are the program's, and files, also above its folder and of textures. A missing one is told."""
    write("deep/data/balls.txt", "-1 0 -3 0.5 1 0 -3 0.5")
    columns = [f"{32 * k} 0 0 " for k in range(8)]
    write("deep/src/map.ppm", "P3 8 1 255 " + "".join(columns))
    texture = ("struct picture : texture { picture(const char* file) { std::ifstream(file).get(); } color value(double u, double, "
               "const point3&) const override { return color(int(8 * u) * 32 / 255.0, 0, 0); } };")
    program("deep/src/main.cc", SECOND_BOOK + texture + world("make_shared<sphere>(point3(random_double(), 0, -1), 0.5, "
            "make_shared<textured>(make_shared<picture>(\"map.ppm\")))", render="""
        std::ifstream in("../data/balls.txt"); std::ofstream out("log.txt"); out << 1; if (!out.flush()) return 1;
        for (double x, y, z, r; in >> x >> y >> z >> r;) w.add(make_shared<sphere>(point3(x, y, z), r, grey));
        c.render(w);"""), {
            r"return std::rand\(\).*?;": "static unsigned s = 1; return (s = 1664525 * s + 1013904223) / 4294967296.0;"})
    run("convert deep/src/main.cc -o deep.json", 0, "takes the numbers of images as they are")
    objects, textures = load("deep.json")["objects"], load("deep.json")["textures"]
    assert textures == {"picture 1": {"type": "image", "file": os.path.abspath("deep/src/map.ppm")}}
    assert objects[0]["center"][0] == pytest.approx((1664525 + 1013904223) / 2**32, 1e-9)
    assert len(objects) == 3 and not os.path.exists("deep/src/log.txt")
    os.rename("deep/data/balls.txt", "deep/data/other.txt")
    write("deep/src/map.ppm", "P3 8 1 255 " + "".join(columns[::-1]))
    run("convert deep/src/main.cc -o x.json", 2, 'cannot open "../data/balls.txt"', "not those of map.ppm", lines=4)


QUAD = "make_shared<{}>(point3(0, 0, -1), vec3(1, 0, 0), vec3(0, 1, 0), grey)"
INTERIOR = "struct {} : quad {{ using quad::quad; bool is_interior(double a, double b) const override {{ {} }} }};"


def test_shapes():
    """Shapes that the book proposes, by classes of the program's; helpers of its own; threads; a get_ray() of row and
    column; other compilers."""
    threads = ("std::thread one([&] { camera d = c; d.render(w); }), two([&] { camera d = c; d.render(w); }); "
               "one.join(); two.join();")
    triangle = INTERIOR.format("triangle", "return a > 0 && b > 0 && a + b < 1;")
    washer = INTERIOR.format("washer", "double r = std::sqrt(a * a + b * b); return r > 0.25 && r < 0.5;")
    put = "template <class T> shared_ptr<hittable> put(T shape) { return make_shared<T>(shape); }"
    shapes = ("mine::put(mine::triangle(point3(0, 0, -1), vec3(1, 0, 0), vec3(0, 1, 0), grey))); "
              "w.add(mine::put(mine::washer(point3(0, 0, -2), vec3(2, 0, 0), vec3(0, 2, 0), grey))")
    helpers = f"#include <thread>\nnamespace mine {{ {triangle} {washer} {put} }}\n"
    turned = {r"get_ray\(x, y\)": "get_ray(y, x)", r"get_ray\(int x, int y\)": "get_ray(int y, int x)"}
    program("shapes.cc", helpers + world(shapes, render=threads), turned)
    run("convert shapes.cc -o shapes.json", loud=True)  # which may have seen both pictures
    first, second = load("shapes.json")["objects"]
    assert first["type"] == "triangle" and second["type"] == "disk" and second["inner"] == 0.5
    for compiler in filter(shutil.which, ("g++", "clang++")):
        run("convert shapes.cc -o again.json", loud=True, CXX=f"{compiler} -std=c++20")
        assert read("again.json") == read("shapes.json")


def test_several_files():
    """Several source files, a header in a folder that -I names, and options that do not fit a program's scene."""
    headers("several/include")
    write("several/world.h", '#include "rtweekend.h"\nhittable_list balls();')
    write("several/world.cc", '#include "world.h"\n\n\nhittable_list balls() { return hittable_list('
          f'{ball_of("make_shared<lambertian>(color(0.5, 0.5, 0.5))")}); }}')
    write("several/main.cc", '#include "world.h"\nint main() { camera c; c.background = {0, 1, 1}; c.render(balls()); }')
    run("convert several/main.cc several/world.cc -I several/include -o several.json")
    assert load("several.json")["background"] == [0, 1, 1]
    run("render several/main.cc -I several/include --set /camera/vfov=300 -q -o small.png", 2,
        "several/main.cc: /camera/vfov: found 300")
    run("chart several/main.cc -I several/include --size 8x6 --budget 1 -q -o chart.svg")
    # Found is a source file beside the header that announces its functions, also a folder of headers beside main.cc.
    for options in "-Iseveral/include", "":
        run(f"convert several/main.cc {options} -o beside.json")
        assert read("beside.json") == read("several.json")
    os.rename("several/world.cc", "several/balls.cc")
    run("convert several/main.cc -Iseveral/include -o several.json", 2, "several/main.cc: undefined reference to",
        "balls()", "name that, too")
    run("convert several/main.cc several.json -o refused.json", 2, 'unexpected argument "several.json"')
    os.mkdir("several/.git"), os.rename("several/include", "include")  # another project's
    run("convert several/main.cc several/balls.cc -o several.json", 2, "rtweekend.h: No such file")


def made_of(name, code):
    """A ball of a material with such a scatter()."""
    return ({}, f"struct {name} : dielectric {{ using dielectric::dielectric; bool scatter(const ray& in, "
            f"const hit_record& rec, color& part, ray& out) const override {{ {code} }} }};",
            ball_of(f"make_shared<{name}>(1.5)"))


def sky(colour):
    return {"return background;": f"return {colour};"}, "", ball_of()


@pytest.mark.parametrize("reason, own", {
    "star: its hit() is not that of a quad": ({}, INTERIOR.format(
        "star", "return a * a * b * b < 0.1 && std::fabs(a) < 1 && std::fabs(b) < 1;"), QUAD.format("star")),
    "plane: no such shape": ({}, "struct plane : hittable { shared_ptr<material> m; plane(shared_ptr<material> a) : "
        "m(a) {} bool hit(const ray& r, interval range, hit_record& rec) const override { double t = "
        "(-1 - r.origin()[1]) / r.direction()[1]; if (!(t > range.minimum && t < range.maximum)) return false; "
        "rec.t = t, rec.p = r.at(t), rec.mat = m; rec.face(r, vec3(0, 1, 0)); return true; } };",
        "make_shared<plane>(grey)"),
    "constant_medium: Tyndall": ({}, SECOND_BOOK,
        f"make_shared<constant_medium>({QUAD.format('quad')}, 1.0, color(1, 1, 1))"),
    "half: no such material": made_of("half", "vec3 d = unit(in_ball()); part = color(0.5, 0.5, 0.5); "
        "out = ray(rec.p, dot(d, rec.normal) > 0 ? d : -1 * d, in.time()); return true;"),
    "takes light away": made_of("tinted",
        "bool does = dielectric::scatter(in, rec, part, out); part = color(0.5, 1, 1); return does;"),
    "it reflects": made_of("mirror", "bool does = dielectric::scatter(in, rec, part, out); "
        "if (random_double() < 0.1) out = ray(rec.p, reflect(unit(in.direction()), rec.normal)); return does;"),
    "neither one colour nor a gradient":
        sky("dot(unit(r.direction()), unit(vec3(1, 1, 0.5))) > 0.998 ? color(50, 45, 40) : color(1, 1, 1)"),
    "get_ray(): its rays": ({r"defocus_angle = 0": "defocus_angle = 5", r"while \(p.sq.*0\);": ""}, "", ball_of()),
    "takes hits at t = 0": ({r"interval\(0\.001,": "interval(0,"}, "", ball_of()),
    "no material": ({}, "", ball_of("nullptr")),
    "of one hit it makes": ({r"\+ part \*": "+ 0.5 * part *"}, "", ball_of()),
}.items())
def test_not_taken(reason, own):
    """What a program does otherwise than the books', however alike it looks, is never a scene: the reason is told."""
    changes, code, shape = own
    program("own.cc", code + world(shape), changes)
    run("convert own.cc -o refused.json", 2, reason, lines=2)


def test_own_samples_alone():
    """Refused where a scene is needed, or samples that are a function of seed and index. Other ways to write are told."""
    program("holes.cc", "struct with_holes : sphere { using sphere::sphere; "
            "bool hit(const ray& r, interval range, hit_record& rec) const override { "
            "return sphere::hit(r, range, rec) && std::fabs(std::sin(9 * rec.p[1])) > 0.3; } };"
            + world(ball_of().replace("sphere", "with_holes"), render="c.render(w); c.render(w);"),
            {r"std::sqrt\(s": "0.5 * (s", "const double across": "std::srand(x + 9 * y); const double across"})
    run("render holes.cc --spp 8 -q -o holes.png", 0, "more pictures", "as (32, 81, 255)", "hit() is", "is not known", lines=4)
    for command in ("inspect holes.cc", "convert holes.cc -o x.json", "render holes.cc --set /camera/vfov=3 -o x.png",
                    "render holes.cc --samples 0:2 -o x.png", "chart holes.cc -o x.svg", "compare holes.png holes.cc",
                    "sweep holes.cc --vary /camera/vfov=20:30:2 -o x.png"):
        run(command, 2, "holes.cc", lines=4)


@pytest.mark.parametrize("begin, words", [
    ("volatile int* volatile p = nullptr; *p = 1;", ["was ended by SIGSEGV", "before the colour of its first ray"]),
    ("throw 1;", ["was ended by SIGABRT", "an instance of 'int'"]),
    (r'std::cerr << "reading\nno model.obj\n"; exit(4);',
     ["ended with exit code 4 before the colour of its first ray", 'its last words: "no model.obj"']),
    ("for (int k = 0; k < 4096; ++k) if (!malloc(std::size_t(1) << 30)) exit(4); exit(5);", ["ended with exit code 4"]),
    ("return 0;", ["ended with exit code 0 before the colour of its first ray"]),
    ("int n = 1; std::cin >> n;", ["main() reads standard input"]),
    *[('int n = 1; if (scanf("%d", &n) > 0) n = 2;', ["main() reads standard input"])]
    * os.path.exists("/proc/self/syscall")])
def test_failing_programs(begin, words):
    """What ends before its first ray is told in one line."""
    program("main.cc", world(ball_of(), begin))
    run("convert main.cc -o failed.json", 2, "main.cc", *words)


def script(name, text):
    write(name, f"#!/bin/sh\n{text}\n")
    os.chmod(name, 0o755)
    return os.path.abspath(name)


def test_compilers_and_temporary_folders():
    """Those that fail are told in one line."""
    program("good.cc", world(ball_of()))
    for does, words in [
            ("kill -9 $$", ["compiler was ended by SIGKILL", "while it compiled good.cc"]),
            ('echo "c++: fatal error: Killed signal terminated program cc1plus" >&2; exit 1', ["was ended by SIGKILL"]),
            ('echo "cc1plus: error: No space left on device" >&2; exit 1', ["No space left on device"])]:
        run("inspect good.cc", 3, *words, CXX=script("compiler", does))
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
    """A signal ends a compiler, or a program, and what these have started."""
    program("main.cc", 'int main() { if (fork() == 0) { fork(); sleep(1000); } std::ofstream("mark") << 1; sleep(1000); }')
    variables = {"CXX": script("compiler", "echo 1 >mark; sleep 1000 & sleep 1000")} if doing == "compiled" else {}
    number = signal.Signals[f"SIG{name}"]
    with running(f"{command} main.cc", env=os.environ | variables) as process:
        wait_until(has_begun)
        process.send_signal(number)
        assert process.wait(600) == 128 + number
    assert read("said").decode() == f"tyndall: main.cc: interrupted while it {'was ' * (doing != 'ran')}{doing}\n"
    assert not read("printed")


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
    lacking = [sys.executable, BOOK / "lacking.py"]

    def content():
        return {name: read(name) for name in ["above.ppm"] + [f"kept/{name}" for name in sorted(os.listdir("kept"))]}
    before = content()
    for calls in "", "unshare", "landlock":
        if has_guard([*lacking, calls]):
            run("inspect kept/main.cc", by=[*lacking, calls])
            time.sleep(0.4)
            assert content() == before, f"on a kernel without '{calls}'"
    for command in ("render kept/main.cc --spp 1 -q -o picture.png", "convert kept/main.cc -o kept.json",
                    "chart kept/main.cc --budget 1 -o chart.svg",
                    "render kept/main.cc --spp 64 -q --gamma2 -o mine.ppm", "compare mine.ppm kept/main.cc"):
        run(command, loud=True)
    for command in "convert", "render":  # a source file is never replaced
        run(f"{command} kept/main.cc -o kept/main.cc", 2)
    none = [*lacking, "unshare landlock"]
    assert not has_guard(none)
    run("inspect kept/main.cc", 2, "kept/main.cc: is not run", "namespaces", "Landlock", "--trust", by=none,
        TYNDALL_TRUST="1")
    assert content() == before
    run("inspect kept/main.cc --trust", by=none)
    assert not os.path.exists("kept/removed.ppm"), "the program does not run as it is"
