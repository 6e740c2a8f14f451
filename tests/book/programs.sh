#!/usr/bin/env bash
# Programs of readers of the books, all editions, in place of scenes.
. "$(dirname "$0")/../app/_common.sh"
programs=$source_root/tests/book
mkdir temporary
export TMPDIR=$PWD/temporary  # of this test alone: others compile at the same time

# Each program's picture is that of the scene that it describes, bit for bit. Its folder stays as it is.
cp -r "$programs" copy
before=$(cd copy && find . -type f -exec cksum {} + | sort)
for edition in newest third first; do
  expect 0 "$tyndall" render "copy/$edition/main.cc" -q -o hashed.pfm --stats hashed.json
  mv err told.$edition
  same "$edition" "$(json hashed.json image_hash)" "$(image_hash "copy/$edition/scene.json")"
done
same "files beside the programs" "$(cd copy && find . -type f -exec cksum {} + | sort)" "$before"
same 'temporary folders left' "$(find temporary -mindepth 1 | wc -l)" 0

# What was taken from a loop is told in one line, of the first edition even where all went through 8 bits.
grep -qF 'third/main.cc: from the loop in main(): 48 x 36, 5 samples, depth 9, sky (0.1, 0.2, 0.4)' told.third || fail "$(cat told.third)"
grep -qF 'from the loop in main(): 40 x 30, 3 samples, depth 20, sky (1, 0.9, 0.8) to (0.2, 0.4, 0.6)' told.first || fail "$(cat told.first)"
! grep -q 'from the loop' told.newest || fail "of a program with camera::render() something is told: $(cat told.newest)"

# Options act on it as on any scene; the picture carries the scene.
expect 0 "$tyndall" render copy/newest/main.cc --size 8x6 --set /camera/vfov=30 --max-depth 2 --spp 1 -q -o small.png
expect 0 "$tyndall" convert small.png -o small.json
same 'options' "$(json small.json image) $(json small.json render)" '{"width": 8, "height": 6} {"max_depth": 2, "spp": 1}'
grep -q '"vfov": 30' small.json || fail '--set'

finish
