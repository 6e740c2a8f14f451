#!/usr/bin/env bash
# Shards of samples, merged in any order, give the picture of one render; so does a render that goes on.
. "$(dirname "$0")/_common.sh"

has_exr || finish

scene=(cornell-smoke --size 32x24)
whole=$(image_hash "${scene[@]}" --spp 13)
shard() { expect 0 "$tyndall" render "${scene[@]}" --samples "$1" -o "$2" -q; }
shard 0:4 a.exr
shard 4:9 b.exr
shard 9:13 c.exr

expect 0 "$tyndall" merge c.exr a.exr b.exr -o all.exr -o all.pfm -o all.png
expect 0 "$tyndall" render "${scene[@]}" --spp 13 -q -o one.pfm -o one.exr
cmp -s all.pfm one.pfm || fail 'merged shards differ from one render'
expect 0 "$tyndall" render all.png -q -o again.pfm --stats again.json
same 'a merged image opened again' "$(json again.json image_hash)" "$whole"
same 'its samples' "$(json again.json spp)" 13

# Parts of several instruction sets are added, which is said; the sum says which they are, and nothing goes on from it.
if "$tyndall" render "${scene[@]}" --spp 1 --isa sse4 -q -o probe.pfm 2>probe.err; then
  expect 0 "$tyndall" render "${scene[@]}" --samples 0:4 --isa scalar -q -o scalar.exr
  expect 0 "$tyndall" render "${scene[@]}" --samples 4:9 --isa sse4 -q -o sse4.exr
  expect 0 "$tyndall" merge sse4.exr scalar.exr -o several.exr :: 'several: scalar, sse4'
  expect 0 "$tyndall" render "${scene[@]}" --samples 9:13 --isa scalar -q -o rest.exr
  expect 0 "$tyndall" merge several.exr rest.exr -o several.exr.exr :: 'several: scalar, sse4'
  expect 2 "$tyndall" render "${scene[@]}" --spp 20 --isa scalar --resume -q -o several.exr
  complains several.exr 'instruction set several: scalar, sse4' 'expected scalar'
fi

# A render that is continued.
expect 0 "$tyndall" render "${scene[@]}" --spp 5 -q -o going.exr
expect 0 "$tyndall" render "${scene[@]}" --spp 13 --resume -q -o going.exr --stats going.json
same 'a render that goes on' "$(json going.json image_hash)" "$whole"
same 'samples' "$(json going.json samples)" $((13 * 32 * 24))
python3 -c 'import sys; sys.exit(not 0 < int(sys.argv[1]) < int(sys.argv[2]))' "$(json going.json rays)" \
  "$(json hashed.json rays)" || fail 'going on traces no fewer rays'
[ ! -s err ] || fail "a render that goes on says: $(cat err)"
expect 0 "$tyndall" render "${scene[@]}" --spp 2 --resume -q -o going.exr --stats going.json
complains '--resume' '13 samples a pixel' 'more than the 2 asked for'
same 'enough samples already' "$(json going.json image_hash)" "$whole"

# In scenes with chains, films made with and without chains must not be mixed: each film file says how it was made.
balls=(stress-caustic-glass --size 16x12 -q)
expect 0 "$tyndall" render "${balls[@]}" --samples 0:2 -o chains.exr
expect 0 "$tyndall" render "${balls[@]}" --spp 4 --resume -o chains.exr
expect 0 "$tyndall" render "${scene[@]}" --samples 0:9 --caustics scatter -q -o plain.exr
expect 0 "$tyndall" merge plain.exr c.exr -o plain.pfm # no chains here either way
cmp -s plain.pfm one.pfm || fail 'a scene without chains differs by --caustics'

# Chains are a part of mis: asked for with another integrator they are ignored, and that is said.
expect 0 "$tyndall" render "${balls[@]}" --spp 1 --integrator path --caustics chains -o path.pfm
complains '--caustics chains' 'ignored' 'path'
expect 0 "$tyndall" render "${balls[@]}" --spp 1 --integrator path -o same.pfm :quiet
cmp -s path.pfm same.pfm || fail '--caustics chains changes what integrator path renders'

# Adaptive renders are no ranges of samples; a sum that cannot be written is a failure.
expect 0 "$tyndall" render cornell-box --size 16x16 --spp 8 --adaptive -q -o adaptive.exr
expect 2 "$tyndall" merge adaptive.exr -o adaptive.pfm :: 'adaptive'
ln -s /dev/full full.pfm
expect 3 "$tyndall" merge a.exr b.exr c.exr -o full.pfm :: 'full.pfm'

finish
