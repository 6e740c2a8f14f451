#!/usr/bin/env bash
# What is no scene is shown by samples that the program computes itself. Where a scene is needed: not_taken_slow.sh.
. "$(dirname "$0")/_program.sh"

program glow <<<"struct glowing : metal {
  using metal::metal;
  color emitted(double, double, const point3&) const override { return color(0.25, 0, 0); } };
int main() { hittable_list w; w.add(make_shared<sphere>(point3(0, 0, -1), 0.5, make_shared<glowing>(color(0.5, 0.5, 0.5), 0.0)));
  $render c.background = color(0.125, 0.25, 0.5); c.render(w); }"

expect 0 "$tyndall" render glow.cc --spp 8 -q -o glow.pfm -o glow.png
complains 'glow.cc: glowing: it shines and scatters' 'these are your own samples'
# The ball shows half of the sky, and its glow; the corner shows the sky.
pixel() { # X Y, y upwards
  tail -c "$((12 * 8 * 8))" glow.pfm | od -An -f -v -w12 | sed -n "$(($2 * 8 + $1 + 1))p" | tr -s ' '
}
same 'the ball' "$(pixel 4 4)" ' 0.3125 0.125 0.25'
same 'the sky' "$(pixel 0 0)" ' 0.125 0.25 0.5'
grep -qa 'own_samples' glow.png || fail 'the picture does not say that it has own samples'

finish
