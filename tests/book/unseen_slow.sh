#!/usr/bin/env bash
# What no header of ours can see, and the program's own headers tell: random numbers, the sky, one-sided lights.
. "$(dirname "$0")/_program.sh"

# Random numbers: as the program itself would draw them, by the generator that its own headers use.
draw='int main() { hittable_list w; auto c = color::random(); w.add(make_shared<sphere>(point3(0, 0, -1), random_double(1, 2), make_shared<lambertian>(c))); camera cam; cam.render(w); }'
cat >drawn.cc <<'END'
#include <cstdio>
#include <cstdlib>
#include <random>
struct three { double a, b, c; three(double x, double y, double z) : a(x), b(y), c(z) {} };
double draw() {
#ifdef ENGINE
  static std::uniform_real_distribution<double> d(0.0, 1.0);
  static std::mt19937 e(ENGINE);
  return d(e);
#else
  return std::rand() / (RAND_MAX + 1.0);
#endif
}
int main() {
  three t = three(draw(), draw(), draw());
  std::printf("[%.15g, %.15g, %.15g] %.15g", t.a, t.b, t.c, 1 + draw());
}
END
drawn() { # OPTIONS...: what a program of its own draws by this compiler
  ${CXX:-c++} "$@" drawn.cc -o drawn && ./drawn
}
taken() { # what the scene of random/main.cc has
  expect 0 "$tyndall" convert random/main.cc -o random.json
  python3 -c '
import json
s = json.load(open("random.json"))
print("[%.15g, %.15g, %.15g] %.15g" % (*s["materials"]["lambertian 1"]["albedo"], s["objects"][0]["radius"]), end="")'
}
mkdir random
program random/main <<<"$draw"
same 'rand()' "$(taken)" "$(drawn)"
echo 'inline double random_double() { static std::mt19937 g; static std::uniform_real_distribution<double> d(0, 1); return d(g); }' >random/rtweekend.h
same 'mt19937' "$(taken)" "$(drawn -DENGINE=std::mt19937::default_seed)"
echo 'double random_double() { static thread_local std::mt19937 g(42); return g() / 4294967296.0; }' >random/rtweekend.h
same 'mt19937 with a seed' "$(taken)" "$(drawn -DENGINE=42)"
echo '// std::mt19937 would be better
double random_double() { return rand() / (RAND_MAX + 1.0); }' >random/rtweekend.h
same 'mt19937 in a comment' "$(taken)" "$(drawn)"

# The sky of a program that sets none is that of its camera.h.
mkdir sky
program sky/main <<<"$ball int main() { camera cam; cam.render(ball()); }"
expect 0 "$tyndall" convert sky/main.cc -o sky.json
same 'sky of the first book' "$(json sky.json background)" '{"type": "gradient", "bottom": [1, 1, 1], "top": [0.5, 0.7, 1]}'
echo 'class camera { color ray_color() { return (1.0 - a) * color(1.0, 0.5, 0.25) + a*color(0.5f, 0.25, 1); } };' >sky/camera.h
expect 0 "$tyndall" convert sky/main.cc -o sky.json
same 'sky of its own' "$(json sky.json background)" '{"type": "gradient", "bottom": [1, 0.5, 0.25], "top": [0.5, 0.25, 1]}'
echo 'class camera { color background; color ray_color() { return background; } };' >sky/camera.h
expect 0 "$tyndall" convert sky/main.cc -o sky.json
grep -q background sky.json && fail "the second book's sky is black, the default"
echo 'class camera { color ray_color() { return stars(r); } };' >sky/camera.h
expect 0 "$tyndall" convert sky/main.cc -o sky.json
complains 'camera.h draws a sky of its own'

# Lights of the third book shine on one side: behind them there is black.
program lights <<<"int main() { hittable_list w, lights; auto lamp = make_shared<diffuse_light>(color(3, 3, 3));
  w.add(make_shared<quad>(point3(0, 1, 0), vec3(1, 0, 0), vec3(0, 0, 1), lamp)); lights.add(make_shared<quad>(point3(0, 1, 0), vec3(1, 0, 0), vec3(0, 0, 1), nullptr));
  camera cam; cam.background = color(0, 0, 0); cam.LIGHTS; }"
sed 's/LIGHTS/render(w, lights)/' lights.cc >one_sided.cc
sed 's/LIGHTS/render(w)/' lights.cc >two_sided.cc
lit() { # PROGRAM HEIGHT: the light in the middle, seen from there
  "$tyndall" render "$1" --set "/camera/look_from=[0.5,$2,0.5]" --set '/camera/look_at=[0.5,1,0.5]' --set '/camera/vup=[1,0,0]' --set /camera/vfov=1 --size 1x1 --spp 4 -q -o lit.pfm &&
    tail -c 12 lit.pfm | od -An -f | tr -s ' '
}
same 'along the normal, cross(u, v), which points down' "$(lit one_sided.cc 0)" ' 3 3 3'
same 'behind' "$(lit one_sided.cc 2)" ' 0 0 0'
same 'behind, of other books' "$(lit two_sided.cc 2)" ' 3 3 3'

finish
