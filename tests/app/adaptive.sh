#!/usr/bin/env bash
# Adaptive sampling from the command line: what it takes and says, and what it refuses.
. "$(dirname "$0")/_common.sh"

scene=(showroom --size 60x40)
expect 0 "$tyndall" render "${scene[@]}" --spp 40 --adaptive -q -o a.png -o a.pfm --stats a.json
same 'spp' "$(json a.json spp)" 40
same 'adaptive' "$(json a.json adaptive)" true
[ "$(json a.json samples)" -le $((60 * 40 * 40)) ] || fail "$(json a.json samples) samples are more than 40 a pixel"
[ "$(json a.json least_spp)" -lt 40 ] && [ "$(json a.json most_spp)" -gt 40 ] || fail "samples are even: $(cat a.json)"
hash=$(json a.json image_hash)

# The setting is the scene's: in the picture, in its normal form, and by --set.
same 'a picture opened again' "$(image_hash a.png)" "$hash"
expect 0 "$tyndall" convert a.png -o a-scene.json
grep -q '"adaptive": true' a-scene.json || fail 'the scene of the picture does not say how it was made'
same '--set' "$(image_hash "${scene[@]}" --spp 40 --set /render/adaptive=true)" "$hash"
same 'one thread' "$(image_hash "${scene[@]}" --spp 40 --adaptive -t 1)" "$hash"
expect 0 "$tyndall" render a.png --set /render/adaptive=false -q -o even.pfm --stats even.json
same 'even' "$(json even.json adaptive) $(json even.json least_spp) $(json even.json most_spp)" 'false 40 40'

if has_exr; then
  expect 0 "$tyndall" render "${scene[@]}" --spp 20 --adaptive -q -o a.exr
  cp a.exr going.exr
  expect 0 "$tyndall" render "${scene[@]}" --spp 40 --adaptive --resume -q -o going.exr --stats going.json
  same 'an adaptive render that goes on' "$(json going.json image_hash)" "$hash"
fi

# Ctrl-C: the picture so far, with the mean of its samples.
"$tyndall" render "${scene[@]}" --spp 10000000 --adaptive -o long.png --stats long.json -q &
render=$! code=0
wait_worked "$render" 2
kill -INT "$render"
wait "$render" || code=$?
same 'exit code after Ctrl-C' "$code" 130
spp=$(json long.json spp)
[ "$spp" -gt "$(json long.json least_spp)" ] && [ "$spp" -lt "$(json long.json most_spp)" ] || fail "$(cat long.json)"
expect 0 "$tyndall" convert long.png -o -
grep -q "\"spp\": $spp" out || fail "the picture does not say that it has $spp samples"

# A chart can compare it with even samples.
expect 0 "$tyndall" chart showroom --size 40x30 --budget 0.3 -q --method 'even=' --method 'adaptive=--adaptive' -o chart.svg
grep -q '^adaptive,16,' chart.csv || fail "no point of 16 samples: $(cat chart.csv)"

finish
