#!/usr/bin/env bash
# A program's own samples in the window: rendered, paused, restarted, read, saved, compared with a picture and with a
# scene; samples that fail are told; a slow function holds up nothing; the program's own things stay as they were.
. "$(dirname "$0")/_lib.sh"
library=$(dirname "$tyndall")
[ -e "$library/libtyndall-watch.so" ] || { echo "skipped: $library has no library"; exit 77; }
${CXX:-c++} -std=c++17 -O1 -I"$root/app/watch" "$root/tests/app/watch/probe.cpp" -o probe -L"$library" -ltyndall-watch \
  -Wl,-rpath,"$library" -pthread

export TYNDALL_UI_LOG=$scratch/log
# probe_window ARGUMENTS: the program, with its window as it comes.
probe_window() {
  run_window ./probe "$@" >out
  find_window
}
# ends CODE: the window is closed, and the program ends with that code.
ends() {
  press_close_button
  ends_with "$1"
}
# logs PATTERN COMMAND...: the command makes the log have such a line.
logs() {
  local lines
  lines=$(here)
  "${@:2}"
  wait_for "$1" "$lines"
}

# As any picture: finished, read, compared with a reference of the same values, saved. A window remembers nothing.
env -u DISPLAY ./probe place same.pfm
probe_window window - same.pfm
enlarge
wait_for '^state finished$'
wait_for '^accuracy against same.pfm '
says() { value inspector | grep -qE -- "$1"; }
key i
point picture 51 51
wait_until says 'red +20( |$)'
key i
logs '^widget legend .*relative error' key 5
logs '^widget legend .*samples' key 6
key 1
! grep -q '^message this is a picture' log || fail 'noise and samples are no views of a scene'
for part in camera.vfov render.spp tab.Camera tab.Objects image.clean; do
  ! grep -q "^widget $part " log || fail "there is $part"
done
logs '^message this is a picture without a scene' key 2
logs '^message saved image-001.png' chord ctrl p
[ ! -e image-001.exr ] || "$tyndall" compare image-001.exr image-001.exr --max-rmse 0 >/dev/null || fail 'the snapshot'
settle
ends 0
[ ! -s "$scratch/errors" ] || fail 'it complained'
[ -z "$(find "$XDG_STATE_HOME" -type f 2>/dev/null)" ] || fail "it keeps $(find "$XDG_STATE_HOME" -type f)"
[ "$(cat "$XDG_CONFIG_HOME/tyndall/window.txt")" = 'clean off' ] || fail 'the preferences were changed'

# Paused, gone on with, restarted.
probe_window slow - 0.0001
wait_for '^state rendering$'
logs '^state paused$' key space
logs '^state rendering$' key space
lines=$(here)
logs '^did start over' key r
wait_for '^state finished$' "$lines"
ends 0

# A scene as what the picture should look like.
probe_window window - cornell-box
wait_for '^message reference: cornell-box at 200 spp$'
wait_for '^accuracy against cornell-box at 200 spp'
ends 0

# What fails is told in the window and on standard error; the window stays, and says so in the end.
probe_window throws -
wait_for '^message pixel \(3, 4\), sample 2: no mesh'
wait_for '^state finished$'
grep -q '^tyndall: pixel (3, 4), sample 2: no mesh' "$scratch/errors" || fail 'nothing on standard error'
ends 1

# A function that takes a second keeps no window open.
probe_window slow - 1
started=$SECONDS
ends 0
[ $((SECONDS - started)) -le 5 ] || fail "it took $((SECONDS - started)) s to close"

# Another window after the first one; signals, rounding and locale are the program's.
probe_window twice -
wait_for '^state finished$'
: >"$scratch/log"
press_close_button
find_window # which begins the log anew
ends 0
probe_window process -
wait_for '^state finished$'
ends 0
[ "$(cat out)" = 'rounds still signals C' ] || fail "changed: $(cat out)"
