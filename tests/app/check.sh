#!/usr/bin/env bash
# compare with a scene in place of a picture: what it answers, in words and JSON, and what it refuses.
. "$(dirname "$0")/_common.sh"

found() { python3 -c 'import json, sys; print(json.dumps(json.load(open(sys.argv[1]))["verdict"][sys.argv[2]]))' "$@"; }

# A right picture, as the books' programs write it.
"$tyndall" render metal-spheres --size 64x36 --spp 64 --seed 7 --gamma2 -o right.ppm -q || fail 'rendering'
expect 0 "$tyndall" compare right.ppm metal-spheres --time 4 :out '^check    the pictures agree within the noise'
grep -q 'gamma 2' out || fail "the curve is not told: $(cat out)"
grep -q '^RMSE' out || fail "no numbers: $(cat out)"
grep -q '^tyndall: right.ppm: .*gamma 2' err || fail "the way of reading is not told: $(cat err)"
# An sRGB picture is right, too; numbers are those of any comparison, and checks work as ever.
"$tyndall" render metal-spheres --size 64x36 --spp 64 --seed 7 -o right.png -o right.pfm -q || fail 'rendering'
expect 0 "$tyndall" compare right.png metal-spheres --time 4 --max-flip 0.2 --json
same 'agreement' "$(found out agrees)" true
same 'no explanation' "$(found out explanation)" null
expect 1 "$tyndall" compare right.png metal-spheres --time 1 --max-rmse 0.00001 :out '^check  '
expect 0 "$tyndall" compare right.pfm metal-spheres --time 4 :out 'agree within the noise'
# From standard input, and a scene's file.
"$tyndall" convert metal-spheres -o scene.json
expect 0 bash -c "'$tyndall' compare - scene.json --time 4 <right.ppm" :out 'agree within the noise'
expect 0 bash -c "cat right.ppm | '$tyndall' compare - scene.json --time 4" :out 'agree within the noise'

# The same picture with another fault: the sky's colours. Its objects are told, and no mistake that is none.
"$tyndall" render metal-spheres --size 64x36 --spp 64 --set '/background/top=[1,0.2,0.1]' --gamma2 -o pink.ppm -q
expect 0 "$tyndall" compare pink.ppm metal-spheres --time 4 --json
same 'agreement of another sky' "$(found out agrees)" false
same 'explanation of another sky' "$(found out explanation)" null
expect 0 "$tyndall" compare pink.ppm metal-spheres --time 4 :out '^object   the sky: '

# Pictures are pictures, also those that carry a scene: two of them are compared as ever.
expect 0 "$tyndall" compare right.png right.png
! grep -q '^check  ' out || fail "two pictures were taken for a scene: $(cat out)"
# What P3 says outside of its range is told.
{ printf 'P3\n64 36\n255\n'; for _ in $(seq 2303); do printf '128 160 255 '; done; printf '%s\n' '-2147483648 0 300'; } >range.ppm
expect 0 "$tyndall" compare range.ppm metal-spheres --time 1 :err 'range.ppm: 2 of 6912 numbers .*x 63, y 35'
finish
