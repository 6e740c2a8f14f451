#!/usr/bin/env bash
# Without a display: exit code 3 and one line that names the render command which does the same.
. "$(dirname "$0")/_common.sh"
unset DISPLAY WAYLAND_DISPLAY

expect 3 "$tyndall"
complains 'tyndall render showroom -o showroom.png'
expect 3 "$tyndall" view cornell-box --seed 3
complains 'tyndall render cornell-box --seed 3 -o cornell-box.png'
expect 3 "$tyndall" view cornell-box --reference a.exr --seed 3 --ui-log=log
complains 'tyndall render cornell-box --seed 3 -o cornell-box.png'
expect 3 "$tyndall" --seed 3 cornell-box --spp 9
complains 'tyndall render --seed 3 cornell-box --spp 9 -o cornell-box.png'
cp "$source_root/assets/scenes/quads.json" 'my quads.json'
expect 3 "$tyndall" 'my quads.json'
complains "tyndall render 'my quads.json' -o 'my quads.png'"

# The command works as it stands.
mkdir bin
ln -s "$tyndall" bin/tyndall
command=$(sed "s/.*: tyndall render/tyndall render/" err)
(PATH=$PWD/bin:$PATH && eval "$command --size 8x8 --spp 1 -q") || fail "does not work: $command"
[ -s 'my quads.png' ] || fail 'no image'
for name in "it's" $'line\nfeed\x1b' $'bytes\xff' 'back\slash $HOME' $'\xe2\x80\xa8' -dash; do
  cp 'my quads.json' "./$name.json"
  expect 3 "$tyndall" "./$name.json"
  complains 'tyndall render'
  command=$(sed "s/.*: tyndall render/tyndall render/" err)
  (PATH=$PWD/bin:$PATH && eval "$command --size 8x8 --spp 1 -q") || fail "does not work: $command"
  [ -s "./$name.png" ] || fail "no image: $command"
done

# If the scene cannot be read either, that is what is reported.
expect 2 "$tyndall" missing.json
complains 'missing.json'

finish
