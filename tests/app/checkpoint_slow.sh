#!/usr/bin/env bash
# Checkpoints, and going on from them: a render that was killed goes on by the same command to the same bits.
. "$(dirname "$0")/_common.sh"
has_exr || finish

# killed COMMAND...: starts it with checkpoints ten times a second, and kills it after the second of its checkpoints. On
# one thread, so that no machine is through before.
killed() {
  rm -f k.exr
  "$tyndall" "$@" --checkpoint 0.1 -t 1 -q -o k.exr 2>err &
  local render=$! first=
  for _ in $(seq 1200); do
    local now
    now=$(stat -c %z k.exr 2>/dev/null)
    [ -n "$now" ] && [ -n "$first" ] && [ "$now" != "$first" ] && break
    first=${first:-$now}
    sleep 0.05
  done
  kill -KILL "$render" 2>/dev/null || fail "the command ended too early: $(cat err)"
  wait "$render" 2>/dev/null
  [ -s k.exr ] || fail "no checkpoint: $*"
}

box=(render cornell-box --size 64x64)
whole=$(image_hash "${box[@]:1}" --spp 3000)
killed "${box[@]}" --spp 3000
grep -aq unfinished k.exr || fail 'a checkpoint does not say that it is unfinished'
cp k.exr killed.exr

# What does not fit is refused, with the difference and the way out, and left as it is.
refused() {
  local text=$1
  shift
  expect 2 "$tyndall" "$@" -q -o k.exr :: k.exr "$text" --fresh
  cmp -s k.exr killed.exr || fail "an unfinished film was replaced: $*"
}
refused 'seed 0' "${box[@]}" --spp 3000 --seed 3
refused 'sampler sobol' "${box[@]}" --spp 3000 --sampler random
refused '64x64' render cornell-box --size 64x63 --spp 3000
refused 'another scene' "${box[@]}" --spp 3000 --set /camera/vfov=30
refused 'region' "${box[@]}" --spp 3000 --region 0,0,64,63
refused 'from 0' "${box[@]}" --samples 4:3000
refused 'instruction set' "${box[@]}" --spp 3000 --isa scalar
refused 'samples up to' "${box[@]}" --samples 0:1
expect 2 "$tyndall" "${box[@]}" --spp 3000 --resume --isa scalar -q -o k.exr :: 'instruction set' '--fresh'

# Nor is one in a further output, which no render goes on with, nor where the output is to hold no film.
refused 'first .exr output' "${box[@]}" --spp 3000 -o first.exr
refused 'first .exr output' "${box[@]}" --spp 3000 --exr-film no
[ ! -e first.exr ] || fail 'a refused render wrote its first output'
cp killed.exr first.exr
expect 0 "$tyndall" "${box[@]}" --spp 3000 -q -o first.exr -o k.exr --stats k.json :: 'goes on from'
same 'a render with two films that went on' "$(json k.json image_hash)" "$whole"
cmp -s first.exr k.exr || fail 'its two films differ'
cp killed.exr k.exr
rm first.exr

# The same command goes on by itself, and says so; what fewer samples ask for is written as it is.
expect 0 "$tyndall" "${box[@]}" --spp 1 -q -o k.exr --stats k.json
sed -i '/interrupted within a pass$/d' err # as the kill may have been
complains 'more than the 1 asked for'
cp killed.exr k.exr
expect 0 "$tyndall" "${box[@]}" --spp 3000 -q -o k.exr -o k.pfm --stats k.json :: 'goes on from'
same 'a killed render that went on' "$(json k.json image_hash)" "$whole"
same 'its samples' "$(json k.json samples)" $((64 * 64 * 3000))

# Complete: nothing is rendered. Without other outputs not even the file is touched.
before=$(stat -c %z k.exr)
expect 0 "$tyndall" "${box[@]}" --spp 3000 -q -o k.exr :: 'already complete: 3000 samples a pixel'
same 'the complete file' "$(stat -c %z k.exr)" "$before"
rm k.pfm
expect 0 "$tyndall" "${box[@]}" --spp 3000 -q -o k.exr -o k.pfm --stats again.json :: 'already complete'
[ -s k.pfm ] || fail 'an output that was missing is not written'
same 'rays of a complete render' "$(json again.json rays)" 0
same 'its hash' "$(json again.json image_hash)" "$whole"

# Any other finished film is replaced, as any other file is; --resume goes on from it; --fresh starts over.
expect 0 "$tyndall" "${box[@]}" --spp 3 -q -o k.exr --stats k.json
grep -q k.exr err && fail "replacing a finished film says: $(cat err)"
same 'samples of a new film' "$(json k.json spp) $(json k.json samples)" "3 $((64 * 64 * 3))"
expect 0 "$tyndall" "${box[@]}" --spp 7 --resume -q -o k.exr --stats k.json
same 'a finished film that went on' "$(json k.json image_hash)" "$(image_hash "${box[@]:1}" --spp 7)"
expect 0 "$tyndall" "${box[@]}" --spp 7 --fresh -q -o k.exr --stats k.json
[ "$(json k.json rays)" != 0 ] || fail '--fresh does not start over'
cp killed.exr k.exr
expect 0 "$tyndall" "${box[@]}" --spp 7 --seed 3 --fresh -q -o k.exr
echo text >k.exr
expect 0 "$tyndall" "${box[@]}" --spp 2 -q -o k.exr
echo text >text.exr
expect 2 "$tyndall" "${box[@]}" --spp 2 --resume -q -o text.exr :: text.exr 'no film'

# Shards and adaptive renders go on in the same way.
killed "${box[@]}" --samples 5:3000
expect 0 "$tyndall" "${box[@]}" --samples 5:3000 -q -o k.exr --stats k.json :: 'goes on from'
expect 0 "$tyndall" "${box[@]}" --samples 5:3000 -q -o one.exr
expect 0 "$tyndall" compare k.exr one.exr --max-rmse 0
room=(render showroom --size 64x48 --adaptive --spp 1500)
killed "${room[@]}"
expect 0 "$tyndall" "${room[@]}" -q -o k.exr --stats k.json :: 'goes on from'
same 'an adaptive render that went on' "$(json k.json image_hash)" "$(image_hash "${room[@]:1}")"
same 'its samples' "$(json k.json samples)" "$(json hashed.json samples)"

# A film from before films had a format version, of another version of the program.
cp "$source_root/tests/image/film_of_format_0.exr" old.exr
old=(render cornell-box --size 8x6 --isa scalar)
expect 0 "$tyndall" "${old[@]}" --spp 2 -q -o old.exr
grep -q old.exr err && fail "replacing an old film says: $(cat err)"
cp "$source_root/tests/image/film_of_format_0.exr" old.exr
expect 2 "$tyndall" "${old[@]}" --spp 5 --resume -q -o old.exr :: old.exr 'film of version 0.1.0' --fresh
cmp -s old.exr "$source_root/tests/image/film_of_format_0.exr" || fail 'a film of another version was changed'

# A named pipe gets the image once, at the end, and no checkpoints.
mkfifo pipe.exr
cat pipe.exr >piped.exr &
reader=$!
expect 0 "$tyndall" "${box[@]}" --spp 100 -q -o pipe.exr --stats piped.json
wait "$reader"
expect 0 "$tyndall" compare piped.exr piped.exr --max-rmse 0

# Without checkpoints there is nothing before the end.
"$tyndall" "${box[@]}" --spp 10000000 --checkpoint 0 -q -o none.exr &
render=$!
wait_worked "$render" 0.5
[ ! -e none.exr ] || fail '--checkpoint 0 writes'
kill -KILL "$render"
wait "$render" 2>/dev/null
finish
