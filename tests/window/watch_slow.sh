#!/usr/bin/env bash
# A program's own samples in the window: rendered, paused, restarted, read, saved, compared with a picture and with a
# scene; samples that fail are told; a slow function holds up nothing; the program's own things stay as they were.
. "$(dirname "$0")/_lib.sh"
library=$(dirname "$tyndall")
[ -e "$library/libtyndall-watch.so" ] || { echo "skipped: $library has no library"; exit 77; }
${CXX:-c++} -std=c++17 -O1 -I"$root/app/watch" "$root/tests/app/watch/probe.cpp" -o probe -L"$library" -ltyndall-watch \
  -Wl,-rpath,"$library" -pthread

# probe_window ARGUMENTS: the program, with its window as it comes.
probe_window() {
  : >"$scratch/log"
  TYNDALL_UI_LOG=$scratch/log ./probe "$@" >out 2>"$scratch/errors" &
  pid=$!
  trap 'kill $pid 2>/dev/null || true' EXIT
  find_window
}
# ends CODE: the window is closed, and the program ends with that code.
ends() {
  python3 "$root/tests/window/_close.py" "$window"
  ends_with "$1"
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
lines=$(here)
key 5
wait_for '^widget legend .*relative error' "$lines"
key 6
wait_for '^widget legend .*samples' "$lines"
key 1
! grep -q '^message this is a picture' log || fail 'noise and samples are no views of a scene'
for part in camera.vfov render.spp tab.Camera tab.Objects image.clean; do
  ! grep -q "^widget $part " log || fail "there is $part"
done
key 2
wait_for '^message this is a picture without a scene' "$lines"
lines=$(here)
chord ctrl p
wait_for '^message saved image-001.png' "$lines"
[ ! -e image-001.exr ] || "$tyndall" compare image-001.exr image-001.exr --max-rmse 0 >/dev/null || fail 'the snapshot'
settle
ends 0
[ ! -s "$scratch/errors" ] || fail 'it complained'
[ -z "$(find "$XDG_STATE_HOME" -type f 2>/dev/null)" ] || fail "it keeps $(find "$XDG_STATE_HOME" -type f)"
same=$(cat "$XDG_CONFIG_HOME/tyndall/window.txt")
[ "$same" = 'clean off' ] || fail "the preferences were changed: $same"

# Paused, gone on with, restarted.
probe_window slow - 0.0001
wait_for '^state rendering$'
lines=$(here)
key space
wait_for '^state paused$' "$lines"
lines=$(here)
key space
wait_for '^state rendering$' "$lines"
lines=$(here)
key r
wait_for '^did start over' "$lines"
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
python3 "$root/tests/window/_close.py" "$window"
find_window # which begins the log anew
ends 0
probe_window process -
wait_for '^state finished$'
ends 0
[ "$(cat out)" = 'rounds still signals C' ] || fail "changed: $(cat out)"
