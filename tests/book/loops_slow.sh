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
program taken < <(from_loop 'color(1, 1, 1)' part 2)
expect 0 "$tyndall" convert taken.cc -o - # the same without what is refused above
refused no_size 'writes no header of a picture' < <(from_loop 'color(1, 1, 1)' part 2 | sed 's|P3|P9|')
refused no_sums 'ends no pixel by write_color() or on std::cout' < <(from_loop 'color(1, 1, 1)' part 2 | sed 's|i < 64|i < 50000000|; s|sum += |sum = |; s|write_color(std::cout, sum, 2);||')
refused by_stb 'writes its picture by stbi_write_png()' <<<'int main() { stbi_write_png("x.png", 8, 8, 3, "", 24); }'
program told_by_stb < <(from_loop 'color(1, 1, 1)' part 2 | sed 's|P3|P9|; s|write_color(std::cout, sum, 2); }|} stbi_write_png("x.png", 9, 8, 3, \&w, 24);|')
expect 0 "$tyndall" convert told_by_stb.cc -o told_by_stb.json
same 'the size that stb_image_write is told' "$(json told_by_stb.json image)" '{"width": 9, "height": 8}'

# A loop that fills a buffer is known by its sums, in one thread or in several; its size by the rows of its rays, or by what
# main() writes in the end. By a black sky nothing is seen, unless a thing that shines is.
filled() { # WIDTH HEIGHT SKY: a program whose threads fill a buffer of rows, and whose picture begins in the end
  cat <<END
#include <thread>
$ball $traced
int main() {
  hittable_list w = ball(); camera c(point3(0, 0, 0), point3(0, 0, -1), vec3(0, 1, 0), 90, $1.0 / $2);
  std::vector<color> buffer($1 * $2); std::vector<std::thread> threads;
  auto rows = [&](int begin, int step) { for (int j = begin; j < $2; j += step) for (int i = 0; i < $1; ++i) { color sum;
    for (int s = 0; s < 6; ++s) sum += ray_color(c.get_ray((i + random_double()) / ($1 - 1), (j + random_double()) / ($2 - 1)), w, 5);
    buffer[j * $1 + i] = sum; } };
  for (int k = 0; k < 3; ++k) threads.emplace_back(rows, k * STEP, NEXT);
  for (auto& one : threads) one.join();
  OUT << "P3\n" << $1 << ' ' << $2 << "\n255\n";
  for (const color& one : buffer) write_color(OUT, one, 6);
}
END
}
lit='s|return SKY;|return color(0, 0, 0);|; s|if (!h.mat_ptr->scatter(r, h, part, next)) return color(0, 0, 0); return PART|const color own = h.mat_ptr->emitted(); if (!h.mat_ptr->scatter(r, h, part, next)) return own; return own + PART|'
expected() { # NAME SIZE SKY: the scene that is taken
  expect 0 "$tyndall" convert "$1.cc" -o "$1.json"
  same "$1" "$(json "$1.json" image) $(json "$1.json" render)" "$2 {\"max_depth\": 4, \"spp\": 6}"
  grep -qF "sky $3" err || fail "$1: $(cat err)"
}
program blocks < <(filled 90 60 | sed 's|SKY|color(0.5, 0.5, 1)|; s|PART|part|; s|STEP|20|; s|NEXT|1|; s|j < 60; j += step|j < begin + 20; ++j|; s|OUT|std::cout|g')
expected blocks '{"width": 90, "height": 60}' '(0.5, 0.5, 1)'
program striped < <(filled 30 17 | sed 's|SKY|color(0.5, 0.5, 1)|; s|PART|part|; s|STEP|1|; s|NEXT|3|; s|OUT|std::cout|g')
expected striped '{"width": 30, "height": 17}' '(0.5, 0.5, 1)' # its rows are too few to tell the height: the header does
program dark < <(filled 30 17 | sed "$lit; s|PART|part|; s|STEP|1|; s|NEXT|3|; s|  OUT <<|  std::ofstream file(\"x.ppm\"); OUT <<|; s|OUT|file|g")
expected dark '{"width": 30, "height": 17}' '(0, 0, 0)'
refused never 'none does whole pixels' < <(filled 30 17 | sed 's|SKY|color(1, 1, 1)|; s|PART|part|; s|STEP|1|; s|NEXT|3|; s|OUT|std::cout|g; s|= sum;|& static std::atomic<int> done{0}; for (++done; done < 3;) std::this_thread::yield();|')

finish
