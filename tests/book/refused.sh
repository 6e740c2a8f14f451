#!/usr/bin/env bash
# What cannot be taken over from a program ends in one sentence that names it.
. "$(dirname "$0")/_program.sh"

show='camera c; c.image_width = 8; c.render(w);'
refused own_shape 'triangle: Tyndall has no such shape' <<<"struct triangle : hittable { bool hit(const ray&, interval, hit_record&) const override { return false; } };
  int main() { hittable_list w; w.add(make_shared<triangle>()); $show }"
refused own_material 'frosted: Tyndall has no such material' <<<"struct frosted : material { bool scatter(const ray&, const hit_record&, color&, ray&) const override { return false; } };
  int main() { hittable_list w; w.add(make_shared<sphere>(point3(0, 0, -1), 0.5, make_shared<frosted>())); $show }"
refused derived_shape 'bumpy: Tyndall has no such shape' <<<"struct bumpy : sphere { using sphere::sphere; bool hit(const ray&, interval, hit_record&) const override { return true; } };
  int main() { hittable_list w; w.add(make_shared<bumpy>(point3(0, 0, -1), 0.5, make_shared<metal>(color(1, 1, 1), 0.0))); $show }"
refused boundary 'constant_medium in a quad' <<<"#include \"constant_medium.h\"
  int main() { hittable_list w; w.add(make_shared<constant_medium>(make_shared<quad>(point3(0, 0, 0), vec3(1, 0, 0), vec3(0, 1, 0), nullptr), 1, color(1, 1, 1))); $show }"
refused image 'image_texture: nowhere.jpg is neither in the folder of the program nor in images/' <<<"
  int main() { hittable_list w; w.add(make_shared<sphere>(point3(0, 0, -1), 0.5, make_shared<lambertian>(make_shared<image_texture>(\"nowhere.jpg\")))); $show }"
refused early 'sphere without a material: this chapter shows normals' <<<"int main() { hittable_list w; w.add(make_shared<sphere>(point3(0, 0, -1), 0.5)); $show }"
refused depth 'max_depth of the camera is 0' <<<"$ball int main() { hittable_list w = ball(); camera c; c.max_depth = 0; c.render(w); }"

# A class in a header that ours take the place of.
mkdir replaced
echo 'class frosted : public material {};' >replaced/material.h
refused replaced/main 'frosted: Tyndall has no such material' <<<"int main() { hittable_list w; w.add(make_shared<sphere>(point3(0, 0, -1), 0.5, make_shared<frosted>())); $show }"

# What is no program of the books', or none at all.
echo 'int main() {}' >plain.cc
expect 2 "$tyndall" inspect plain.cc
complains "plain.cc: includes none of the books' headers"
expect 2 "$tyndall" inspect missing.cc
complains 'missing.cc: found no such file'

# Errors of the compiler: the reader's file and line, the first one, nothing that a terminal would obey.
printf '#include "rtweekend.h"\nint main() {\n  camera cam;\n  cam.\033[31mbogus = 1;\n}\nint f() { return undeclared; }\n' >escape.cc
expect 2 "$tyndall" inspect escape.cc
complains 'escape.cc:4:7: '
grep -q "$(printf '\033')" err && fail 'a control character goes to the terminal'
refused arguments 'arguments.cc:8:' "'sphere" <<<'int main() { hittable_list w; w.add(make_shared<sphere>(1, 2, 3, 4, 5)); }'

finish
