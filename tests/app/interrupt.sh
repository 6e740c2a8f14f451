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
  wait_worked "$render" 2
  kill -"$1" "$render"
  wait "$render" || code=$?
  [ "$code" -eq "$2" ] || fail "SIG$1: exit code $code instead of $2"
  for file in "${files[@]}" long.json; do [ -s "$file" ] || fail "SIG$1: no $file"; done
  local spp
  spp=$(json long.json spp)
  [ "$spp" -ge 1 ] && [ "$spp" -lt 10000000 ] || fail "SIG$1: $spp samples"
}

interrupted TERM 143
interrupted INT 130

# Continued to the number of samples of an uninterrupted render, it gives the same picture.
if [ -s long.exr ]; then
  spp=$(($(json long.json spp) / 64 * 64 + 128))
  expect 0 "$tyndall" render cornell-box --size 64x64 --spp "$spp" --resume -o long.exr --stats long.json
  same 'samples of a resumed render' "$(json long.json samples)" $((64 * 64 * spp))
  same 'hash of a resumed render' "$(json long.json image_hash)" "$(image_hash cornell-box --size 64x64 --spp "$spp")"
fi

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
