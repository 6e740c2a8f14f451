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

# A picture that a program writes: kept in a file instead. What is nothing, or no picture, is that.
expect_piped() { # CODE TEXT ARGUMENTS...
  local code=$1 text=$2 got=0
  shift 2
  printf '%b' "$text" | "$tyndall" view - "$@" >out 2>err || got=$?
  [ "$got" -eq "$code" ] || fail "exit code $got instead of $code for '$text': $(cat err)"
}
expect_piped 3 'P3\n2 1\n255\n1 2 3\n'
complains '> image.ppm'
expect_piped 3 '{ "tyndall": 1 }'
complains 'tyndall render - -o image.png'
expect_piped 2 ''
complains 'standard input: found nothing' 'P3 or P6'
expect_piped 2 'P3\n2 x 255'
complains 'standard input' 'found "x"'
expect_piped 2 'P3 20'
complains 'standard input: ended where the height'
expect_piped 2 'P3 2 1 255 1 2 3' --size 4x4
complains 'found a picture, expected a scene'
# Text before it is told at once, whatever follows, and whoever goes on writing.
{ echo 'rendering...' && printf 'P3\n2 1\n255\n' && exec sleep 600; } > >(timeout 60 "$tyndall" view - >out 2>err; echo $? >code) &
writer=$!
for _ in $(seq 600); do [ -s code ] && break || sleep 0.1; done
kill $writer
same 'the exit code after a line of text' "$(cat code)" 2
complains 'standard input: found "rendering..."' 'P3 or P6' std::cerr
expect_piped 2 '\xef\xbb\xbfP3\n2 1\n255\n1 2 3\n'
complains 'byte order mark' 'P3 or P6'
expect_piped 2 '\xff\xfeP\x003\x00\n\x00'
complains 'UTF-16' 'P3 or P6'
expect_piped 3 '\xef\xbb\xbf\n\n // a scene\n{ "tyndall": 1 }'
complains 'tyndall render -'
expect_piped 2 '\n\n { "tyndall": x }'
complains 'line 3'
expect_piped 2 '{ "tyndall": 1 }' --gamma2
complains '--gamma2' 'found a scene'

finish
