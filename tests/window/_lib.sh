# shellcheck shell=bash
# Sourced by the window tests: a real window under Xvfb, driven by xdotool.
# Arguments of each test: the tyndall binary, a scratch folder, the source root.
set -euo pipefail
script=$(realpath "$0")
tyndall=$(realpath "$1")
scratch=$2
root=$(realpath "$3")
mkdir -p "$scratch"
cd "$scratch"

if [ -z "${IN_XVFB:-}" ]; then
  for tool in xvfb-run xdotool python3; do
    command -v "$tool" >/dev/null && continue
    echo "$tool is missing"
    [ "${CI:-}" = true ] && exit 1
    exit 77
  done
  rm -rf "${scratch:?}"/* && mkdir -p "$scratch/screen"
  IN_XVFB=1 exec xvfb-run -a -s "-screen 0 1280x1820x24 -nolisten tcp -fbdir $scratch/screen" \
    bash "$script" "$tyndall" "$scratch" "$root"
fi

fail() {
  exec >&2
  echo "FAILED: $*"
  echo "--- end of the log:"
  grep -v '^drawn' "$scratch/log" | tail -40 || true
  echo "--- errors:"
  cat "$scratch/errors"
  exit 1
}

# A small scene with a metal ball, a lamp and fog; $1: the file, $2: fuzz, $3: samples a pixel.
write_scene() {
  cat >"$1.new" <<SCENE
// A comment that saving loses.
{
  "tyndall": 1,
  "image": { "width": 320, "height": 200 },
  "camera": { "look_from": [0, 1, 6], "look_at": [0, 0.5, 0], "vfov": 40 },
  "background": { "type": "gradient", "bottom": [0.9, 0.9, 0.9], "top": [0.2, 0.3, 0.5] },
  "render": { "spp": ${3:-16}, "integrator": "path", "sampler": "random" },
  "materials": {
    "floor": { "type": "lambertian", "albedo": [0.4, 0.4, 0.4] },
    "gold": { "type": "metal", "albedo": [0.9, 0.6, 0.3], "fuzz": $2 },
    "lamp": { "type": "light", "radiance": [4, 4, 4] }
  },
  "objects": [
    { "name": "floor", "type": "sphere", "center": [0, -1000, 0], "radius": 1000, "material": "floor" },
    { "name": "ball", "type": "sphere", "center": [0, 0.8, 0], "radius": 0.8, "material": "gold" },
    { "name": "fog", "type": "medium", "boundary": { "type": "sphere", "center": [2, 0.6, 0], "radius": 0.6 }, "density": 1.1, "albedo": [1, 1, 1] },
    { "name": "lamp", "type": "quad", "corner": [-2, 4, -1], "u": [4, 0, 0], "v": [0, 0, 2], "material": "lamp" }
  ]
}
SCENE
  mv "$1.new" "$1"
}

# start ARGUMENTS: opens the window and waits for its first picture.
start() {
  : >"$scratch/log"
  "$tyndall" view "$@" --ui-log "$scratch/log" 2>"$scratch/errors" &
  pid=$!
  trap 'kill $pid 2>/dev/null || true' EXIT
  wait_for '^frame 1 '
  window=$(xdotool search --sync --onlyvisible --name 'Tyndall$' | head -1)
  # All of the column is on the screen.
  xdotool windowsize --sync "$window" 1280 1780
  xdotool mousemove 5 5
  wait_for '^widget scenes.cover '
}

# Waits until a line of the log matches; from line $2 on, if it is given.
wait_for() {
  local tries
  for tries in $(seq 300); do
    tail -n "+${2:-1}" "$scratch/log" | grep -qE "$1" && return 0
    kill -0 "$pid" 2>/dev/null || fail "the program ended; never saw: $1"
    sleep 0.1
  done
  fail "never saw: $1 (after $tries tries)"
}

# The number of lines in the log, for wait_for's second argument.
here() { echo $(($(wc -l <"$scratch/log") + 1)); }

# The number of edits that were submitted.
submits() { grep -c '^submit' "$scratch/log"; }

# Waits until nothing has been written to the log for half a second.
settle() {
  local before now=-1 tries
  for tries in $(seq 100); do
    before=$now
    now=$(wc -c <"$scratch/log")
    [ "$now" = "$before" ] && return 0
    sleep 0.5
  done
  fail "the window does not come to rest after $tries tries"
}

# at NAME ACROSS [DOWN]: window coordinates of a point of a control; ACROSS and DOWN in percent.
at() {
  local line
  line=$(grep -E "^(widget|gone) ${1//./\\.}( |$)" "$scratch/log" | tail -1)
  case $line in widget*) ;; *) fail "there is no control $1" ;; esac
  # shellcheck disable=SC2086
  set -- $line "$2" "${3:-50}"
  local down=${!#} across
  across=$(eval "echo \${$(($# - 1))}")
  echo $(($3 + ($5 - $3) * across / 100)) $(($4 + ($6 - $4) * down / 100))
}

# The value that a control had last.
value() { grep -E "^widget ${1//./\\.} " "$scratch/log" | tail -1 | cut -d' ' -f7-; }

point() {
  local place
  place=$(at "$@") || exit 1
  # shellcheck disable=SC2086
  xdotool mousemove $place
  sleep 0.08
}
click() {
  point "$1" "${2:-50}" "${3:-50}"
  xdotool mousedown 1
  sleep 0.08
  xdotool mouseup 1
  sleep 0.15
}
key() {
  xdotool keydown "$1"
  sleep 0.1
  xdotool keyup "$1"
  sleep 0.1
}
# With modifiers: chord ctrl z
chord() {
  xdotool key --delay 60 "$(IFS=+; echo "$*")"
  sleep 0.15
}
type_value() {
  click "$1"
  sleep 0.25
  xdotool type --delay 40 "$2"
  sleep 0.1
  key Return
  sleep 0.2
}

# Mean of the screen's red, green and blue within a control's rectangle.
brightness() {
  local line
  line=$(grep -E "^widget ${1//./\\.} " "$scratch/log" | tail -1)
  # shellcheck disable=SC2086
  set -- $line
  python3 - "$scratch/screen/Xvfb_screen0" "$3" "$4" "$5" "$6" <<'PY'
import struct, sys
data = open(sys.argv[1], "rb").read()
x0, y0, x1, y1 = map(int, sys.argv[2:6])
header = struct.unpack(">25I", data[:100])
stride, start = header[12], header[0] + 12 * header[19]
total = count = 0
for y in range(y0, y1):
    row = data[start + y * stride + 4 * x0 : start + y * stride + 4 * x1]
    for c in range(3):
        total += sum(row[c::4])
    count += 3 * (x1 - x0)
print(round(total / count, 2))
PY
}

# The screen's bytes, to see whether anything changed.
screen_hash() { md5sum <"$scratch/screen/Xvfb_screen0" | cut -d' ' -f1; }

# Closes with Ctrl+Q and checks how it ended.
finish() {
  chord ctrl q
  local status=0
  wait "$pid" || status=$?
  [ "$status" = 0 ] || fail "exit code $status"
  [ -s "$scratch/errors" ] && fail "it complained"
  grep -q '^latency' "$scratch/log" || fail "no summary in the log"
  trap - EXIT
}
