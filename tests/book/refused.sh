#!/usr/bin/env bash
# What cannot be taken over from a program ends in one sentence that names it.
. "$(dirname "$0")/_program.sh"

show='camera c; c.image_width = 8; c.render(w);'
refused own_shape 'triangle: Tyndall has no such shape' <<<"struct triangle : hittable { bool hit(const ray&, interval, hit_record&) const override { return false; } };
  int main() { hittable_list w; w.add(make_shared<triangle>()); $show }"
refused own_material 'frosted: Tyndall has no such material' <<<"struct frosted : material { bool scatter(const ray&, const hit_record&, color&, ray&) const override { return false; } };
  int main() { hittable_list w; w.add(make_shared<sphere>(point3(0, 0, -1), 0.5, make_shared<frosted>())); $show }"
refused image 'image_texture: nowhere.jpg is neither in the folder of the program nor in images/' <<<"
  int main() { hittable_list w; w.add(make_shared<sphere>(point3(0, 0, -1), 0.5, make_shared<lambertian>(make_shared<image_texture>(\"nowhere.jpg\")))); $show }"
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
finish
