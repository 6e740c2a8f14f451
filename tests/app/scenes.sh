#!/usr/bin/env bash
# scenes, inspect and convert.
. "$(dirname "$0")/_common.sh"

expect 0 "$tyndall" scenes
for scene in showroom metal-spheres glass-spheres hollow-glass hollow-glass-index wide-view tele-view defocus cover \
  bouncing-spheres checkered-spheres earth perlin-spheres quads simple-light cornell-box cornell-smoke next-week; do
  grep -q "^$scene  *[A-Z].* " out || fail "$scene is not listed"
done
same 'a line for each scene' "$(wc -l <out)" "$(find "$source_root/assets/scenes" -name '*.json' | wc -l)"

# inspect
expect 0 "$tyndall" inspect cornell-smoke :out 'Volumes'
grep -Eq '^media +2' out || fail "inspect: media: $(cat out)"
expect 0 "$tyndall" inspect showroom --json
cp out showroom.json
same 'shapes' "$(json showroom.json shapes)" '{"quad": 1, "sphere": 6}'
same 'media' "$(json showroom.json media)" 1
same 'lights' "$(json showroom.json lights)" 1
same 'background' "$(json showroom.json background)" '"gradient"'
same 'motion' "$(json showroom.json motion)" false
same 'splitting' "$(json showroom.json splitting)" true
expect 0 "$tyndall" inspect bouncing-spheres --json
same 'motion' "$(json out motion)" true
same 'defocus' "$(json out defocus)" true
[ "$(json out kernel_features)" != "$(json showroom.json kernel_features)" ] || fail 'the same kernel for all'
expect 0 "$tyndall" inspect cornell-box --json --set /camera/defocus_angle=1
same '--set' "$(json out defocus)" true
same 'splitting' "$(json out splitting)" false
same 'film' "$(json out film_bytes)" $(((112 + 48) * 600 * 600)) # 48: emission, for the clean view

# Each scene in which methods fail says what fails there, how, and what is right.
for file in "$source_root"/assets/scenes/stress-*.json; do
  scene=$(basename "$file" .json)
  expect 0 "$tyndall" inspect "$scene"
  for word in Stress Fails Right; do
    grep -Eq "^  $word: .{20}" out || fail "inspect $scene does not show '$word:'"
  done
done

# convert: normal form, which is a fixed point, and the same picture.
for scene in showroom earth next-week cornell-smoke; do
  mkdir -p "$scene/down"
  expect 0 "$tyndall" convert "$scene" -o "$scene/a.json"
  expect 0 "$tyndall" convert "$scene/a.json" -o "$scene/b.json"
  cmp -s "$scene/a.json" "$scene/b.json" || fail "$scene: normal form changes when it is written again"
  expect 0 "$tyndall" convert "$scene/a.json" -o "$scene/down/c.json"
  same "$scene" "$(image_hash "$scene/down/c.json" --size 16x12 --spp 2)" "$(image_hash "$scene" --size 16x12 --spp 2)"
done
expect 0 "$tyndall" convert showroom -o -
cmp -s out showroom/a.json || fail 'convert to standard output'
expect 0 "$tyndall" convert showroom --set /camera/vfov=20 -o narrow.json
grep -q '"vfov": 20' narrow.json || fail 'convert --set'
expect 0 "$tyndall" render showroom --size 16x12 --spp 2 -q -o image.png
expect 0 "$tyndall" convert image.png -o image.json
grep -q '"width": 16' image.json || fail 'convert from an image'

finish
