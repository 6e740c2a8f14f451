#!/usr/bin/env bash
# Ctrl-C and SIGTERM: the image so far is written, with its sample count, and can be resumed to the same picture.
. "$(dirname "$0")/_common.sh"

files=(long.png)
if has_exr; then files+=(long.exr); fi

# Seconds of work after which a small render has surely begun, and one of many pixels is in the middle of a pass: some
# times what a whole small one takes, however slow this build and this machine are.
begun=$(awk "BEGIN { print 0.1 + 3 * $(work_of "$tyndall" render cornell-box --size 64x64 --spp 1 -q -o begun.pfm) }")
later=$(awk "BEGIN { print 3 * $begun }")

# interrupted SIGNAL CODE: starts a long render, sends it the signal after a while, and expects the exit code.
interrupted() {
  rm -f long.*
  "$tyndall" render cornell-box --size 64x64 --spp 10000000 "${files[@]/#/--output=}" --stats long.json -q &
  local render=$! code=0
  wait_worked "$render" "$begun"
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

# A render that is interrupted within a pass keeps that pass's samples, which some pixels have and others have not. That
# is said in a line, in the figures and in the files; where all pixels have the same number nothing is said. This picture
# has so many pixels that a signal hardly ever comes between two passes; if it does, there is another attempt.
long=(render cornell-box --size 600x600 -t 1 -q)
outputs=(-o uneven.png)
if has_exr; then outputs+=(-o uneven.exr); fi
least=0 most=0
for _ in 1 2 3 4 5; do
  rm -f uneven.*
  "$tyndall" "${long[@]}" --spp 10000000 "${outputs[@]}" --stats uneven.json 2>err &
  render=$!
  wait_worked "$render" "$later"
  kill -INT "$render"
  code=0
  wait "$render" || code=$?
  same 'exit code within a pass' "$code" 130
  least=$(json uneven.json least_spp) most=$(json uneven.json most_spp)
  same 'spp within a pass' "$(json uneven.json spp)" "$least"
  if [ "$least" = "$most" ]; then
    [ ! -s err ] || fail "all pixels have $least samples, and it says: $(cat err)"
    continue
  fi
  complains "$least to $most samples"
  grep -aq "\"least_spp\": $least" uneven.png || fail 'the picture does not say the least number of samples'
  grep -aq "\"most_spp\": $most" uneven.png || fail 'the picture does not say the greatest number of samples'
  [ "$(json uneven.json samples)" -gt $((360000 * least)) ] || fail 'the samples are not those of an uneven picture'
  [ "$(json uneven.json samples)" -lt $((360000 * most)) ] || fail 'the samples are not those of an uneven picture'
  [ "$((least + 1))" -lt "$most" ] && break
done
[ "$((least + 1))" -lt "$most" ] || fail 'no signal came within a pass: this test has found nothing out'

# Going on from such a film makes it even; where fewer samples are asked for than some pixels have, that is said.
if has_exr; then
  long+=(-o uneven.exr)
  cp uneven.exr copy.exr
  expect 0 "$tyndall" "${long[@]}" --spp "$least" --stats again.json
  grep -q "has $least to $most samples a pixel already, more than the $least asked for; it is written as it is" err ||
    fail "an uneven film of as many samples as asked for says: $(cat err)"
  cp copy.exr uneven.exr
  expect 0 "$tyndall" "${long[@]}" --spp $((least + 1)) --stats again.json
  grep -q "more than the $((least + 1)) asked for; all pixels get as many" err || fail "it says: $(cat err)"
  same 'least samples of a film that was made even' "$(json again.json least_spp)" "$most"
  same 'most samples of a film that was made even' "$(json again.json most_spp)" "$most"
  expect 0 "$tyndall" merge copy.exr -o merged.pfm :: "$least to $most samples"
fi

# So is it for the picture that SIGUSR1 asks for; with adaptive sampling the numbers differ by design, and nothing is said.
"$tyndall" render cornell-box --size 600x600 --spp 10000000 -t 1 -q -o told.png --stats told.json 2>err &
render=$!
wait_worked "$render" "$later"
kill -USR1 "$render"
for _ in $(seq 400); do [ -s told.json ] && break || sleep 0.05; done
least=$(json told.json least_spp) most=$(json told.json most_spp)
[ "$least" = "$most" ] || complains "$least to $most samples"
kill -KILL "$render"
wait "$render" 2>/dev/null
"$tyndall" render showroom --size 80x80 --adaptive --spp 100000 -q -o adaptive.png --stats adaptive.json 2>err &
render=$!
wait_worked "$render" 1.5
kill -INT "$render"
wait "$render"
[ "$(json adaptive.json least_spp)" != "$(json adaptive.json most_spp)" ] || fail 'an adaptive render is even'
! grep -q samples err || fail "an adaptive render says: $(cat err)"

# SIGUSR1 writes the picture so far, and the render goes on: the end is that of a render which was not asked.
long=(cornell-box --size 64x64 --spp 4000)
"$tyndall" render "${long[@]}" -o asked.pfm -o asked.png --stats asked.json -q &
render=$!
for work in "$begun" "$later"; do
  wait_worked "$render" "$work"
  rm -f asked.*
  kill -USR1 "$render"
  for _ in $(seq 400); do [ -s asked.json ] && break || sleep 0.05; done
  for file in asked.pfm asked.png asked.json; do [ -s "$file" ] || fail "SIGUSR1: no $file"; done
  spp=$(json asked.json spp)
  [ "$spp" -ge 1 ] && [ "$spp" -lt 4000 ] || fail "SIGUSR1: $spp samples"
done
code=0
wait "$render" || code=$?
same 'exit code after SIGUSR1' "$code" 0
same 'samples after SIGUSR1' "$(json asked.json spp)" 4000
same 'hash after SIGUSR1' "$(json asked.json image_hash)" "$(image_hash "${long[@]}")"

# What was ignored at the start stays ignored: nohup, and "trap ''".
ignored=(HUP XCPU USR1 USR2 ALRM TERM)
(
  trap '' "${ignored[@]}"
  exec "$tyndall" render cornell-box --size 64x64 --spp 10000000 -o ignored.pfm --stats ignored.json -q
) &
render=$!
wait_worked "$render" "$begun"
for signal in "${ignored[@]}"; do kill -"$signal" "$render"; done
wait_worked "$render" "$later"
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
wait_worked "$render" "$begun"
kill -STOP "$render"
kill -TERM "$render"
kill -INT "$render"
kill -CONT "$render"
code=0
wait "$render" || code=$?
[ "$code" -eq 130 ] || [ "$code" -eq 143 ] || fail "two signals: exit code $code"

finish
