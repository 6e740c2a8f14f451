#!/usr/bin/env bash
# What is no scene is shown by samples that the program computes itself.
. "$(dirname "$0")/_program.sh"

program glow <<<"struct glowing : metal {
  using metal::metal;
  color emitted(double, double, const point3&) const override { return color(0.25, 0, 0); } };
int main() { hittable_list w; w.add(make_shared<sphere>(point3(0, 0, -1), 0.5, make_shared<glowing>(color(0.5, 0.5, 0.5), 0.0)));
  $render c.background = color(0.125, 0.25, 0.5); c.render(w); }"

expect 0 "$tyndall" render glow.cc --spp 8 -q -o glow.pfm
complains 'glow.cc: glowing: it shines and scatters' 'these are your own samples'
# The ball shows half of the sky, and its glow; the corner shows the sky.
pixel() { # X Y, y upwards
  tail -c "$((12 * 8 * 8))" glow.pfm | od -An -f -v -w12 | sed -n "$(($2 * 8 + $1 + 1))p" | tr -s ' '
}
same 'the ball' "$(pixel 4 4)" ' 0.3125 0.125 0.25'
same 'the sky' "$(pixel 0 0)" ' 0.125 0.25 0.5'
expect 0 "$tyndall" render glow.cc --spp 2 -q -o glow.png
grep -qa 'own_samples' glow.png || fail 'the picture does not say that it has own samples'

# They are no scene, and no function of seed and index.
for command in 'convert glow.cc -o x.json' 'inspect glow.cc' 'render glow.cc --samples 0:2 -o x.exr' 'render glow.cc --set /camera/vfov=3 -o x.png' \
  'chart glow.cc -o x.svg' 'compare glow.png glow.cc'; do
  # shellcheck disable=SC2086
  expect 2 "$tyndall" $command
  grep -q 'glow.cc' err || fail "$command: $(cat err)"
done
[ ! -e x.json ] && [ ! -e x.exr ] && [ ! -e x.png ] || fail 'something was written'

finish
