#!/usr/bin/env bash
# Loops over pixels in main(): each answer of the program is looked at, and a doubtful one is refused.
. "$(dirname "$0")/_program.sh"

loop='hittable_list w = ball(); camera c(point3(0, 0, 0), point3(0, 0, -1), vec3(0, 1, 0), 90, 1); std::cout << "P3\n8 8\n255\n";'
traced='color ray_color(const ray& r, const hittable& w, int left) {
  hit_record h; if (left <= 0) return color(0, 0, 0); if (!w.hit(r, 0.001, infinity, h)) return SKY;
  ray next; color part; if (!h.mat_ptr->scatter(r, h, part, next)) return color(0, 0, 0); return PART * ray_color(next, w, left - 1); }'

refused normals 'asks no material to scatter' <<<"$ball color ray_color(const ray& r, const hittable& w) { hit_record h; return w.hit(r, 0.001, infinity, h) ? 0.5 * (h.normal + color(1, 1, 1)) : color(1, 1, 1); }
  int main() { $loop for (int i = 0; i < 64; ++i) write_color(std::cout, ray_color(c.get_ray(0, 0), w)); }"
refused own_rays "without the books' camera" <<<"$ball color ray_color(const ray& r, const hittable& w) { hit_record h; return w.hit(r, 0.001, infinity, h) ? color(0, 0, 0) : color(1, 1, 1); }
  int main() { $loop for (int i = 0; i < 64; ++i) write_color(std::cout, ray_color(ray(point3(0, 0, 0), vec3(0, 0, -1)), w)); }"
refused no_rays 'writes pixels for which it asks no world' <<<'int main() { std::cout << "P3\n8 8\n255\n"; for (int i = 0; i < 64; ++i) write_color(std::cout, color(0.5, 0.5, i / 64.0)); }'
write='for (int i = 0; i < 64; ++i) { color sum; for (int s = 0; s < SAMPLES; ++s) sum += ray_color(c.get_ray(0, 0), w, 5); write_color(std::cout, sum, SAMPLES); }'
from_loop() { # SKY PART SAMPLES: a program with such a loop
  echo "$ball $traced int main() { $loop $write }" | sed "s|SKY|$1|; s|PART|$2|; s|SAMPLES|$3|g"
}
refused stripes 'the sky of ray_color() in main() is neither one colour nor a gradient' < <(from_loop 'color(r.direction().x() > 0, 0, 0)' part 2)
refused no_colour 'does something else with light' < <(from_loop 'color(1, 1, 1)' 0.5 2)
refused uneven 'more samples in some pixels than in others' < <(from_loop 'color(1, 1, 1)' part '(i + 1)')
refused thread 'in threads of its own' < <({ echo '#include <thread>' && from_loop 'color(1, 1, 1)' part 2; } | sed 's|for (int i|std::thread t([\&] { for (int i|; s|, 2); } }|, 2); } }); t.join(); }|')
program taken < <(from_loop 'color(1, 1, 1)' part 2)
expect 0 "$tyndall" convert taken.cc -o - # the same without what is refused above
refused no_size 'writes no header of a picture' < <(from_loop 'color(1, 1, 1)' part 2 | sed 's|P3|P9|')
refused buffer 'ends no pixel by write_color() or on std::cout' < <(from_loop 'color(1, 1, 1)' part 2 | sed 's|i < 64|i < 50000000|; s|write_color(std::cout, sum, 2)|w.objects.reserve(i)|')
refused by_stb 'writes its picture by stbi_write_png()' < <(from_loop 'color(1, 1, 1)' part 2 | sed 's|write_color(std::cout, sum, 2); }|} stbi_write_png("x.png", 8, 8, 3, \&w, 24);|')

finish
