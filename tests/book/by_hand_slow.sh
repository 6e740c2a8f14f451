#!/usr/bin/env bash
# Programs that are built with the books' headers alone behave as with the books' own: they write a picture.
. "$(dirname "$0")/../app/_common.sh"
programs=$source_root/tests/book

expect 0 "$tyndall" book
[ ! -s err ] || fail "book complains: $(cat err)"
headers=$(cat out)
[ -f "$headers/rtweekend.h" ] || fail "no headers in '$headers'"
expect 2 "$tyndall" book more
complains 'more'

for header in "$headers"/*.h; do
  case $header in */rtweekend.h) continue ;; esac
  same "$header" "$(cat "$header")" "$(printf '#pragma once\n#include "rtweekend.h"')"
done
for compiler in g++ clang++; do
  command -v "$compiler" >/dev/null || continue
  echo 'int main() {}' | cat <(echo '#include "vec3.h"') - >empty.cc
  "$compiler" -std=c++17 -Werror -I"$headers" -fsyntax-only empty.cc || fail "$compiler: the headers have warnings"
  "$compiler" -std=c++17 -Wall -Wextra -Werror -I"$headers" -fsyntax-only empty.cc || fail "$compiler -Wall"
done

# As "tyndall book --help" tells it: in the program's own folder its sphere.h would be found first.
build() {
  local program=$PWD/$2
  (cd "$(mktemp -d -p "$PWD")" && ${CXX:-c++} -std=c++17 -I"$headers" -x c++ - -o "$program") <"$1" || fail "$1 does not compile"
}
build "$programs/first/main.cc" first
expect 0 ./first
mv out first.ppm
grep -qF 'from the loop in main(): 40 x 30, 3 samples, depth 20, sky (1, 0.9, 0.8) to (0.2, 0.4, 0.6)' err || fail "$(cat err)"
expect 0 "$tyndall" render "$programs/first/scene.json" --format ppm --gamma2 -o -
cmp -s out first.ppm || fail 'the first edition: standard output is another picture than the scene'"'"'s'
expect 0 ./first -o named.png
expect 0 env TYNDALL_OUTPUT=variable.png ./first
[ ! -s out ] || fail 'with TYNDALL_OUTPUT something goes to standard output'
same 'pictures by -o and by TYNDALL_OUTPUT' "$(cksum <named.png)" "$(cksum <variable.png)"
expect 0 "$tyndall" convert named.png -o named.json
grep -q '"width": 40' named.json || fail 'the picture does not hold its scene'
expect 3 ./first -o nowhere/x.png

# The third edition's loop writes into a file of its own, which must become whole.
build "$programs/third/main.cc" third
expect 0 ./third
expect 0 "$tyndall" render "$programs/third/scene.json" --gamma2 -o third.ppm
python3 - <<'PYTHON' || fail 'picture.ppm is another picture than the scene'"'"'s'
rows = open("picture.ppm").read().split()
bytes_of = open("third.ppm", "rb").read().split(b"\n", 3)[3]
assert rows[:4] == ["P3", "48", "36", "255"] and [int(r) for r in rows[4:]] == list(bytes_of)
PYTHON

# The newest edition: text beside the picture stays, and main() goes on after render().
cat >newest.cc <<'END'
#include "rtweekend.h"
#include "camera.h"
#include "hittable_list.h"
#include "material.h"
#include "sphere.h"
int main() {
  std::cout << "before" << std::endl;
  hittable_list world;
  world.add(make_shared<sphere>(point3(0, 0, -1), 0.5, make_shared<lambertian>(color(0.5, 0.5, 0.5))));
  camera cam;
  cam.image_width = 10;
  cam.render(world);
  std::cout << "after" << std::endl;
}
END
build newest.cc newest
expect 0 ./newest
same 'what main() writes beside the picture' "$(head -c 10 out | tr '\n' ' ')$(tail -c 6 out)" 'before P6 after'
same 'size' "$(wc -c <out)" $((7 + 13 + 300 + 6))

# Where tyndall is not to be found, and where there is nothing to show a picture on.
cp -r "$headers/" lone
headers=$PWD/lone build newest.cc lone_program
expect 3 env PATH=/nowhere ./lone_program
grep -q 'tyndall: the program tyndall is neither beside these headers nor in PATH' err || fail "$(cat err)"
expect 0 env PATH="$(dirname "$tyndall"):$PATH" ./lone_program
if command -v script >/dev/null; then
  env -u DISPLAY -u WAYLAND_DISPLAY script -qec ./newest /dev/null >terminal </dev/null
  same 'exit code on a terminal without a display' $? 3
  grep -q 'use > image.ppm or -o FILE' terminal || fail "$(cat terminal)"
fi

finish
