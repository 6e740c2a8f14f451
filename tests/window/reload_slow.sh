#!/usr/bin/env bash
# The open file is watched: written or renamed over, it is read again. A broken file leaves the last good scene and
# says what is wrong. Saving asks before it loses comments. A file behind a symbolic link and textures are watched, too.
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

# Opened by a link: its target is saved, then the link leads elsewhere. A texture is painted anew, broken, mended.
paint() { # FILE BYTE: a grey image of 2 x 2 pixels
  python3 - "$1" "$2" <<'PY'
import struct, sys, zlib
chunk = lambda kind, data: struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
rows = (b"\0" + bytes([int(sys.argv[2])]) * 6) * 2
open(sys.argv[1], "wb").write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", 2, 2, 8, 2, 0, 0, 0)) +
                              chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))
PY
}
mkdir -p in
paint map.png 40
sed -e 's/^  "materials"/  "textures": { "map": { "type": "image", "file": "map.png" } },&/' \
  -e 's/"albedo": \[0.4, 0.4, 0.4\]/"albedo": "map"/' other.json >in/a.json
sed 's/"fuzz": 0.6/"fuzz": 0.7/' in/a.json >in/b.json
ln -s in/a.json link.json
start link.json
settle
lines=$(here)
sed 's/"fuzz": 0.6/"fuzz": 0.3/' in/a.json >new.json
cat new.json >in/a.json
wait_for '^widget gold.fuzz .* 0.3$' "$lines"
ln -s in/b.json next.json
mv next.json link.json
wait_for '^widget gold.fuzz .* 0.7$' "$lines"
settle
dark=$(brightness picture)
paint map.png 250
is_brighter() { compares "$(brightness picture) > $dark + 3"; }
wait_until is_brighter
light=$(brightness picture)
lines=$(here)
echo broken >map.png
wait_for '^message .*/textures/map' "$lines"
compares "abs($(brightness picture) - $light) < 3" || fail 'the last good picture is gone'
paint new.png 40
mv new.png map.png
wait_for '^message read again' "$lines"
is_darker() { compares "$(brightness picture) < $light - 3"; }
wait_until is_darker
finish
