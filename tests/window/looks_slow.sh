#!/usr/bin/env bash
# What is on the screen looks like the kept pictures in kept/: the finished picture, what it is made of, the clean view, false
# colour, the handles of a selection. TYNDALL_UPDATE=1 keeps what is on the screen instead. And what is seen is what is saved:
# at one screen pixel a pixel, the window shows the bytes of the snapshot, for each tone curve and with exposure.
. "$(dirname "$0")/_lib.sh"
kept=$root/tests/window/kept

# looks NAME: the picture on the screen is the kept one of that name; waits until the screen shows it.
looks() {
  move 5 5
  settle_without_message
  if is_on TYNDALL_UPDATE; then
    until on_screen picture save "$1.png" && sleep 0.5 && on_screen picture save again.png && cmp -s "$1.png" again.png; do
      :
    done
    "$tyndall" compare "$1.png" --baseline "$kept" --update --max-flip 0.002 >compared
    return
  fi
  for _ in $(seq 100); do # the X server puts a drawing on the screen after the log has told of it
    on_screen picture save "$1.png"
    "$tyndall" compare "$1.png" --baseline "$kept" >compared 2>&1 && return
    sleep 0.1
  done
  fail "the screen does not look like the kept picture: $(cat compared)"
}

write_scene scene.json 0.2
sed -i 's/"integrator": "path", "sampler": "random"/"integrator": "mis"/' scene.json
start scene.json --spp 64
settle
key 0 # a pixel for each of the screen's
looks beauty
for view in albedo normal depth object; do
  click "image.view.$view"
  looks "$view"
done
click image.view.beauty
key n
looks clean
key n
click image.view.false_colour
looks false_colour
click image.view.beauty
click picture 50 45
looks handles
finish

# Messages appear beneath the picture: the window is higher than the picture needs.
write_scene scene.json 0.3 8
start scene.json --set /image/width=640 --set /image/height=400
settle
type_value image.exposure.value 0.7
click image.tone_map.aces
click image.tone_map.agx
sends 1 '^size 1012 630$' xdotool windowsize "$window" 1012 630
wait_for '^widget picture 0 100 640 500'
move 1005 625
for number in 001 002 003; do
  lines=$(here)
  chord ctrl p
  wait_for "^saved .*scene-$number" "$lines"
  wait_until on_screen picture same scene-$number.png
  chord ctrl z # back to aces, then to srgb
  settle
done
finish
