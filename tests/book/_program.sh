# shellcheck shell=bash
# Sourced by tests that write small programs.
. "$(dirname "${BASH_SOURCE[0]}")/../app/_common.sh"
"$tyndall" version | grep -q '^guard  *none$' && { echo 'skipped: this system has no guard for programs'; exit 77; }

# program NAME: writes NAME.cc from standard input, behind the headers of the fourth edition.
program() {
  cp "$source_root/tests/book/headers/books.h" "$(dirname "$1")"
  { sed -n '/^#define/p' "$1.macros" 2>/dev/null; echo '#include "books.h"' && cat; } >"$1.cc"
}
ball='hittable_list ball() { hittable_list w; w.add(make_shared<sphere>(point3(0, 0, -1), 0.5, make_shared<lambertian>(color(0.5, 0.5, 0.5)))); return w; }'
render='camera c; c.image_width = 8; c.samples_per_pixel = 3;'

# not_taken NAME TEXT...: the program NAME from standard input is no scene, for a reason that has TEXT, but its own
# samples can be rendered.
not_taken() {
  local name=$1 text
  shift
  program "$name"
  expect 2 "$tyndall" convert "$name.cc" -o refused.json
  for text in "$@"; do grep -qF -- "$text" err || fail "$name: expected '$text' in: $(cat err)"; done
  [ ! -e refused.json ] || fail "$name: a scene was written"
}
