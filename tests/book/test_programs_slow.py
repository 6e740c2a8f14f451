"""What readers' programs may have of their own, and what is not taken for a scene."""

import math
import os
import shutil
import subprocess

import pytest
from program import load, pixels_of, read, run, write
from readers import BOOK, EXAMPLE, ball_of, headers, program, world


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
    errors = [int(plain[3 * (40 * y + x)]) - 256 * math.sqrt(picture[y][x][0])
              for y in range(7, 16) for x in range(1, 8)]
    assert abs(sum(errors)) <= 4 * len(errors)


def test_generator():
    """Random numbers are those of the program itself."""
    program("random.cc", world("make_shared<sphere>(point3(random_double(), 0, -1), 0.5, grey)"), {
        r"return std::rand\(\).*?;": "static unsigned s = 1; return (s = 1664525 * s + 1013904223) / 4294967296.0;"})
    run("convert random.cc -o random.json")
    assert load("random.json")["objects"][0]["center"][0] == pytest.approx((1664525 + 1013904223) / 2**32, 1e-9)


def test_files():
    """A file above the program's folder is found; one that is not there is told."""
    write("deep/data/balls.txt", "-1 0 -3 0.5 1 0 -3 0.5")
    program("deep/src/main.cc", world(ball_of(), render="""w = hittable_list();
        std::ifstream in("../data/balls.txt"); std::ofstream out("log.txt"); out << 1; if (!out.flush()) return 1;
        for (double x, y, z, r; in >> x >> y >> z >> r;) w.add(make_shared<sphere>(point3(x, y, z), r, grey));
        c.render(w);"""))
    run("convert deep/src/main.cc -o deep.json")
    assert len(load("deep.json")["objects"]) == 2 and not os.path.exists("deep/src/log.txt")
    os.rename("deep/data/balls.txt", "deep/data/other.txt")
    run("convert deep/src/main.cc -o deep.json", 0, 'cannot open "../data/balls.txt"')


QUAD = "make_shared<{}>(point3(0, 0, -1), vec3(1, 0, 0), vec3(0, 1, 0), grey)"
INTERIOR = "struct {} : quad {{ using quad::quad; bool is_interior(double a, double b) const override {{ {} }} }};"


def test_shapes():
    """Shapes that the book proposes, by classes of the program's; helpers of its own; threads; other compilers."""
    threads = ("std::thread one([&] { camera d = c; d.render(w); }), two([&] { camera d = c; d.render(w); }); "
               "one.join(); two.join();")
    triangle = INTERIOR.format("triangle", "return a > 0 && b > 0 && a + b < 1;")
    washer = INTERIOR.format("washer", "double r = std::sqrt(a * a + b * b); return r > 0.25 && r < 0.5;")
    put = "template <class T> shared_ptr<hittable> put(T shape) { return make_shared<T>(shape); }"
    shapes = ("mine::put(mine::triangle(point3(0, 0, -1), vec3(1, 0, 0), vec3(0, 1, 0), grey))); "
              "w.add(mine::put(mine::washer(point3(0, 0, -2), vec3(2, 0, 0), vec3(0, 2, 0), grey))")
    helpers = f"#include <thread>\nnamespace mine {{ {triangle} {washer} {put} }}\n"
    program("shapes.cc", helpers + world(shapes, render=threads))
    run("convert shapes.cc -o shapes.json")
    first, second = load("shapes.json")["objects"]
    assert first["type"] == "triangle" and second["type"] == "disk" and second["inner"] == 0.5
    for compiler in filter(shutil.which, ("g++", "clang++")):
        run("convert shapes.cc -o again.json", CXX=f"{compiler} -std=c++20")
        assert read("again.json") == read("shapes.json")


def test_several_files():
    """Several source files, a header in a folder that -I names, and options that do not fit a program's scene."""
    headers("several/include")
    write("several/include/sky_colour.h", '#include "rtweekend.h"\ninline const color sky(0.125, 0.25, 0.5);')
    write("several/world.h", '#include "rtweekend.h"\nhittable_list balls();')
    write("several/world.cc", '#include "world.h"\n\n\nhittable_list balls() { return hittable_list('
          f'{ball_of("make_shared<lambertian>(color(0.5, 0.5, 0.5))")}); }}')
    write("several/main.cc", '#include "rtweekend.h"\n#include "sky_colour.h"\n#include "world.h"\n'
          "int main() { camera c; c.image_width = 16; c.background = sky; c.render(balls()); }")
    run("convert several/main.cc several/world.cc -I several/include -o several.json")
    assert load("several.json")["background"] == [0.125, 0.25, 0.5]
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
    "plane: no such shape": ({}, "struct plane : hittable { shared_ptr<material> m; "
        "plane(shared_ptr<material> a) : m(a) {} bool hit(const ray& r, interval range, hit_record& rec) const override { "
        "double t = (-1 - r.origin()[1]) / r.direction()[1]; if (!(t > range.lower && t < range.upper)) return false; "
        "rec.t = t, rec.p = r.at(t), rec.mat = m; rec.face(r, vec3(0, 1, 0)); return true; } };",
        "make_shared<plane>(grey)"),
    "constant_medium: Tyndall": ({}, (BOOK / "newest.cc").read_text().split("int main")[0],
        f"make_shared<constant_medium>({QUAD.format('quad')}, 1.0, color(1, 1, 1))"),
    "half: no such material": made_of("half", "vec3 d = unit(in_ball()); part = color(0.5, 0.5, 0.5); "
        "out = ray(rec.p, dot(d, rec.normal) > 0 ? d : -1 * d, in.time()); return true;"),
    "takes light away": made_of("tinted",
        "bool does = dielectric::scatter(in, rec, part, out); part = color(0.5, 1, 1); return does;"),
    "it reflects": made_of("mirror", "bool does = dielectric::scatter(in, rec, part, out); "
        "if (random_double() < 0.1) out = ray(rec.p, reflect(unit(in.direction()), rec.normal)); return does;"),
    "neither one colour nor a gradient":
        sky("dot(unit(r.direction()), unit(vec3(1, 1, 0.5))) > 0.998 ? color(50, 45, 40) : color(1, 1, 1)"),
    "neither one colour": sky("color(r.direction()[0] > 0, 0, 0)"),
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
    """Refused where a scene is needed, or samples that are a function of seed and index."""
    program("holes.cc", "struct with_holes : sphere { using sphere::sphere; "
            "bool hit(const ray& r, interval range, hit_record& rec) const override { "
            "return sphere::hit(r, range, rec) && std::fabs(std::sin(9 * rec.p[1])) > 0.3; } };"
            + world("make_shared<with_holes>(point3(0, 0, -1), 0.5, grey)"))
    run("render holes.cc --spp 1 -q -o holes.png", 0, "holes.cc", "with_holes: its hit() is not that")
    for command in ("inspect holes.cc", "convert holes.cc -o x.json", "render holes.cc --set /camera/vfov=3 -o x.png",
                    "render holes.cc --samples 0:2 -o x.png", "chart holes.cc -o x.svg", "compare holes.png holes.cc",
                    "sweep holes.cc --vary /camera/vfov=20:30:2 -o x.png"):
        run(command, 2, "holes.cc", lines=2)
