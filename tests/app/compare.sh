#!/usr/bin/env bash
# compare: the numbers, the checks and what it refuses.
. "$(dirname "$0")/_common.sh"

# pfm FILE WIDTH HEIGHT RED GREEN BLUE: an image of one colour.
pfm() {
  python3 -c '
import struct, sys
w, h = int(sys.argv[2]), int(sys.argv[3])
pixel = struct.pack("<3f", *map(float, sys.argv[4:7]))
open(sys.argv[1], "wb").write(b"PF\n%d %d\n-1.0\n" % (w, h) + pixel * (w * h))' "$@"
}
pfm grey.pfm 16 8 0.5 0.5 0.5
pfm red.pfm 16 8 0.6 0.5 0.5
pfm large.pfm 16 9 0.5 0.5 0.5
pfm broken.pfm 16 8 nan 0.5 0.5

expect 0 "$tyndall" compare red.pfm grey.pfm --json
cp out red.json
near() {
  python3 -c 'import sys; a, b = map(float, sys.argv[1:]); sys.exit(abs(a - b) > 1e-5 * abs(b))' "$(json red.json "$1")" "$2" ||
    fail "$1 is $(json red.json "$1"), expected $2"
}
near mse 0.00333333333
near rmse 0.0577350269
near relmse 0.0128205128 # 0.01 / 0.26 / 3
near psnr 28.870195      # sRGB of 0.6 and 0.5: 0.797738 and 0.735357
same 'means' "$(json red.json mean_reference)" '[0.5, 0.5, 0.5]'

expect 0 "$tyndall" compare red.pfm grey.pfm --heatmap heat.png
for name in MSE RMSE relMSE PSNR FLIP red green blue; do grep -q "$name" out || fail "no $name in the table"; done
[ ! -s err ] || fail "standard error: $(cat err)"
head -c 8 heat.png | grep -q PNG || fail 'no heat map'

expect 0 "$tyndall" compare grey.pfm grey.pfm --json --max-rmse 0 --max-relmse 0 --max-flip 0
cp out equal.json
same 'psnr of equal images' "$(json equal.json psnr)" null
same 'flip of equal images' "$(json equal.json flip)" 0.0

# A check that fails gives exit code 1, and the table is printed all the same.
expect 0 "$tyndall" compare red.pfm grey.pfm --max-rmse 0.058
expect 1 "$tyndall" compare red.pfm grey.pfm --max-rmse 0.057
grep -q RMSE out || fail 'no table with a failed check'
grep -q '^tyndall: check failed: RMSE' err || fail "the failed check is not named: $(cat err)"
expect 1 "$tyndall" compare red.pfm grey.pfm --max-relmse 0.0128
expect 1 "$tyndall" compare red.pfm grey.pfm --max-flip 0.001
expect 1 "$tyndall" compare broken.pfm grey.pfm --max-rmse 1000
expect 0 "$tyndall" compare broken.pfm grey.pfm --json
cp out broken.json
same 'mse with a NaN' "$(json broken.json mse)" null

# Images of different sizes give exit code 2, files that are no images 3.
expect 2 "$tyndall" compare large.pfm grey.pfm
complains 'large.pfm' '16x9' '16x8'
echo text >text.png
expect 3 "$tyndall" compare text.png grey.pfm
complains 'text.png'
expect 3 "$tyndall" compare red.pfm grey.pfm --heatmap nowhere/heat.png
complains 'nowhere'

finish
