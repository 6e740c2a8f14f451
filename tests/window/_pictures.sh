#!/usr/bin/env bash
# The README's pictures of the window: the showroom when it is finished, and an animated one of a session: the metal ball
# becomes rougher and smooth again, the camera swings, the ball is selected. Needs ImageMagick, and a machine with nothing else
# to do. Arguments: the tyndall binary, a scratch folder, the source root.
screen_size=1600x900
. "$(dirname "$0")/_lib.sh"
pictures=$root/assets/pictures

showroom() { # WIDTH HEIGHT OPTIONS
  open_window showroom "${@:3}"
  sends 1 "^size $1 $2\$" xdotool windowsize "$window" "$1" "$2"
}
showroom 1600 900 --spp 128
settle
import -window "$window" "$pictures/window.png"
finish

frames=0
shot() { # COUNT: as many pictures of the window as it is now
  import -window "$window" -resize 560x "$(printf 'frame-%03d' "$frames").png"
  for ((k = 1; k < $1; k++)); do
    cp "$(printf 'frame-%03d' "$frames").png" "$(printf 'frame-%03d' $((frames + k))).png"
  done
  frames=$((frames + $1))
}
drag() { # CONTROL FROM TO...
  point "$1" "$2"
  press 1
  for across in "${@:3}"; do
    point "$1" "$across"
    shot 1
  done
  release 1
}
showroom 1280 800
wait_for '^frame 1 ([2-9]|[1-9][0-9]+) '
shot 4
drag gold.fuzz 25 35 45 55 65 75 65 50 35 20 10
shot 2
drag picture 50 47 44 41 38 35 38 41 44
shot 3
click picture 44
shot 3
convert -delay 18 -loop 0 frame-*.png -dither none -colors 64 -layers optimize "$pictures/session.gif"
finish
