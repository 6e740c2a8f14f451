#!/usr/bin/env bash
# Films: frames with the bits of render, keys, numbered files and .y4m; what is there already stays, goes on or is refused.
. "$(dirname "$0")/_common.sh"

cat >film.json <<'END'
{ "tyndall": 1, "image": { "width": 24, "height": 16 }, "render": { "seed": 5 }, "background": [0.5, 0.7, 1],
  "camera": { "look_from": [0, 0, 5], "look_at": [0, 0, 0], "vfov": 40 },
  "animation": { "frames": 4, "curve": "linear", "keys": { "/materials/gold/fuzz": { "0": 0, "3": 0.3 } } },
  "materials": { "gold": { "type": "metal", "albedo": [0.8, 0.6, 0.2], "fuzz": 0.3 } },
  "objects": [{ "type": "sphere", "center": [0, 0, 0], "radius": 1, "material": "gold" }] }
END
film=(animate film.json --spp 4 -q)
hash_in() { python3 -c '
import json, sys
data = open(sys.argv[1], "rb").read()
at = data.index(b"image_hash")
print(json.loads("{\"" + data[at:data.index(b",", at)].decode() + "}")["image_hash"])' "$1"; }

# Frames are those of render with their values and seed, also by --frame; other commands ignore keys.
mkdir f
expect 0 "$tyndall" "${film[@]}" -o 'f/%04d.png'
same 'frames' "$(ls f | tr '\n' ' ')" '0000.png 0001.png 0002.png 0003.png '
for n in 0 1 2 3; do
  want=$(image_hash film.json --spp 4 --set /materials/gold/fuzz=0.$n --seed $((5 + n)))
  same "the bits of frame $n" "\"$(hash_in f/000$n.png)\"" "$want"
  same "the bits of --frame $n" "$(image_hash film.json --spp 4 --frame $n)" "$want"
done
same 'render ignores keys' "$(image_hash film.json --spp 4)" \
  "$(image_hash film.json --spp 4 --set '/animation={"frames": 1}')"
expect 0 "$tyndall" "${film[@]}" --seed-per-frame off -o 'off-%d.png'
same 'one seed' "\"$(hash_in off-2.png)\"" "$(image_hash film.json --spp 4 --set /materials/gold/fuzz=0.2)"
same 'a frame opens as a scene' "$(image_hash f/0002.png)" "\"$(hash_in f/0002.png)\""

# A second run keeps what is there; what is missing comes back to the same bits.
before=$(stat -c %z f/0001.png)
cp f/0002.png whole.png && rm f/0002.png
expect 0 "$tyndall" "${film[@]}" -o 'f/%04d.png' :: '3 of 4 frames'
same 'a frame that was there' "$(stat -c %z f/0001.png)" "$before"
cmp -s f/0002.png whole.png || fail 'a frame that was missing has other bytes'

# What does not fit is refused before the first sample, and --fresh replaces it.
refused() {
  local text=$1
  shift
  rm -f f/0003.png
  expect 2 "$tyndall" "$@" :: f/000 "$text" --fresh
  [ ! -e f/0003.png ] || fail "rendered although refused: $*"
}
refused '4 samples a pixel, expected 5' animate film.json --spp 5 -q -o 'f/%04d.png'
refused 'another scene' animate film.json --spp 4 --set /camera/vfov=41 -q -o 'f/%04d.png'
refused 'seed 5' animate film.json --spp 4 --seed 6 -q -o 'f/%04d.png'
refused 'exposure' animate film.json --spp 4 --exposure 1 -q -o 'f/%04d.png'
[ "$(json hashed.json isa)" = '"scalar"' ] || refused 'instruction set' animate film.json --spp 4 --isa scalar -q -o 'f/%04d.png'
refused 'filtered' animate film.json --spp 4 --denoise -q -o 'f/%04d.png'
cp f/0000.png good.png
head -c 200 good.png >f/0000.png
refused 'f/0000.png' animate film.json --spp 4 -q -o 'f/%04d.png'
expect 0 "$tyndall" animate film.json --spp 5 -q --fresh -o 'f/%04d.png'
same 'a replaced frame' "\"$(hash_in f/0001.png)\"" "$(image_hash film.json --spp 5 --frame 1)"

# A range; a turntable without keys; formats without settings and their list.
expect 0 "$tyndall" "${film[@]}" --frame-range 1:3 -o 'r%d.pfm'
same 'a range' "$(ls r*.pfm | tr '\n' ' ')" 'r1.pfm r2.pfm '
expect 0 "$tyndall" render film.json --spp 4 --frame 2 -q -o one.pfm
cmp -s one.pfm r2.pfm || fail 'a frame of a range has other bits'
[ "$(grep -c whole rframes.pfm.list)" = 2 ] || fail "the list says: $(cat rframes.pfm.list)"
rm r1.pfm
sed -i '/^2 whole/d' rframes.pfm.list # as if killed while frame 2 was written
echo cut >r2.pfm
expect 0 "$tyndall" "${film[@]}" --frame-range 1:3 -o 'r%d.pfm'
cmp -s one.pfm r2.pfm || fail 'a frame whose file was not whole is kept'
[ -s r1.pfm ] || fail 'a frame that was missing is not made'
expect 2 "$tyndall" "${film[@]}" --frame-range 1:3 --seed 9 -o 'r%d.pfm' :: r1.pfm rframes.pfm.list --fresh
rm rframes.pfm.list
expect 2 "$tyndall" "${film[@]}" --frame-range 1:3 -o 'r%d.pfm' :: r1.pfm --fresh
expect 0 "$tyndall" animate metal-spheres --size 16x9 --spp 1 --turntable --frames 3 -q -o 't%d.png'
[ "$(hash_in t0.png)" != "$(hash_in t1.png)" ] || fail 'the turntable does not turn'

# A video: goes on where it was cut, to the bytes of one run; on standard output, too.
expect 0 "$tyndall" "${film[@]}" -o film.y4m
cp film.y4m whole.y4m
same 'bytes of the video' "$(stat -c %s film.y4m)" $(($(head -1 film.y4m | wc -c) + 4 * (6 + 3 * 24 * 16)))
for size in 0 50 1000 1300 3000; do
  head -c $size whole.y4m >film.y4m
  expect 0 "$tyndall" "${film[@]}" -o film.y4m
  cmp -s film.y4m whole.y4m || fail "a video that was cut at $size bytes went on to other bytes"
done
"$tyndall" "${film[@]}" -o - >piped.y4m || fail 'a video on standard output'
cmp -s piped.y4m whole.y4m || fail 'a video on standard output has other bytes'
expect 2 "$tyndall" "${film[@]}" --seed 1 -o film.y4m :: film.y4m --fresh
cmp -s film.y4m whole.y4m || fail 'a refused video was changed'
expect 2 "$tyndall" "${film[@]}" --frame-range 0:2 -o film.y4m :: film.y4m '4 frames'

# A film in EXR gives its frames to a video without rendering them again.
if has_exr; then
  expect 0 "$tyndall" "${film[@]}" -o 'e%d.exr'
  expect 0 "$tyndall" "${film[@]}" -o 'e%d.exr' -o e.y4m
  cmp -s e.y4m whole.y4m || fail 'a video from films has other bytes'
fi
finish
