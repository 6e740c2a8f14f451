"""Programs of readers of the books, by the headers of the example: with what each edition does otherwise."""

import re
import subprocess

from program import PROGRAM, ROOT, write

EXAMPLE = ROOT / "assets/examples/book"
BOOK = ROOT / "tests/book"

RAY = """class ray {
  point3 orig;
  vec3 dir;
  double tm = 0;
 public:
  ray() = default;
  ray(const point3& from, const vec3& to, double time = 0) : orig(from), dir(to), tm(time) {}
  const point3& origin() const { return orig; }
  const vec3& direction() const { return dir; }
  double time() const { return tm; }
  point3 at(double t) const { return orig + t * dir; }
};"""
# Patterns in the example's headers, and what takes their places. All editions: rays that are asked by functions, and
# have a time; a hit owns its material.
ALL = {
    r"\b(r|in|out)\.(origin|direction)\b": r"\1.\2()",
    r"struct ray \{(?s:.*?)\n\};": RAY,
    r"scatter\(const ray&, const hit_record& hit": "scatter(const ray& in, const hit_record& hit",
    r"(out = \{.*)\};": r"\1, in.time()};",
    r"const material\* mat = nullptr": "shared_ptr<material> mat",
    r"mat\.get\(\)": "mat",
}
# The fourth edition: spheres may move, quads ask what lies within them, members are private or have any names.
NEWEST = {
    r"(bool front_face = true;)": r"\1 double u = 0, v = 0;",
    r"point3 center;": "ray center;",
    r"\bcenter(?= -|\)\);)": "center.at(r.time())",
    r"sphere\(const point3& c, (.*) : center\(c\)": r"sphere(const point3& c, \1 : sphere(c, c, r, m) {}\n"
    r"  sphere(const point3& c, const point3& d, \1 : center(c, d - c)",
    r"(struct quad (?s:.*?))(  quad\()": r"\1  virtual bool is_interior(double a, double b) const { "
    r"return 0 <= a && a <= 1 && 0 <= b && b <= 1; }\n\2",
    r"if \(a < 0 .*\) return false;": "if (!is_interior(a, b)) return false;",
    r"\{eye, seen - eye\}": "{eye, seen - eye, random_double()}",
    r"struct (\w+) : (material|hittable) \{\n((?:  (?!std)[^()\n]*;\n)+)": r"class \1 : public \2 {\n\3 public:\n",
    r"double min, max(.*\n.*): min(.*) max": r"double minimum, maximum\1: minimum\2 maximum",
    r"range\.(min|max)": r"range.\1imum",
}
# Editions 1 to 3: two ends of t, and a camera for a loop in main(). The third's lights shine on one side.
EARLIER = {
    r"struct camera \{(?s:.*)": (BOOK / "earlier_camera.h").read_text(),
    r"struct bvh_node(?s:.*?)(?=struct sphere)": "",
    r"interval range": "double t_min, double t_max",
    r"\brange,": "t_min, t_max,",
    r"range\.(min|max)": r"t_\1",
    r"\bmat\b": "mat_ptr",
}
THIRD = {r"emitted\(\)": "emitted(const hit_record& hit)", r"(return )(radiance)": r"\1hit.front_face ? \2 : color()"}
# The first edition: plain pointers, lists of two members, no type of colours, normals that point out. Any names.
FIRST = {
    r"std::vector<.*> (objects;\n)(?s:.*?)(?=  bool hit)": r"  hittable** \1  int size;\n"
    r"  hittable_list(hittable** list, int count) : objects(list), size(count) {}\n",
    r"const auto& object : objects\)\n(.*)object->": r"int k = 0; k < size; ++k)\n\1objects[k]->",
    r"shared_ptr<(\w+)>": r"\1*",
    r"hittable": "hitable",
    r"using color = vec3;": "",
    r"\bcolor\b": "vec3",
    r"  bool front_face = true;\n": "",
    r"front_face = .*\n.*normal = .*": "normal = outward;",
    r"const hit_record& hit(.*\n.*\n)(.*= )hit\.front_face": r"const hit_record& met\1    hit_record hit = met;\n"
    r"    if (dot(in.direction(), met.normal) > 0) hit.normal = -1 * met.normal;\n\2dot(in.direction(), met.normal) < 0",
    **{rf"\b{name}\b": other for name, other in dict(radius="reach", center="mid", fuzz="rough", albedo="tint").items()},
}
EDITIONS = {"first": ALL | EARLIER | FIRST, "third": ALL | EARLIER | THIRD, "newest": ALL | NEWEST}


def has_guard(by=()):
    """Whether the program knows one here, started by a command."""
    return not re.search(rb"^guard +none$", subprocess.run([*by, PROGRAM, "version"], capture_output=True).stdout, re.M)


def headers(folder, edition="newest", changes={}):
    """Puts the headers of an edition there, with further changes; each must find its place."""
    text = (EXAMPLE / "tracer/rtweekend.h").read_text()
    for pattern, other in (EDITIONS[edition] | changes).items():
        text, count = re.subn(pattern, other, text)
        assert count, f"the headers do not hold {pattern}"
    write(f"{folder}/rtweekend.h", text)


def program(name, text, changes={}):
    """A program behind the headers of the newest edition, which lie beside it."""
    headers(name.rpartition("/")[0] or ".", changes=changes)
    write(name, '#include "rtweekend.h"\n#include <fstream>\n#include <unistd.h>\n' + text)


def world(shape, begin="", render="c.render(w);"):
    """A main() that renders a shape, which may be of grey."""
    return (f"int main() {{ {begin} hittable_list w; auto grey = make_shared<lambertian>(color(0.5, 0.5, 0.5)); "
            f"w.add({shape}); camera c; c.image_width = 8; c.samples_per_pixel = 3; c.background = color(1, 1, 1); "
            f"{render} }}")


def ball_of(material="grey"):
    return f"make_shared<sphere>(point3(0, 0, -1), 0.5, {material})"
