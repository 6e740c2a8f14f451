#!/usr/bin/env bash
# Files that programs read, and the styles in which they are written.
. "$(dirname "$0")/_program.sh"

# Images lie beside the program or in images/, wherever it is started; files that it reads itself are there, too.
mkdir -p images/images elsewhere
"$tyndall" render showroom --size 8x4 --spp 1 -q -o images/images/planet.png
program images/main <<<'int main() { double r = 0; std::ifstream("data/radius.txt") >> r; hittable_list w;
  w.add(make_shared<sphere>(point3(0, 0, -3), r, make_shared<lambertian>(make_shared<image_texture>("planet.png")))); camera cam; cam.image_width = 8; cam.render(w); }'
mkdir images/data && echo 1.5 >images/data/radius.txt
cd elsewhere || exit 1
expect 0 "$tyndall" convert ../images/main.cc -o ./moved.json
cd .. || exit 1
grep -qF '"file": "../images/images/planet.png"' elsewhere/moved.json || fail "$(cat elsewhere/moved.json)"
grep -qF '"radius": 1.5' elsewhere/moved.json || fail 'the file that main() reads'
expect 0 "$tyndall" inspect elsewhere/moved.json

# C++20 is tried where C++17 does not do; names are mapped whatever their style.
program modern <<<"$ball template <class T> concept anything = true; int main() { camera cam; cam.render(ball()); }"
expect 0 "$tyndall" inspect modern.cc
cat >styled.cc <<'END'
#include "../src/Hittable_List.hpp"
#include "Utils/Vec3.h"
int main() {
  HittableList world;
  world.add(make_shared<Sphere>(Point3(0, 0, -1), 0.5, make_shared<Metal>(Color(1, 1, 1), 0.0)));
  Camera cam;
  cam.imageWidth = 12;
  cam.aspectRatio = 2;
  cam.vFov = 33;
  cam.render(world);
}
END
expect 0 "$tyndall" convert styled.cc -o styled.json
same "readers' names" "$(json styled.json image) $(json styled.json camera)" '{"width": 12, "height": 6} {"vfov": 33, "focus_distance": 10, "shutter": [0, 1]}'

finish
