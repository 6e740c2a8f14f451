#!/usr/bin/env bash
# A program of the books in the window: saved, it is compiled again behind the picture; what is wrong with it is shown
# above the last good scene; Ctrl+S never writes into it.
. "$(dirname "$0")/_lib.sh"

write_program() { # RADIUS
  cat >main.cc.new <<PROGRAM
#include "$root/tests/book/headers/books.h"
int main() {
  hittable_list world;
  world.add(make_shared<sphere>(point3(0, 0, -2), $1, make_shared<lambertian>(color(0.1, 0.1, 0.1))));
  camera cam;
  cam.image_width = 200;
  cam.samples_per_pixel = 4;
  cam.background = color(0.9, 0.9, 0.9);
  cam.render(world);
}
PROGRAM
  mv main.cc.new main.cc
}
write_program 0.5
start main.cc --trust
settle
small=$(brightness picture)

write_program 1.5
wait_for '^submit 2'
settle
compares "$(brightness picture) < $small - 3" || fail 'the ball did not grow'
large=$(brightness picture)
edits=$(submits)

lines=$(here)
write_program nonsense
wait_for "^message main.cc:4:[0-9]+: 'nonsense' was not declared|^message main.cc:4:[0-9]+: use of undeclared identifier 'nonsense'" "$lines"
settle
[ "$(submits)" = "$edits" ] || fail 'a broken program was submitted'
compares "abs($(brightness picture) - $large) < 3" || fail 'the last good picture is gone'

write_program 0.5
wait_for '^submit 3'
settle
before=$(cksum <main.cc)
lines=$(here)
chord ctrl s
wait_for '^widget dialog.name' "$lines"
wait_until has_keyboard control
chord ctrl a
type_text saved.json
key Return
wait_for '^saved saved.json' "$lines"
[ "$(cksum <main.cc)" = "$before" ] || fail 'the program was written to'
grep -q '"radius": 0.5' saved.json || fail 'the scene was not saved'
finish
