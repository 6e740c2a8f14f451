#!/usr/bin/env bash
# tyndall verify: known answers pass on every instruction set, slips and wrong tables fail, names choose.
. "$(dirname "$0")/_common.sh"

quick=(furnace/lambertian furnace/glass furnace/hollow fuzzy-ball/fuzz1-b0.99 coloured-glass/n1.5-density1-b0.5
  smoke-ball/inside-density1 square-lamp/corner-h1 small-lamp motion)
for isa in scalar sse4 avx2 avx512 neon; do
  "$tyndall" render cornell-box --size 8x8 --spp 1 -q -o probe.pfm --isa $isa 2>probe.err || continue
  expect 0 "$tyndall" verify "${quick[@]}" --isa $isa :out '0 rejected'
done

# Each kind of answer by the best instruction set.
expect 0 "$tyndall" verify plate/reflected-n2.417-80 plate/transmitted-n1.5-60 coloured-glass/n2-density1-b0.9 \
  smoke-ball/density1-b0.6 fog-ball/depth2-albedo0.9-b0.6 fog-layer/reflected-depth1-albedo0.9-60deg \
  thick-fog/density1000-albedo0.9-60deg mcml/thin-transmitted cornell-lamp square-lamp/corner-h1- ball-lamp/d2-60deg \
  ball-lamp/d2-45deg-nee integrating-sphere/albedo0.95- integrating-sphere/albedo0.2 rainbow hollow-ball fuzzy-ball/fuzz0.3 \
  defocus/before defocus/close-

# The results as a table and as JSON. Light paths alone are ended by smoke at random; mis weighs them, without noise.
expect 0 "$tyndall" verify smoke-box plate/reflected-n1.5-60 --integrator path
grep -q '^  plate/reflected-n1.5-60deg  *0.1637675 ' out || fail "no row: $(cat out)"
grep -q 'Born & Wolf' out || fail "no source: $(cat out)"
grep -q 'z-scores of 9 cases: mean square' out || fail "no sum: $(cat out)"
expect 0 "$tyndall" verify smoke-box plate/reflected-n1.5-60 --json --seed 5
same passed "$(json out passed)" true
same count "$(json out cases | tr '{' '\n' | grep -c '"verdict": "ok"')" 9

# The books' approximation of Fresnel's equations is wrong, and a depth that cuts paths is seen.
expect 1 "$tyndall" verify plate/reflected-n1.5-60 --fresnel schlick :out 'FAIL'
expect 1 "$tyndall" verify integrating-sphere/albedo0.8 --max-depth 3
expect 0 "$tyndall" verify furnace/glass --fresnel schlick # all of the light is still there

# Lights that chance does not find are left out without light sampling.
expect 0 "$tyndall" verify small-lamp --integrator path :out 'skipped'

# Ctrl-C, once: what was done so far is shown.
"$tyndall" verify furnace/glass fog-layer/transmitted-depth16 --thorough -q >out 2>err </dev/null &
verify=$! code=0
wait_worked "$verify" 2
kill -INT "$verify"
wait "$verify" || code=$?
same 'exit code after Ctrl-C' "$code" 130
grep -q 'furnace/glass ' out || fail "nothing shown: $(cat out)"

# Another table: one wrong number is found, alone, and a broken table is refused.
cp -r "$source_root/assets" assets
sed -i 's/"expected": 0.1637675372898316/"expected": 0.166/' assets/verify/cases.json
cmp -s assets/verify/cases.json "$source_root/assets/verify/cases.json" && fail 'nothing doctored'
expect 1 env TYNDALL_ASSETS="$PWD/assets" "$tyndall" verify plate
same failed "$(grep -c '^  .*FAIL' out)" 1
expect 2 env TYNDALL_ASSETS="$PWD/assets" "$tyndall" verify plate/none
echo '{ "groups": [{ "name": "a", "scene": "plate.json", "source": "b", "cases": [{ "name": "c" }] }] }' \
  >assets/verify/cases.json
expect 2 env TYNDALL_ASSETS="$PWD/assets" "$tyndall" verify :: 'cases.json' '/groups/0/cases/0' 'expected'
sed -i 's/"name": "c"/"name": "c", "expected": 1/; s/plate.json/missing.json/' assets/verify/cases.json
expect 2 env TYNDALL_ASSETS="$PWD/assets" "$tyndall" verify :: 'missing.json'
rm -r assets

finish
