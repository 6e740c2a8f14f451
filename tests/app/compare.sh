#!/usr/bin/env bash
# compare: the numbers, the checks and what it refuses.
. "$(dirname "$0")/_common.sh"
. "$source_root/tests/app/_pfm.sh"
pfm grey.pfm 16 8 0.5 0.5 0.5
pfm red.pfm 16 8 0.6 0.5 0.5
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
same 'psnr of equal images' "$(json out psnr)" null
same 'flip of equal images' "$(json out flip)" 0.0

# A check that fails gives exit code 1, and the table is printed all the same.
expect 0 "$tyndall" compare red.pfm grey.pfm --max-rmse 0.058
expect 1 "$tyndall" compare red.pfm grey.pfm --max-rmse 0.057 :out RMSE :err '^tyndall: check failed: RMSE'
expect 1 "$tyndall" compare red.pfm grey.pfm --max-relmse 0.0128
expect 1 "$tyndall" compare red.pfm grey.pfm --max-flip 0.001
expect 1 "$tyndall" compare broken.pfm grey.pfm --max-rmse 1000
# What is not finite is equal to nothing: that needs no --max-....
expect 1 "$tyndall" compare broken.pfm grey.pfm --json
same 'mse with a NaN' "$(json out mse)" null

has_exr || finish

# EXR files of one display window are compared by position, over the pixels that both have; so is a region's picture of
# another format, which has the size of its data window.
render() { "$tyndall" render cornell-box --size 32x24 --spp 2 -q "$@" || fail "rendering $*"; }
render -o whole.exr -o whole.pfm
render --region 5,3,25,20 -o part.exr -o part.pfm
expect 0 "$tyndall" compare whole.pfm part.exr --max-rmse 0 --max-flip 0 --max-relmse 0 --heatmap region.png
expect 0 "$tyndall" compare part.exr whole.exr
grep -qx 'pixels   340 that both have, of 340 in the image and 768 in the reference' out || fail "no number of pixels: $(cat out)"
expect 0 "$tyndall" compare part.exr whole.exr --json
same 'pixels' '{"compared": 340, "image": 340, "reference": 768}' "$(json out pixels)"
same 'width' 20 "$(json out width)"
expect 0 "$tyndall" compare whole.exr whole.exr
! grep -q '^pixels' out || fail "a number of pixels where all were compared: $(cat out)"
expect 0 "$tyndall" compare part.exr --baseline kept --update
cp part.exr kept/whole.exr
expect 0 "$tyndall" compare whole.exr --baseline kept :out 'ok .*pixels: 340 that both have'

# One layer of an EXR, wherever a picture is named.
expect 0 "$tyndall" compare whole.exr:Albedo whole.exr --json
same 'blocks of a layer' '{"compared": 768, "image": 768, "reference": 768}' "$(json out pixels)"
! grep -q blocks out || fail 'the noise of a film is not that of a layer'
expect 0 "$tyndall" compare whole.exr:Albedo.R part.exr:Albedo.R --max-rmse 0
cp whole.exr 'a:b.exr'
expect 0 "$tyndall" compare a:b.exr whole.exr --max-rmse 0
expect 0 "$tyndall" compare a:b.exr:Albedo whole.exr:Albedo --max-rmse 0 --heatmap layer.png
expect 0 "$tyndall" chart cornell-box --size 32x24 --budget 0.2 --reference whole.exr:Albedo -q -o layer.svg
expect 0 "$tyndall" compare whole.exr:Albedo --baseline kept --update
expect 0 "$tyndall" compare whole.exr:Albedo --baseline kept :out '^ok *whole.exr:Albedo'

finish
