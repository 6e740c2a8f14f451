#!/usr/bin/env bash
# What the user chose about the window is there at the next start: theme, size of texts, width of the column, folded
# sections. A damaged file is told of once. Names in Chinese letters are shown where a font has them.
. "$(dirname "$0")/_lib.sh"

preferences=$XDG_CONFIG_HOME/tyndall/window.txt
written() { grep -qx "$1" "$preferences"; }
width_of() { grep -E "^widget $1 " "$scratch/log" | tail -1 | awk '{ print $5 - $3 }'; }

write_scene scene.json 0.2
start scene.json
settle
dark=$(brightness gold.fuzz.value)
click window.theme.light
wait_until written 'theme light'
settle
lighter() { compares "$(brightness gold.fuzz.value) > $dark + 80"; }
wait_until lighter
click section.Camera
wait_until written 'folded Camera'

# By keys, up and down and back, also of the number block.
usual=$(width_of gold.fuzz.value)
chord ctrl plus
wait_until written 'text-size 1.1'
settle
compares "$(width_of gold.fuzz.value) > $usual" || fail 'texts did not grow'
chord ctrl KP_Add
wait_until written 'text-size 1.25'
chord ctrl minus
wait_until written 'text-size 1.1'
chord ctrl 0
wait_until written 'text-size 1'
chord ctrl plus
wait_until written 'text-size 1.1'
settle

# The edge of the column.
point column.edge 50 50
press 1
read -r x y <<<"$(last_of mouse)"
move $((x - 88)) "$y"
release 1
wait_until written 'column 45[0-9]'
finish

start scene.json
settle
has_value section.Camera folded || fail 'the section is open again'
has_value window.theme.light on || fail 'the theme is forgotten'
has_value window.text.110 on || fail 'the size of texts is forgotten'
lighter || fail 'the window is dark again'
key Escape
chord ctrl k
type_text 'dark or light'
key Return
wait_until written 'theme dark'
finish

# A damaged file.
printf 'theme light\ncolumn wide\n' >"$preferences"
start scene.json
wait_for '^message .*window.txt is damaged'
has_value window.theme.dark on || fail 'a damaged file was believed'
finish
[ -f "$preferences.damaged" ] || fail 'the damaged file is gone'
start scene.json
logged '^message .*damaged' 1 && fail 'told twice'

# Names.
sed -e 's/"name": "ball"/"name": "金の球"/' scene.json >names.json
found=$(fc-list ':lang=ja' file 2>/dev/null | head -1 || true)
finish
start names.json
wait_for '^fonts [03] of 3$'
if [ -n "$found" ]; then logged '^fonts 3 of 3$' 1 || fail "no letters, though there is $found"; fi
settle
finish
