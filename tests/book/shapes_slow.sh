#!/usr/bin/env bash
# The shapes that the books name as additions to the quad, and readers' own classes of the same names.
. "$(dirname "$0")/_program.sh"

shapes_of() {
  python3 -c '
import json, re, sys
for o in json.loads(re.sub(r"^\s*//.*$", "", open(sys.argv[1]).read(), flags=re.M))["objects"]:
    print(o["type"], o.get("corner", o.get("center")), o["u"], o["v"], o.get("inner", 0))' "$1" | sed 's/\.0\b//g'
}

cat >flat.cc <<'P'
#include "rtweekend.h"
#include "camera.h"
#include "hittable_list.h"
#include "material.h"
#include "quad.h"
int main() {
  hittable_list w;
  auto grey = make_shared<lambertian>(color(0.5, 0.5, 0.5));
  w.add(make_shared<tri>(point3(0, 0, 0), vec3(1, 0, 0), vec3(0, 1, 0), grey));
  w.add(make_shared<ellipse>(point3(0, 0, -1), vec3(2, 0, 0), vec3(0, 1, 0), grey));
  w.add(make_shared<triangle>(point3(0, 0, -3), vec3(1, 0, 0), vec3(0, 1, 0), grey));
  w.add(make_shared<disk>(point3(0, 0, -4), vec3(1, 0, 0), vec3(0, 1, 0), grey));
  w.add(make_shared<annulus>(point3(0, 0, -2), vec3(2, 0, 0), vec3(0, 2, 0), 0.25, make_shared<diffuse_light>(color(1, 1, 1))));
  camera c;
  c.image_width = 8;
  c.render(w);
}
P
expect 0 "$tyndall" convert flat.cc -o flat.json
same 'shapes' "$(shapes_of flat.json)" \
  'triangle [0, 0, 0] [1, 0, 0] [0, 1, 0] 0
disk [0, 0, -1] [2, 0, 0] [0, 1, 0] 0
triangle [0, 0, -3] [1, 0, 0] [0, 1, 0] 0
disk [0, 0, -4] [1, 0, 0] [0, 1, 0] 0
disk [0, 0, -2] [2, 0, 0] [0, 2, 0] 0.25'

# Readers derive the same shapes from the quad, as the book proposes.
cat >own.cc <<'P'
#include "rtweekend.h"
#include "camera.h"
#include "hittable_list.h"
#include "material.h"
#include "quad.h"
class triangle : public quad {
  public:
    triangle(const point3& o, const vec3& u, const vec3& v, shared_ptr<material> m) : quad(o, u, v, m) {}
    bool is_interior(double a, double b, hit_record& rec) const override {
      if (!(a > 0 && b > 0 && a + b < 1)) return false;
      rec.u = a;
      rec.v = b;
      return true;
    }
};
class circle : public quad {
  public:
    circle(const point3& c, const vec3& u, const vec3& v, double r, shared_ptr<material> m) : quad(c, u, v, m), r(r) {}
    bool is_interior(double a, double b, hit_record&) const override { return std::sqrt(a * a + b * b) < r; }
    double r;
};
class washer : public circle {
  public:
    using circle::circle;
    bool is_interior(double a, double b, hit_record& rec) const override {
      return circle::is_interior(a, b, rec) && a * a + b * b > 0.25 * r * r;
    }
};
int main() {
  hittable_list w;
  auto grey = make_shared<lambertian>(color(0.5, 0.5, 0.5));
  w.add(make_shared<triangle>(point3(0, 0, 0), vec3(1, 0, 0), vec3(0, 1, 0), grey));
  w.add(make_shared<circle>(point3(0, 0, -1), vec3(1, 0, 0), vec3(0, 1, 0), 0.5, grey));
  w.add(make_shared<washer>(point3(0, 0, -2), vec3(1, 0, 0), vec3(0, 1, 0), 2, grey));
  camera c;
  c.image_width = 8;
  c.render(w);
}
P
expect 0 "$tyndall" convert own.cc -o own.json
same 'own shapes' "$(shapes_of own.json)" \
  'triangle [0, 0, 0] [1, 0, 0] [0, 1, 0] 0
disk [0, 0, -1] [0.5, 0, 0] [0, 0.5, 0] 0
disk [0, 0, -2] [2, 0, 0] [0, 2, 0] 0.5'

show='camera c; c.image_width = 8; c.render(w);'
refused own_star 'star: Tyndall has no such shape' <<<"struct star : quad { using quad::quad;
  bool is_interior(double a, double b, hit_record&) const override { return a * a * b * b < 0.1 && std::fabs(a) < 1 && std::fabs(b) < 1; } };
  int main() { hittable_list w; w.add(make_shared<star>(point3(0, 0, -1), vec3(1, 0, 0), vec3(0, 1, 0), make_shared<lambertian>(color(1, 1, 1)))); $show }"
for own in tri triangle disk; do
  refused "own_$own" "$own: Tyndall has no such shape" <<<"struct $own : hittable { bool hit(const ray&, interval, hit_record&) const override { return false; } };
  int main() { hittable_list w; w.add(make_shared<$own>()); $show }"
done
refused image_on_disk 'a disk with an image_texture' <<<"
  int main() { hittable_list w; w.add(make_shared<ellipse>(point3(0, 0, -1), vec3(1, 0, 0), vec3(0, 1, 0), make_shared<lambertian>(make_shared<image_texture>(\"nowhere.jpg\")))); $show }"

finish
