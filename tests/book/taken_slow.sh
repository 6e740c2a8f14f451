#!/usr/bin/env bash
# What readers' programs have of their own is simply theirs: generators, files, names, helpers, shapes of the books.
. "$(dirname "$0")/_program.sh"

# Random numbers: those of the program itself.
echo '#define OWN_GENERATOR static unsigned s = 2463534242u; s ^= s << 13; s ^= s >> 17; s ^= s << 5; return s / 4294967296.0' >random.macros
program random <<<"int main() { double r = random_double(); std::cerr << int(r * 1e5) / 1e5; hittable_list w; w.add(make_shared<sphere>(point3(r, 0, -1), 0.5, make_shared<lambertian>(color(1, 1, 1)))); $render c.render(w); }"
expect 0 "$tyndall" convert random.cc -o random.json
${CXX:-c++} -std=c++17 random.cc -o random && drawn=$(./random 2>&1 >/dev/null)
grep -qF "\"center\": [$drawn" random.json || fail "own generator: $drawn, but $(grep center random.json)"

# A file above its folder; one that is not there is told.
mkdir -p deep/src deep/data
echo '-1 0 -3 0.5 1 0 -3 0.5' >deep/data/balls.txt
program deep/src/main <<<"int main() { hittable_list w; std::ifstream in(\"../data/balls.txt\"); std::ofstream out(\"log.txt\"); out << 1;
  for (double x, y, z, r; in >> x >> y >> z >> r;) w.add(make_shared<sphere>(point3(x, y, z), r, make_shared<lambertian>(color(1, 1, 1))));
  if (!out.flush()) return 1; $render c.render(w); }"
expect 0 "$tyndall" convert deep/src/main.cc -o deep.json
same 'balls' "$(grep -c sphere deep.json)" 2
[ ! -e deep/src/log.txt ] || fail 'it writes beside its source'
mv deep/data/balls.txt deep/data/other.txt
expect 0 "$tyndall" convert deep/src/main.cc -o deep.json
grep -q 'cannot open "../data/balls.txt"' err || fail "a file that is missing: $(cat err)"

# Shapes that the book proposes, by a class of the program's; names and constructors of its own; several threads.
program shapes <<<"#include <thread>
namespace mine {
struct triangle : quad { using quad::quad; bool is_interior(double a, double b, hit_record&) const override { return a > 0 && b > 0 && a + b < 1; } };
struct washer : quad { using quad::quad; bool is_interior(double a, double b, hit_record&) const override { double r = std::sqrt(a * a + b * b); return r > 0.25 && r < 0.5; } };
template <class T> shared_ptr<hittable> put(T shape) { return make_shared<T>(shape); }
}
int main() { hittable_list w; auto grey = make_shared<lambertian>(color(0.5, 0.5, 0.5));
  w.add(mine::put(mine::triangle(point3(0, 0, -1), vec3(1, 0, 0), vec3(0, 1, 0), grey)));
  w.add(mine::put(mine::washer(point3(0, 0, -2), vec3(2, 0, 0), vec3(0, 2, 0), grey)));
  $render std::thread one([&] { camera d = c; d.render(w); }), two([&] { camera d = c; d.render(w); }); one.join(); two.join(); }"
expect 0 "$tyndall" convert shapes.cc -o shapes.json
same 'shapes' "$(grep -oE '"type": "(triangle|disk)"|"inner": [0-9.]+' shapes.json | tr '\n' ' ')" '"type": "triangle" "type": "disk" "inner": 0.5 '

# Members by any names.
mkdir named
program named/main <<<"int main() { hittable_list w; w.add(make_shared<sphere>(point3(0, 0, -1), 0.5, make_shared<metal>(color(0.5, 0.25, 0.5), 0.25))); $render c.render(w); }"
expect 0 "$tyndall" convert named/main.cc -o named.json
sed -i 's/\bradius\b/reach/g; s/\bcenter\b/mid/g; s/\bfuzz\b/rough/g; s/\balbedo\b/tint/g; s/range\.min/range.lower/g; s/range\.max/range.upper/g
  s/double min, max;/double lower, upper;/; s/: min(low), max(high)/: lower(low), upper(high)/' named/books.h
expect 0 "$tyndall" convert named/main.cc -o again.json
same 'members of other names' "$(cat again.json)" "$(cat named.json)"

# The same with another compiler and as C++20.
for compiler in g++ clang++; do
  command -v "$compiler" >/dev/null || continue
  CXX="$compiler -std=c++20" expect 0 "$tyndall" convert shapes.cc -o again.json
  same "shapes by $compiler" "$(cat again.json)" "$(cat shapes.json)"
done

finish
