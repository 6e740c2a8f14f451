#!/usr/bin/env bash
# A picture that a program writes to standard input: rows appear while it still writes, can be enlarged, read and
# exposed, stay where it ends early, and are compared with a reference. There is no scene to edit.
. "$(dirname "$0")/_lib.sh"

# piped_window ARGUMENTS: a window over what this script writes to descriptor 3.
piped_window() {
  : >"$scratch/log"
  rm -f pipe
  mkfifo pipe
  "$tyndall" view - "$@" --ui-log "$scratch/log" <pipe 2>"$scratch/errors" &
  pid=$!
  trap 'kill $pid 2>/dev/null || true' EXIT
  exec 3>pipe
}
await_window() {
  find_window
  enlarge
}
rows() { python3 -c "print(('$2 $2 $2 ' * 320 + '\n') * $1, end='')"; }
is_bright() { compares "abs($(brightness picture) - $1) < 2"; }

piped_window
printf 'P3 # by hand\n320 200\n255\n' >&3
await_window
wait_for '^state row 0 of 200$'
wait_until is_bright 0
rows 100 255 >&3
wait_for '^state row 100 of 200$'
wait_until is_bright 127.5
printf '128 128 128 12' >&3 # what is cut within a number goes on later
printf '8 128 128\n' >&3
rows 49 128 >&3
python3 -c "print('128 128 128 ' * 318)" >&3
wait_for '^state row 150 of 200$'
wait_until is_bright 159.5
kill -0 "$pid" || fail 'the window is gone'

# The inspector reads a pixel that is there, the wheel enlarges, and nothing leads to a scene.
says() { value inspector | grep -qE -- "$1"; }
key i
point picture 50 25
wait_until says 'red +1( |$).*shown +255 255 255'
point picture 50 90
wait_until says 'red +0( |$)'
lines=$(here)
roll
wait_for '^widget zoom ' "$lines"
key 0 && key 0 # to actual size or all of it
key i
for part in camera.vfov render.spp tab.Camera tab.Objects; do
  ! grep -q "^widget $part " log || fail "there is $part"
done
lines=$(here)
chord ctrl s
wait_for '^message this is a picture without a scene' "$lines"
key c
xdotool key --delay 60 w a s d
lines=$(here)
key 2
wait_for '^message this is a picture without a scene' "$lines"
[ "$(submits)" = 1 ] || fail "$(submits) submits: keys have changed a scene"

# Exposure is of the display: no sample is asked for again, and no edit is lost.
bright=$(brightness picture)
type_value image.exposure.value 1
brighter() { compares "$(brightness picture) > $bright + 5"; }
wait_until brighter
type_value image.exposure.value 0
lines=$(here)
chord ctrl p
wait_for '^message saved image-001.png' "$lines"
"$tyndall" compare image-001.png image-001.png >/dev/null 2>&1 || fail 'the snapshot is no picture'
! "$tyndall" inspect image-001.png >/dev/null 2>&1 || fail 'the snapshot holds a scene'

# It ends early: the rows stay, and it is said.
lines=$(here)
exec 3>&-
wait_for '^message ended at row 150 of 200$' "$lines"
wait_for '^state ended at row 150 of 200$' "$lines"
settle
is_bright 159.5 || fail "the rows are gone: $(brightness picture)"
finish

# Compared with another picture of its size, here as bytes.
python3 -c "import sys; sys.stdout.buffer.write(b'P6 320 200 255\n' + bytes([200, 100, 50]) * 64000)" >reference.ppm
piped_window --reference reference.ppm
cat reference.ppm >&3
exec 3>&-
await_window
wait_for '^state all 200 rows$'
wait_for '^accuracy against reference.ppm .* FLIP 0 at 1 spp'
settle
finish

# A window that is closed ends the program that goes on writing by the usual signal, not by a crash of its own.
: >"$scratch/log"
rm -f pipe
mkfifo pipe
"$tyndall" view - --ui-log "$scratch/log" <pipe 2>"$scratch/errors" &
pid=$!
bash -c 'printf "P3 320 200 255\n"; while :; do echo "1 2 3 "; done' >pipe 2>"$scratch/writer" &
writer=$!
await_window
wait_for '^state all 200 rows$'
finish
status=0
wait "$writer" || status=$?
[ "$status" = 141 ] || [ "$status" = 1 ] || fail "the program that writes ended with $status"

# Ctrl-C.
piped_window
printf 'P3 320 200 255\n' >&3
await_window
kill -INT "$pid"
status=0
wait "$pid" || status=$?
[ "$status" = 130 ] || fail "SIGINT gives $status"
exec 3>&-
