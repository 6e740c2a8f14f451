#!/usr/bin/env bash
# Films that were killed at any moment go on by the same command to the same bits, also within a frame.
. "$(dirname "$0")/_common.sh"
has_exr || finish

cat >film.json <<'END'
{ "tyndall": 1, "image": { "width": 24, "height": 16 }, "render": { "seed": 5 }, "background": [0.5, 0.7, 1],
  "camera": { "look_from": [0, 0, 5], "look_at": [0, 0, 0], "vfov": 40 },
  "animation": { "frames": 4, "curve": "linear", "keys": { "/materials/gold/fuzz": { "0": 0, "3": 0.3 } } },
  "materials": { "gold": { "type": "metal", "albedo": [0.8, 0.6, 0.2], "fuzz": 0.3 } },
  "objects": [{ "type": "sphere", "center": [0, 0, 0], "radius": 1, "material": "gold" }] }
END

expect 0 "$tyndall" animate film.json --spp 3000 -q -o 'w%d.exr' -o whole.y4m
for delay in 0.05 0.3 0.7 1.5 3; do
  rm -f k*.exr k.y4m
  "$tyndall" animate film.json --spp 3000 -t 1 --checkpoint 0.02 -q -o 'k%d.exr' -o k.y4m 2>err &
  render=$!
  sleep "$delay"
  kill -KILL "$render" 2>/dev/null
  wait "$render" 2>/dev/null
  expect 0 "$tyndall" animate film.json --spp 3000 -q -o 'k%d.exr' -o k.y4m
  for n in 0 1 2 3; do
    expect 0 "$tyndall" compare w$n.exr k$n.exr --max-rmse 0
  done
  cmp -s whole.y4m k.y4m || fail "a video that was killed after $delay s went on to other bytes"
done
# A signal within a frame keeps its film, and writes no picture that is not whole.
rm -f k*.exr
"$tyndall" animate film.json --spp 1000000 -t 1 -q -o 'k%d.exr' -o 'k%d.png' 2>err &
render=$!
wait_worked "$render" 0.5
kill -INT "$render"
wait "$render"
same 'the exit code of an interrupted film' "$?" 130
[ -s k0.exr ] && [ ! -e k0.png ] || fail "an interrupted film left: $(ls k*)"
rm -f .k*.tmp* ./*.tmp-*
finish
