#!/usr/bin/env bash
# Ctrl-C and SIGTERM: the image so far is written, with its sample count, and can be resumed to the same picture.
. "$(dirname "$0")/_common.sh"

files=(long.png)
if has_exr; then files+=(long.exr); fi

# interrupted SIGNAL CODE: starts a long render, sends it the signal after a while, and expects the exit code.
interrupted() {
  rm -f long.*
  "$tyndall" render cornell-box --size 64x64 --spp 10000000 "${files[@]/#/--output=}" --stats long.json -q &
  local render=$! code=0
  wait_worked "$render" 1
  kill -"$1" "$render"
  wait "$render" || code=$?
  [ "$code" -eq "$2" ] || fail "SIG$1: exit code $code instead of $2"
  for file in "${files[@]}" long.json; do [ -s "$file" ] || fail "SIG$1: no $file"; done
  local spp
  spp=$(json long.json spp)
  [ "$spp" -ge 1 ] && [ "$spp" -lt 10000000 ] || fail "SIG$1: $spp samples"
}

interrupted HUP 129
interrupted XCPU 152
interrupted USR2 140
interrupted ALRM 142
interrupted TERM 143
interrupted INT 130
no_leftovers

# Continued to the number of samples of an uninterrupted render, it gives the same picture.
if [ -s long.exr ]; then
  spp=$(($(json long.json spp) / 64 * 64 + 128))
  expect 0 "$tyndall" render cornell-box --size 64x64 --spp "$spp" --resume -o long.exr --stats long.json
  same 'samples of a resumed render' "$(json long.json samples)" $((64 * 64 * spp))
  same 'hash of a resumed render' "$(json long.json image_hash)" "$(image_hash cornell-box --size 64x64 --spp "$spp")"
fi

# SIGUSR1 writes the picture so far, and the render goes on: the end is that of a render which was not asked.
long=(cornell-box --size 64x64 --spp 12000)
"$tyndall" render "${long[@]}" -o asked.pfm -o asked.png --stats asked.json -q &
render=$!
for work in 1 2; do
  wait_worked "$render" "$work"
  rm -f asked.*
  kill -USR1 "$render"
  for _ in $(seq 400); do [ -s asked.json ] && break || sleep 0.05; done
  for file in asked.pfm asked.png asked.json; do [ -s "$file" ] || fail "SIGUSR1: no $file"; done
  spp=$(json asked.json spp)
  [ "$spp" -ge 1 ] && [ "$spp" -lt 12000 ] || fail "SIGUSR1: $spp samples"
done
code=0
wait "$render" || code=$?
same 'exit code after SIGUSR1' "$code" 0
same 'samples after SIGUSR1' "$(json asked.json spp)" 12000
same 'hash after SIGUSR1' "$(json asked.json image_hash)" "$(image_hash "${long[@]}")"

# What was ignored at the start stays ignored: nohup, and "trap ''".
ignored=(HUP XCPU USR1 USR2 ALRM TERM)
(
  trap '' "${ignored[@]}"
  exec "$tyndall" render cornell-box --size 64x64 --spp 10000000 -o ignored.pfm --stats ignored.json -q
) &
render=$!
wait_worked "$render" 1
for signal in "${ignored[@]}"; do kill -"$signal" "$render"; done
wait_worked "$render" 2
[ ! -e ignored.json ] || fail 'a signal was ignored at the start, and something was written'
code=0
kill -INT "$render"
wait "$render" || code=$?
same 'ignored signals, then Ctrl-C' "$code" 130

# A limit of processor time: SIGXCPU comes every second, also while the picture is written.
code=0
(
  ulimit -S -t 1
  exec "$tyndall" render cornell-box --size 64x64 --spp 10000000 -o limit.pfm -q
) || code=$?
same 'exit code at a limit of processor time' "$code" 152
[ -s limit.pfm ] || fail 'nothing written at a limit of processor time'

# The second signal ends at once, even where the first one cannot be heeded.
"$tyndall" render cornell-box --size 64x64 --spp 10000000 -o twice.png -q &
render=$!
wait_worked "$render" 2
kill -STOP "$render"
kill -TERM "$render"
kill -INT "$render"
kill -CONT "$render"
code=0
wait "$render" || code=$?
[ "$code" -eq 130 ] || [ "$code" -eq 143 ] || fail "two signals: exit code $code"

finish
