#!/usr/bin/env bash
# Edits are never lost: closing asks; a signal, a killed program and a display that goes away leave them to the next
# start; a changed file asks before it takes their place.
. "$(dirname "$0")/_lib.sh"

fuzz_is() { [ "$(value gold.fuzz)" = "$1" ] || fail "fuzz is $(value gold.fuzz), expected $1"; }
begin() { # ARGUMENTS: starts anew, with the log of before out of the way
  start "$@"
  settle
}
kept_holds() { grep -qs "\"fuzz\": $1" state/tyndall/unsaved-*.json; }
nothing_kept() { ! ls state/tyndall/unsaved-*.json >/dev/null 2>&1; }

# Closing without edits asks nothing. With edits it asks; Cancel and Esc stay, Save writes.
write_scene scene.json 0.1
sed -i '/^\/\//d' scene.json
begin scene.json
type_value gold.fuzz.value 0.2
lines=$(here)
chord ctrl q
wait_for '^widget dialog.discard ' "$lines"
cp "$screen/Xvfb_screen0" question.xwd
click dialog.cancel
wait_for '^gone dialog.discard' "$lines"
fuzz_is 0.2
lines=$(here)
python3 "$root/tests/window/_close.py" "$window"
wait_for '^widget dialog.discard ' "$lines"
click gold.fuzz.value # the column takes no clicks meanwhile
fuzz_is 0.2
! has_keyboard control || fail "the column behind the question takes clicks"
key Escape
wait_for '^gone dialog.discard' "$lines"
settle_without_message

# The keyboard answers as well: Tab marks the next answer, Shift + Tab the one before, Return gives it.
lines=$(here)
chord ctrl q
wait_for '^widget dialog.discard ' "$lines"
key Tab
chord shift Tab
key Left
cp "$screen/Xvfb_screen0" marked.xwd
key Return # Cancel
wait_for '^gone dialog.discard' "$lines"
settle_without_message
lines=$(here)
chord ctrl q
wait_for '^widget dialog.save ' "$lines"
point dialog.save 50
xdotool click 1
ends_with 0
grep -q '"fuzz": 0.2' scene.json || fail "not saved"
wait_until_gone() { nothing_kept || fail "edits are still kept"; }
wait_until_gone

# A signal: the edits come back, with a word about it, and one undo goes back to the file.
begin scene.json
type_value gold.fuzz.value 0.3
kill -TERM "$pid"
ends_with 143
grep -q 'edits of scene.json are kept' errors || fail "nothing was said"
kept_holds 0.3 || fail "the edits were not kept"
begin scene.json
wait_for '^message restored the edits of scene.json'
fuzz_is 0.3
chord ctrl z
wait_until has_value gold.fuzz 0.2
chord ctrl shift z
wait_until has_value gold.fuzz 0.3

# Killed: what was kept within a moment is there. Another scene leaves the edits alone and tells of them.
type_value gold.fuzz.value 0.4
wait_until kept_holds 0.4
kill -KILL "$pid"
ends_with 137
write_scene other.json 0.9
begin other.json
wait_for '^message there are edits of .*scene.json that were not saved'
fuzz_is 0.9
finish
begin --spp 3 --set /materials/gold/fuzz=0.7 # without a scene: the edits, whatever their scene, with the settings
fuzz_is 0.4 # that are asked for, but an edit is never taken back
[ "$(value render.spp)" = 3 ] || fail "kept edits took the place of --spp 3: $(value render.spp)"

# Discarded edits do not come back.
finish
nothing_kept || fail "discarded edits are still kept"
begin scene.json
fuzz_is 0.2

# A changed file asks while there are edits: they are kept, or taken back by undo.
type_value gold.fuzz.value 0.6
write_scene scene.json 0.7
wait_for '^widget dialog.keep '
click dialog.keep
wait_for '^gone dialog.keep'
fuzz_is 0.6
lines=$(here)
write_scene scene.json 0.8
wait_for '^widget dialog.take ' "$lines"
cp "$screen/Xvfb_screen0" changed.xwd
click dialog.take
wait_until has_value gold.fuzz 0.8
chord ctrl z
wait_until has_value gold.fuzz 0.6

# What another program has saved is not written over without a question, even where it cannot be read.
echo '{ "tyndall": 1, ' >scene.json
wait_for '^message scene.json: '
type_value gold.fuzz.value 0.61
lines=$(here)
chord ctrl s
wait_for '^widget dialog.save ' "$lines"
cp "$screen/Xvfb_screen0" overwrite.xwd
key Right # from "Save as…" to "Cancel"
key Return
wait_for '^gone dialog.save' "$lines"
[ "$(cat scene.json)" = '{ "tyndall": 1, ' ] || fail "the file was written over"
lines=$(here)
chord ctrl s
wait_for '^widget dialog.save ' "$lines"
click dialog.save
wait_for '^saved scene.json' "$lines"
grep -q '"fuzz": 0.61' scene.json || fail "not saved"

# Closing while a snapshot is written: the window stays until the files are there, and says so.
finish
begin scene.json --set /image/width=900 --set /image/height=800
lines=$(here)
xdotool key --delay 60 ctrl+p key --delay 60 ctrl+q
wait_for '^closing writes' "$lines"
ends_with 0
for file in scene-001.png scene-001.exr; do
  [ -s "$file" ] || fail "$file is missing"
done

# A lost display, on a screen of its own.
exec 3>&1
coproc server { exec Xvfb -displayfd 1 -screen 0 1280x2700x24 -nolisten tcp 2>/dev/null; }
read -r number <&"${server[0]}"
: >log
DISPLAY=:$number "$tyndall" view scene.json --ui-log log 2>errors &
pid=$!
export DISPLAY=:$number
find_window
enlarge
type_value gold.fuzz.value 0.55
kill "$server_PID"
ends_with 3
kept_holds 0.55 || fail "the edits went with the display"
