#!/usr/bin/env bash
# A picture that a program writes to standard input: rows are on the screen while it still writes, and stay where it ends
# early; a window that is closed or interrupted ends the program, too. The rest of it needs no display to be tested.
. "$(dirname "$0")/_lib.sh"

# piped_window ARGUMENTS: a window over what comes by a pipe.
piped_window() {
  rm -f pipe
  mkfifo pipe
  run_window bash -c 'exec "$@" <pipe' - "$tyndall" view - "$@" --ui-log "$scratch/log"
}
rows() { yes "$2 $2 $2" | head -$((320 * $1)) || true; } # COUNT BYTE
is_bright() { compares "($(on_screen picture mean) - $1) ^ 2 < 4"; }

piped_window
exec 3>pipe
printf 'P3 # by hand\n320 200\n255\n' >&3
find_window
enlarge
wait_for '^state row 0 of 200$'
wait_until is_bright 0
rows 100 255 >&3
wait_for '^state row 100 of 200$'
wait_until is_bright 127.5
printf '128 128 128 12' >&3 # what is cut within a number goes on later
printf '8 128 128\n' >&3
rows 50 128 | head -15998 >&3
wait_for '^state row 150 of 200$'
wait_until is_bright 159.5
bright=$(on_screen picture mean)
type_value image.exposure.value 1
brighter() { compares "$(on_screen picture mean) > $bright + 5"; }
wait_until brighter
type_value image.exposure.value 0
lines=$(here)
exec 3>&-
wait_for '^state ended at row 150 of 200$' "$lines"
settle
wait_until is_bright 159.5
finish

# Compared with another picture of its size.
{ echo P3 320 200 255 && rows 200 100; } >reference.ppm
piped_window --reference reference.ppm
cat reference.ppm >pipe
find_window
wait_for '^accuracy against reference.ppm .* FLIP 0 at 1 spp'
settle
finish

# A window that is closed ends the program that goes on writing by the usual signal, not by a crash of its own.
piped_window
bash -c 'printf "P3 320 200 255\n"; while :; do echo "1 2 3 "; done' >pipe 2>"$scratch/writer" &
writer=$!
find_window
wait_for '^state all 200 rows$'
finish
status=0
wait "$writer" || status=$?
[ "$status" = 141 ] || [ "$status" = 1 ] || fail "the program that writes ended with $status"

# Ctrl-C.
piped_window
exec 3>pipe
printf 'P3 320 200 255\n' >&3
find_window
kill -INT "$pid"
ends_with 130
