#!/usr/bin/env bash
# The program that the README's picture was made with: by its own headers, and as a scene, with the same balls.
. "$(dirname "$0")/_program.sh"

cp -r "$source_root/assets/examples/book" example && cd example || exit 1
sed 's/image_width = 400/image_width = 40/; s/samples_per_pixel = 100/samples_per_pixel = 400/' main.cc >small.cc
expect 0 "${CXX:-c++}" -O2 -std=c++17 -Wall -Wextra -Werror -Itracer small.cc -o plain
./plain >plain.ppm || fail 'the tracer'
expect 0 "$tyndall" render small.cc -Itracer -q --gamma2 -o tyndall.ppm
# Where nothing is dark or clipped, the means of the tracer's bytes are Tyndall's: the red ball, its left half.
mean() { # FILE: of a region
  python3 -c '
import sys
words = open(sys.argv[1], "rb").read().split(None, 4)
body = [int(w) for w in words[4].split()] if words[0] == b"P3" else list(words[4])
pixels = [body[3 * (y * 40 + x)] for y in range(7, 16) for x in range(1, 8)]
print(round(sum(pixels) / len(pixels)))' "$1"
}
plain=$(mean plain.ppm) ours=$(mean tyndall.ppm)
[ $((plain - ours)) -ge -4 ] && [ $((plain - ours)) -le 4 ] || fail "the ball is $plain by the tracer and $ours by Tyndall"

finish
