#!/usr/bin/env bash
# More of what cannot be taken over from a program and ends in one sentence that names it: see refused.sh.
. "$(dirname "$0")/_program.sh"

show='camera c; c.image_width = 8; c.render(w);'
refused derived_shape 'bumpy: Tyndall has no such shape' <<<"struct bumpy : sphere { using sphere::sphere; bool hit(const ray&, interval, hit_record&) const override { return true; } };
  int main() { hittable_list w; w.add(make_shared<bumpy>(point3(0, 0, -1), 0.5, make_shared<metal>(color(1, 1, 1), 0.0))); $show }"
refused boundary 'constant_medium in a quad' <<<"#include \"constant_medium.h\"
  int main() { hittable_list w; w.add(make_shared<constant_medium>(make_shared<quad>(point3(0, 0, 0), vec3(1, 0, 0), vec3(0, 1, 0), nullptr), 1, color(1, 1, 1))); $show }"
refused early 'sphere without a material: this chapter shows normals' <<<"int main() { hittable_list w; w.add(make_shared<sphere>(point3(0, 0, -1), 0.5)); $show }"
refused depth 'max_depth of the camera is 0' <<<"$ball int main() { hittable_list w = ball(); camera c; c.max_depth = 0; c.render(w); }"

# A class in a header that ours take the place of.
mkdir replaced
echo 'class frosted : public material {};' >replaced/material.h
refused replaced/main 'frosted: Tyndall has no such material' <<<"int main() { hittable_list w; w.add(make_shared<sphere>(point3(0, 0, -1), 0.5, make_shared<frosted>())); $show }"

refused arguments 'arguments.cc:8:' "'sphere" <<<'int main() { hittable_list w; w.add(make_shared<sphere>(1, 2, 3, 4, 5)); }'

finish
