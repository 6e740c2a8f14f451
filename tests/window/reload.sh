#!/usr/bin/env bash
# The open file is watched: written or renamed over, it is read again. A broken file leaves the last good scene and
# says what is wrong. Saving asks before it loses comments.
. "$(dirname "$0")/_lib.sh"

write_scene scene.json 0.1
start scene.json
settle

write_scene scene.json 0.4 # renames
wait_for '^widget gold.fuzz .* 0.4$'
wait_for '^submit 2'
lines=$(here)
sed -i.bak 's/"fuzz": 0.4/"fuzz": 0.5/' scene.json # writes a new file and renames
wait_for '^widget gold.fuzz .* 0.5$' "$lines"
sed 's/"fuzz": 0.5/"fuzz": 0.6/' scene.json >other.json
cat other.json >scene.json # writes in place
wait_for '^widget gold.fuzz .* 0.6$' "$lines"
settle
edits=$(submits)

before=$(brightness picture)
sed -i 's/"fuzz": 0.6/"fuzz": 7/' scene.json
wait_for '^message scene.json: /materials/gold/fuzz: found 7' "$lines"
lines=$(here)
echo '{ "tyndall": 1, ' >scene.json
wait_for '^message scene.json: ' "$lines"
settle
[ "$(submits)" = "$edits" ] || fail "a broken file was submitted"
[ "$(value gold.fuzz)" = 0.6 ] || fail "the last good scene is gone: $(value gold.fuzz)"
lines=$(here)
write_scene scene.json 0.6
wait_for '^read ' "$lines"
settle
[ "$(submits)" = "$edits" ] || fail "an equal file started over"
looks_as_before() { compares "abs($(brightness picture) - $before) < 3"; }
wait_until looks_as_before

# Ctrl+S: the comments are asked about, then lost; the file holds the edit and is not read again as a new one.
type_value gold.fuzz.value 0.25
chord ctrl s
wait_for '^widget dialog.cancel'
grep -q 'A comment' scene.json || fail "saved without asking"
click dialog.cancel
settle
grep -q 'A comment' scene.json || fail "saved though it was cancelled"
lines=$(here)
chord ctrl s
wait_for '^widget dialog.save' "$lines"
lines=$(here)
click dialog.save
wait_for '^saved scene.json' "$lines"
wait_for '^read ' "$lines"
settle
grep -q '"fuzz": *0.25' scene.json || fail "not saved"
edits=$(submits)
lines=$(here)
chord ctrl shift s
wait_for '^widget dialog.name' "$lines"
wait_until has_keyboard control
chord ctrl a
type_text copy.json
key Return
wait_for '^saved copy.json' "$lines"
[ -s copy.json ] || fail "no copy"
settle
[ "$(submits)" = "$edits" ] || fail "saving started over"
finish
