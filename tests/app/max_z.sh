#!/usr/bin/env bash
# compare --max-z: another seed is the same picture, a small change is not; baselines, reports, pictures without noise.
. "$(dirname "$0")/_common.sh"
. "$source_root/tests/app/_pfm.sh"
pfm a.pfm 32 16 0.5 0.5 0.5
pfm b.pfm 32 16 0.5 0.51 0.5
pfm a.error.pfm 32 16 0.05 0.05 0.05
# The difference of 0.01 has an error of 0.05 sqrt(2 / 512) = 0.0031: 3.2 of them, and more with less noise.
pfm b.error.pfm 32 16 0.05 0.05 0.05
expect 0 "$tyndall" compare a.pfm b.pfm --max-z 4
for file in a b; do pfm $file.error.pfm 32 16 0.02 0.02 0.02; done
expect 1 "$tyndall" compare a.pfm b.pfm --max-z 4
grep -q '^tyndall: check failed: the mean of green differs by -0.01 +- 0.0012: ' err || fail "the mean: $(cat err)"
has_exr || finish

mkdir new other
render() { "$tyndall" render cover --size 96x64 --spp 64 -q "$@" || fail "rendering $*"; }
render --seed 1 -o new/cover.exr -o new/cover.png
render --seed 2 -o other/cover.exr
expect 0 "$tyndall" compare other/cover.exr new/cover.exr --max-z 4 --json
cp out noise.json
[ ! -s err ] || fail "standard error: $(cat err)"
python3 - <<'PY' || fail "the figures: $(cat noise.json)"
import json
noise = json.load(open("noise.json"))["noise"]
assert noise["z"] == max(*noise["mean_z"], noise["block_z"], noise["outlier_z"]) < 4 and noise["blocks"] == 24
assert noise["cannot_tell"] == 0 and all(0 < e < 0.01 for e in noise["error"])
PY
expect 0 "$tyndall" compare new/cover.exr new/cover.exr --max-z 0.001

# A change; also against more samples, a part, and a picture without its film.
render --seed 4 --set /camera/vfov=21 -o changed.exr
render --seed 5 --spp 256 -o better.exr
render --seed 6 --exr-film no -o bare.exr
render --seed 7 --region 20,10,70,50 -o part.exr
for file in better bare part; do expect 0 "$tyndall" compare "$file.exr" new/cover.exr --max-z 4; done
for file in better bare part; do
  expect 1 "$tyndall" compare "$file.exr" changed.exr --max-z 4 :err '^tyndall: check failed: .* standard errors'
done
expect 0 "$tyndall" compare bare.exr new/cover.exr --json --max-z 4
python3 - <<'PY' || fail "the layer Variance says another noise than the film: $(cat out)"
import json
layer, film = (json.load(open(name))["noise"]["error"] for name in ("out", "noise.json"))
assert all(0.9 < a / b < 1.1 for a, b in zip(layer, film))
PY

# A lamp three times as bright that few paths meet, and one that is off.
lamp() { "$tyndall" render cornell-box --integrator path --size 32x32 --spp 2 -q --set /camera/vfov=20 "$@" || fail "lamp $*"; }
lamp --seed 1 -o lamp.exr
lamp --seed 2 --set /materials/lamp/radiance=[45,45,45] -o brighter.exr
expect 1 "$tyndall" compare lamp.exr brighter.exr --max-z 4
grep -q 'too few samples to tell: no block with light, of 4, has .*; about [0-9]* a pixel would do' err || fail "$(cat err)"
lamp --set /materials/lamp/radiance=[0,0,0] -o off.exr
expect 0 "$tyndall" compare off.exr off.exr --max-z 4 :out 'nothing is lit in either'

# Baselines: what FLIP calls a failure is noise.
rm new/cover.png
expect 0 "$tyndall" compare new --baseline kept --update --max-z 4
grep -q '"max_z": 4.0' kept/tolerances.json || fail "tolerances: $(cat kept/tolerances.json)"
expect 1 "$tyndall" compare other/cover.exr --baseline kept --max-flip 0.02
expect 0 "$tyndall" compare other --baseline kept --report report.html --junit junit.xml :out '^ok .*noise: means '
grep -q 'z of the blocks' report.html && grep -q '"block_z": [0-9]' report.json || fail 'no noise in the report'
cp changed.exr other/cover.exr
expect 1 "$tyndall" compare other --baseline kept --report report.html --junit junit.xml
grep -q 'standard errors' report.html && grep -q 'failures="1"' junit.xml || fail 'the reports do not say it'
finish
