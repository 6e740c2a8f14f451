#!/usr/bin/env bash
# Scenes have pictures, which are made once; recent files are listed; tabs bring parts of the column to its head.
. "$(dirname "$0")/_lib.sh"
export XDG_CACHE_HOME=$scratch/cache
export HOME=$scratch/home
cached=$XDG_CACHE_HOME/tyndall/thumbnails
lit() { has_value "tab.$1" on; }
top_of() { grep -E "^widget ${1// /_} " "$scratch/log" | tail -1 | cut -d' ' -f4; }

write_scene one.json 0.2
write_scene two.json 0.5
start one.json
settle
ls "$cached"/*.png >/dev/null || fail 'no picture was kept'
count=$(find "$cached" -name '*.png' | wc -l)
click scenes.cover
wait_for '^message opened cover'
wait_until has_value scenes.cover on
! grep -q cover "$XDG_STATE_HOME/tyndall/recent.txt" || fail 'a built-in scene is among the recent files'
# What is in the cache is not made again: damaged pictures are.
damaged=$(find "$cached" -name '*.png' | sort | head -1)
keeps=$(find "$cached" -name '*.png' | sort | tail -1)
echo damaged >"$damaged"
touch -d '2001-01-01' "$keeps"
finish

start two.json
settle
head -c 4 "$damaged" | grep -q PNG || fail 'a damaged picture was not made again'
[ "$(date -r "$keeps" +%Y)" = 2001 ] || fail 'a picture was made twice'
[ "$(find "$cached" -name '*.png' | wc -l)" -ge "$count" ] || fail 'pictures are gone'

# The newest file is at the head of the recent ones; the one before it beneath.
lines=$(here)
click scenes.recent.1
wait_for '^message opened one.json' "$lines"
settle
wait_until has_value scenes.recent.0 on

# A file is opened by its typed name, from the home folder too; any scene of the list by the palette.
mkdir -p home
cp two.json home/three.json
lines=$(here)
chord ctrl o
wait_for '^widget dialog.name ' "$lines"
type_text '~/three.json'
cp "$screen/Xvfb_screen0" open.xwd
lines=$(here)
key Return
wait_for '^message opened three.json' "$lines"
lines=$(here)
chord ctrl k
type_text 'quads'
cp "$screen/Xvfb_screen0" palette.xwd
key Return
wait_for '^message opened quads' "$lines"

# What was typed stays where the scene cannot be saved there.
lines=$(here)
chord ctrl shift s
wait_for '^widget dialog.name ' "$lines"
wait_until has_keyboard control
chord ctrl a
type_text "$scratch/nowhere/quads.json"
lines=$(here)
key Return
wait_for '^message .*nowhere' "$lines"
wait_for '^keyboard control' "$lines"
has_value dialog.name "$scratch/nowhere/quads.json" || fail "the typed name is lost: $(value dialog.name)"
key Escape
wait_for '^gone dialog.name' "$lines"
key Escape
chord ctrl k
type_text 'two.json'
lines=$(here)
key Return
wait_for '^message opened two.json' "$lines"
settle

# A low window: the column has to scroll.
sends 1 '^size 1000 640$' xdotool windowsize "$window" 1000 640
for part in Scenes Objects Render Camera Image Object; do
  click "tab.$part"
  wait_until lit "$part"
done
click tab.Objects
wait_until lit Objects
settle
compares "$(top_of section.Objects) < 120" || fail 'the objects are not at the head of the column'
# Selected in the picture: its values are shown.
click picture 50 45
wait_until lit Object
wait_for '^widget section.Ball '
# All actions, by mouse.
lines=$(here)
click tab.actions
wait_for '^widget palette ' "$lines"
type_text 'go to: scenes'
key Return
wait_until lit Scenes
settle
finish
