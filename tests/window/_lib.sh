# shellcheck shell=bash
# Sourced by the window tests: a real window under Xvfb, driven by xdotool.
# Arguments of each test: the tyndall binary, a scratch folder, the source root.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/../../third_party/switches.sh"
script=$(realpath "$0")
tyndall=$(realpath "$1")
scratch=$2
root=$(realpath "$3")
mkdir -p "$scratch"
cd "$scratch"

# The screen repeats no key that is held down (-r): on a busy machine it would be held for long. It begins nothing anew
# when its last window goes (-noreset): meanwhile the next one could not be opened.
if [ -z "${IN_XVFB:-}" ]; then
  for tool in xvfb-run xdotool python3; do
    command -v "$tool" >/dev/null && continue
    echo "$tool is missing"
    ! in_ci || exit 1
    exit 77
  done
  # A folder of this run alone: the screen of the run before may still be ending, and then removes its own picture.
  screen=$scratch/screen.$$
  rm -rf "${scratch:?}"/* && mkdir -p "$screen"
  IN_XVFB=$screen exec xvfb-run -a -s "-r -noreset -screen 0 ${screen_size:-1280x2700}x24 -nolisten tcp -fbdir $screen" \
    bash "$script" "$tyndall" "$scratch" "$root"
fi
screen=$IN_XVFB
# The window remembers nothing of other tests, and shows the raw picture.
export XDG_CONFIG_HOME=$scratch/config XDG_STATE_HOME=$scratch/state XDG_CACHE_HOME=${XDG_CACHE_HOME:-$scratch/cache}
mkdir -p "$XDG_CONFIG_HOME/tyndall"
echo 'clean off' >"$XDG_CONFIG_HOME/tyndall/window.txt"

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
  sed -e 's/"width": 32, "height": 20/"width": 320, "height": 200/' -e "s/\"fuzz\": 0.2/\"fuzz\": $2/" \
    -e "s/\"spp\": 2/\"spp\": ${3:-16}/" "$root/tests/window/scene.json" >"$1.new"
  mv "$1.new" "$1"
}

# Nothing here waits for a time: a test sends something and waits until the window's log says that it has arrived and
# what came of it. This many seconds end a test that hangs, and do nothing else.
patience=150

# wait_until COMMAND...: runs the command again and again until it succeeds.
wait_until() {
  local end=$((SECONDS + patience)) alive
  while :; do
    alive=yes
    kill -0 "$pid" 2>/dev/null || alive=
    "$@" && return 0
    [ "$alive" ] || fail "the program ended; never came true: $*"
    [ "$SECONDS" -lt "$end" ] || fail "did not come true within $patience seconds: $*"
    sleep 0.03
  done
}

# logged PATTERN LINE: whether a line of the log matches, from that line on.
logged() { grep -qE -- "$1" < <(tail -n "+$2" "$scratch/log"); }

# wait_for PATTERN [LINE]: until a line of the log matches; from that line on, if it is given.
wait_for() { wait_until logged "$1" "${2:-1}"; }

# The number of lines in the log and one, for wait_for's second argument.
here() { echo $(($(wc -l <"$scratch/log") + 1)); }

# Waits until the window is at rest: all that was sent to it is shown, the picture is finished.
# What was sent must have arrived before; the helpers below see to that.
settle() { wait_until at_rest; }
at_rest() { [ "$(tail -1 "$scratch/log")" = rest ]; }

# Waits until the last message has gone from the screen, and for rest.
settle_without_message() {
  wait_until no_message
  settle
}
no_message() { [ -z "$(last_of message)" ]; }

# last_of KIND: the newest line of a kind, without its first word.
last_of() { awk -v kind="$1" '$1 == kind { line = $0 } END { print substr(line, length(kind) + 2) }' "$scratch/log"; }

# sends COUNT PATTERN COMMAND...: runs the command, which sends input, and waits until the log has that many more lines
# that match, and a drawing after them.
sends() {
  local count=$1 pattern=$2 from
  from=$(here)
  shift 2
  "$@"
  wait_until drawn_after "$count" "$pattern" "$from"
}
drawn_after() {
  awk -v left="$1" -v pattern="$2" '$0 ~ pattern { --left } /^drawn/ && left <= 0 { drawn = 1 } END { exit !drawn }' \
    < <(tail -n "+$3" "$scratch/log")
}

# run_window COMMAND...: a program that opens a window with that log, which --ui-log or TYNDALL_UI_LOG names.
run_window() {
  : >"$scratch/log"
  "$@" <&0 2>"$scratch/errors" &
  pid=$!
  trap 'kill $pid 2>/dev/null || true' EXIT
}
# open_window ARGUMENTS: opens the window as it comes, and waits for its first picture.
open_window() {
  run_window "$tyndall" view "$@" --ui-log "$scratch/log"
  find_window
}
find_window() {
  wait_for '^frame 1 '
  window=$(xdotool search --sync --onlyvisible --name 'Tyndall$' | head -1)
}
enlarge() { # all of the column is on the screen
  sends 1 '^size 1280 2640$' xdotool windowsize "$window" 1280 2640
  move 5 5
  wait_for '^widget scenes.cover '
}

# start ARGUMENTS: opens it enlarged.
start() {
  open_window "$@"
  enlarge
}

# at NAME ACROSS [DOWN]: window coordinates of a point of a control; ACROSS and DOWN in percent.
at() {
  local kind x0 y0 x1 y1 _
  read -r kind _ x0 y0 x1 y1 _ < <(grep -E "^(widget|gone) ${1//./\\.}( |$)" "$scratch/log" | tail -1) || true
  [ "$kind" = widget ] || fail "there is no control $1"
  echo $((x0 + (x1 - x0) * $2 / 100)) $((y0 + (y1 - y0) * ${3:-50} / 100))
}

# The value that a control had last.
value() { grep -E "^widget ${1//./\\.} " "$scratch/log" | tail -1 | cut -d' ' -f7-; }
has_value() { [ "$(value "$1")" = "$2" ]; }
has_other_value() { [ "$(value "$1")" != "$2" ]; }

# move X Y: the pointer.
move() { [ "$(last_of mouse)" = "$1 $2" ] || sends 1 "^mouse $1 $2\$" xdotool mousemove "$1" "$2"; }
# point NAME ACROSS [DOWN]: see at.
point() {
  local place now
  now=$(at "$@") || exit 1
  while [ "$now" != "${place:-}" ]; do # what has just appeared may find its place one drawing later
    place=$now
    # shellcheck disable=SC2086
    move $place
    now=$(at "$@") || exit 1
  done
}
# Buttons: 1 left, 2 middle, 3 right.
press() { sends 1 '^buttons .*1' xdotool mousedown "$1"; }
release() { sends 1 '^buttons 0 0 0' xdotool mouseup "$1"; }
click() {
  point "$1" "${2:-50}" "${3:-50}"
  press 1
  release 1
}
hold() { sends 1 '^key ' xdotool keydown "$1"; }
key() {
  hold "$1"
  xdotool keyup "$1"
}
# With modifiers: chord ctrl z
chord() { sends $# '^key ' xdotool key --delay 60 "$(IFS=+; echo "$*")"; }
# type_text TEXT: into the control that has the keyboard, as soon as one has it.
type_text() {
  wait_until has_keyboard control
  sends ${#1} '^key ' xdotool type --delay 40 "$1"
}
has_keyboard() { [ "$(last_of keyboard)" = "$1" ]; }
enter() {
  wait_until has_keyboard control
  key Return
  wait_until has_keyboard shortcuts
}
type_value() {
  click "$1"
  type_text "$2"
  enter
}

# on_screen NAME COMMAND [PICTURE]: what the screen shows in a control's rectangle, see _screen.py. The X server puts a
# drawing on the screen some time after the log has told of it: what is expected of the screen is waited for.
on_screen() {
  local x0 y0 x1 y1 _
  read -r _ _ x0 y0 x1 y1 _ < <(grep -E "^widget ${1//./\\.} " "$scratch/log" | tail -1)
  python3 -B "$root/tests/window/_screen.py" "$screen/Xvfb_screen0" "$x0" "$y0" "$x1" "$y1" "${@:2}"
}

# compares CONDITION: awk's comparison of numbers.
compares() { awk "BEGIN { exit !($*) }"; }

# ends_with STATUS TEXT...: the window ends with that status, and its last line has each text.
ends_with() {
  local status=0 text
  wait "$pid" || status=$?
  trap - EXIT
  [ "$status" = "$1" ] || fail "exit code $status, expected $1"
  for text in "${@:2}"; do tail -1 "$scratch/errors" | grep -qF -- "$text" || fail "the last line lacks '$text'"; done
}
# Asks it to close, as the button in its title bar does.
press_close_button() { python3 -B "$root/tests/window/_close.py" "$window"; }

# Closes with Ctrl+Q, without saving, and checks how it ended.
finish() {
  local lines
  lines=$(here)
  xdotool key --delay 60 ctrl+q
  while kill -0 "$pid" 2>/dev/null; do
    if logged '^widget dialog.discard ' "$lines"; then
      point dialog.discard 50
      xdotool click 1 # the window goes before it tells of the button
      break
    fi
    sleep 0.03
  done
  ends_with 0
  [ -s "$scratch/errors" ] && fail "it complained"
  grep -q '^latency' "$scratch/log" || fail "no summary in the log"
}
