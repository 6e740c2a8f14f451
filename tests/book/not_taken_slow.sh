#!/usr/bin/env bash
# Programs that do something else than the books' are never a scene, however alike they look: the reason is told.
. "$(dirname "$0")/_program.sh"
world() { # SHAPE: a program of one
  echo "int main() { hittable_list w; auto grey = make_shared<lambertian>(color(0.5, 0.5, 0.5)); w.add($1); $render c.render(w); }"
}
ball_of='make_shared<sphere>(point3(0, 0, -1), 0.5, '

# Shapes.
not_taken holes 'sphere_with_holes: its hit() is not that' <<<"struct sphere_with_holes : sphere { using sphere::sphere;
  bool hit(const ray& r, interval range, hit_record& rec) const override { return sphere::hit(r, range, rec) && std::fabs(std::sin(9 * rec.p[1])) > 0.3; } };
  $(world 'make_shared<sphere_with_holes>(point3(0, 0, -1), 0.5, grey)')"
not_taken star 'star: its hit() is not that of a quad' <<<"struct star : quad { using quad::quad;
  bool is_interior(double a, double b, hit_record&) const override { return a * a * b * b < 0.1 && std::fabs(a) < 1 && std::fabs(b) < 1; } };
  $(world 'make_shared<star>(point3(0, 0, -1), vec3(1, 0, 0), vec3(0, 1, 0), grey)')"
not_taken plane 'plane: no such shape' <<<"struct plane : hittable { shared_ptr<material> m; plane(shared_ptr<material> a) : m(a) {}
  bool hit(const ray& r, interval range, hit_record& rec) const override { double t = (-1 - r.origin()[1]) / r.direction()[1];
    if (!(t > range.min && t < range.max)) return false; rec.met(r, t, vec3(0, 1, 0), m); return true; } };
  $(world 'make_shared<plane>(grey)')"
not_taken fog 'constant_medium: Tyndall' <<<"$(world 'make_shared<constant_medium>(make_shared<quad>(point3(0, 0, -1), vec3(1, 0, 0), vec3(0, 1, 0), grey), 1.0, color(1, 1, 1))')"

# Materials.
scatters() { # NAME CODE: a material with such a scatter()
  echo "struct $1 : material { bool scatter(const ray& in, const hit_record& rec, color& part, ray& out) const override { $2 } };
  $(world "${ball_of} make_shared<$1>())")"
}
not_taken half 'half: no such material' <<<"$(scatters half 'vec3 d = unit_vector(random_in_ball()); part = color(0.5, 0.5, 0.5); out = ray(rec.p, dot(d, rec.normal) > 0 ? d : -1 * d); return true;')"
not_taken tinted 'takes light away' <<<"struct tinted : dielectric { using dielectric::dielectric; bool scatter(const ray& in, const hit_record& rec, color& part, ray& out) const override {
  bool does = dielectric::scatter(in, rec, part, out); part = color(0.5, 1, 1); return does; } }; $(world "${ball_of} make_shared<tinted>(1.5))")"
not_taken mirror 'it reflects' <<<"struct mirror : dielectric { using dielectric::dielectric; bool scatter(const ray& in, const hit_record& rec, color& part, ray& out) const override {
  if (random_double() < 0.1) { part = color(1, 1, 1); out = ray(rec.p, reflect(unit_vector(in.direction()), rec.normal)); return true; } return dielectric::scatter(in, rec, part, out); } };
  $(world "${ball_of} make_shared<mirror>(1.5))")"

# Skies, and ray_color().
with_macros() { # NAME MACRO: a program with it
  echo "#define $2" >"$1.macros"
  program "$1" <<<"$(world "${ball_of} grey)")"
}
sky() { # NAME EXPRESSION TEXT...
  local name=$1
  with_macros "$name" "SKY $2"
  shift 2
  not_taken "$name" "$@" <<<"$(world "${ball_of} grey)")"
}
sky sun '(dot(unit_vector(r.direction()), unit_vector(vec3(1, 1, 0.5))) > 0.998 ? color(50, 45, 40) : color(1, 1, 1))' 'neither one colour nor a gradient'
sky stripes 'color(r.direction()[0] > 0, 0, 0)' 'neither one colour'
with_macros acne 'LOWEST 0'
not_taken acne 'takes hits at t = 0' <<<"$(world "${ball_of} grey)")"
program early <<<"$(world "${ball_of} nullptr)")"
expect 2 "$tyndall" convert early.cc -o refused.json
grep -q 'no material' err || fail "early: $(cat err)"

# Light that is added up in another way.
mkdir darker
program darker/main <<<"$(world "${ball_of} grey)")"
sed -i 's/shine + part \* ray_color/shine + 0.5 * part * ray_color/' darker/books.h
expect 2 "$tyndall" convert darker/main.cc -o refused.json
grep -q 'of one hit it makes' err || fail "darker: $(cat err)"

# What has only samples of its own is refused where a scene is needed.
"$tyndall" render holes.cc --spp 1 -q -o holes.png 2>err || fail "render: $(cat err)"
# They are no function of seed and index, either.
for command in 'inspect holes.cc' 'render holes.cc --set /camera/vfov=3 -o x.png' 'render holes.cc --samples 0:2 -o x.png' \
  'chart holes.cc -o x.svg' 'compare holes.png holes.cc' 'sweep holes.cc --vary /camera/vfov=20:30:2 -o x.png'; do
  # shellcheck disable=SC2086
  expect 2 "$tyndall" $command
  grep -q 'holes.cc' err || fail "$command: $(cat err)"
done
[ ! -e x.png ] && [ ! -e x.svg ] || fail 'something was written'

finish
