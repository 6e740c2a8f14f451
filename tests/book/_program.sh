# shellcheck shell=bash
# Sourced by tests that write small programs.
. "$(dirname "${BASH_SOURCE[0]}")/../app/_common.sh"
"$tyndall" version | grep -q '^guard  *none$' && { echo 'skipped: this system has no guard for programs'; exit 77; }

# program NAME: writes NAME.cc with the books' headers, from standard input.
program() {
  { printf '#include "%s"\n' rtweekend.h camera.h hittable_list.h material.h sphere.h quad.h texture.h && cat; } >"$1.cc"
}
ball='hittable_list ball() { hittable_list w; w.add(make_shared<sphere>(point3(0, 0, -1), 0.5, make_shared<lambertian>(color(0.5, 0.5, 0.5)))); return w; }'

# refused NAME TEXT...: writes the program NAME from standard input; taking its scene fails with a line that has TEXT.
refused() {
  local name=$1
  shift
  program "$name"
  expect 2 "$tyndall" convert "$name.cc" -o refused.json
  complains "$name.cc:" "$@"
  [ ! -e refused.json ] || fail "$name: a scene was written"
}
