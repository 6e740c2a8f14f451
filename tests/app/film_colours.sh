#!/usr/bin/env bash
# Films as FFmpeg reads them: the colours of the frames, and of the file that the page's command makes.
. "$(dirname "$0")/_common.sh"
command -v ffmpeg >/dev/null && command -v ffprobe >/dev/null || { echo 'skipped: ffmpeg is not installed' && exit 77; }

cat >film.json <<'END'
{ "tyndall": 1, "background": [0, 0, 0], "camera": { "look_from": [0, 0, 4], "look_at": [0, 0, 0], "vfov": 40 },
  "animation": { "frames": 4, "keys": { "/objects/0/v": { "0": [0, 2, 0], "3": [0, 1.5, 0] } } },
  "materials": { "red": { "type": "light", "radiance": [1, 0, 0] }, "green": { "type": "light", "radiance": [0, 1, 0] },
                 "blue": { "type": "light", "radiance": [0.05, 0.3, 0.6] }, "brown": { "type": "light", "radiance": [0.5, 0.2, 0.05] } },
  "objects": [
    { "type": "quad", "corner": [-3, 0, 0], "u": [3, 0, 0], "v": [0, 2, 0], "material": "red" },
    { "type": "quad", "corner": [0, 0, 0], "u": [3, 0, 0], "v": [0, 2, 0], "material": "green" },
    { "type": "quad", "corner": [-3, -2, 0], "u": [3, 0, 0], "v": [0, 2, 0], "material": "blue" },
    { "type": "quad", "corner": [0, -2, 0], "u": [3, 0, 0], "v": [0, 2, 0], "material": "brown" } ] }
END
cat >differ.py <<'END'
"""differ.py WIDTH HEIGHT CUT FRAMES RAW MARGIN: the largest difference of RAW, frames of RGB whose size is a multiple of CUT,
from f0.ppm, f1.ppm, ..., in pixels whose neighbours up to MARGIN away have their colour."""
import sys
width, height, cut, frames, margin = (int(sys.argv[k]) for k in (1, 2, 3, 4, 6))
w, h = width // cut * cut, height // cut * cut
raw = open(sys.argv[5], "rb").read()
assert len(raw) == frames * w * h * 3, (len(raw), frames, w, h)
worst = 0
for n in range(frames):
    rgb = open(f"f{n}.ppm", "rb").read()[-3 * width * height:]
    at = lambda x, y: rgb[3 * (y * width + x):3 * (y * width + x) + 3]
    for y in range(h):
        for x in range(w):
            columns = range(max(x - margin, 0), min(x + margin + 1, width))
            rows = range(max(y - margin, 0), min(y + margin + 1, height))
            start = 3 * ((n * h + y) * w + x)
            if all(at(i, k) == at(x, y) for i in columns for k in rows):
                worst = max(worst, *(abs(a - b) for a, b in zip(at(x, y), raw[start:start + 3])))
print(worst)
END

page=$("$tyndall" animate --help | sed -n '/-o - |$/,/film.mp4/p')
[ -n "$page" ] || fail 'animate --help shows no command for ffmpeg'
set -f
for word in $page; do # the page's is the same
  [ "$word" = '\' ] || grep -o '^tyndall animate.*film.mp4' "$source_root/app/cli/README.md" | grep -qF -- "$word" || fail "the page lacks $word"
done
set +f
mkdir bin
printf '#!/bin/sh\nexec "%s" "$@" -q --spp 1 --size $size\n' "$tyndall" >bin/tyndall && chmod +x bin/tyndall
for size in 64x48 65x47; do
  export size
  expect 0 "$tyndall" animate film.json --spp 1 --size $size -q --fresh -o 'f%d.ppm'
  "$tyndall" animate film.json --spp 1 --size $size -q -o - | ffmpeg -v error -i - -f rawvideo -pix_fmt rgb24 -y raw || fail 'ffmpeg reads no film'
  found=$(python3 differ.py "${size%x*}" "${size#*x}" 1 4 raw 0)
  [ "${found:-9}" -le 2 ] || fail "$size: pixels of the film are off by $found"
  (PATH=$PWD/bin:$PATH && rm -f film.mp4 && eval "$page") >log 2>&1 || fail "the page's command: $(tail -3 log)"
  told=$(ffprobe -v error -show_streams film.mp4)
  for word in codec_name=h264 pix_fmt=yuv420p color_space=smpte170m color_range=tv color_primaries=bt709 color_transfer=iec61966-2-1; do
    grep -q "^$word\$" <<<"$told" || fail "ffprobe does not say $word"
  done
  ffmpeg -v error -i film.mp4 -f rawvideo -pix_fmt rgb24 -y raw
  found=$(python3 differ.py "${size%x*}" "${size#*x}" 2 4 raw 6)
  [ "${found:-9}" -le 3 ] || fail "$size: even areas of film.mp4 are off by $found"
done
finish
