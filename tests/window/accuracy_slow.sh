#!/usr/bin/env bash
# True errors against a reference image: loaded, refused, seen as a picture, of another scene after an edit, exported.
. "$(dirname "$0")/_lib.sh"

write_scene scene.json 0.3 100000
sed -i 's/"width": 320, "height": 200/"width": 160, "height": 100/' scene.json
"$tyndall" render scene.json --seed 5 --spp 256 -o reference.pfm -q
"$tyndall" render scene.json --size 100x60 --spp 1 -o small.pfm -q
start scene.json
lines=$(here)
click chart.reference
wait_for '^widget dialog.name' "$lines"
type_text small.pfm
key Return
wait_for '^message small.pfm: found 100x60 pixels, expected 160x100 as the picture has' "$lines"
key Escape

lines=$(here)
click chart.reference
wait_for '^widget dialog.load' "$lines"
type_text reference.pfm
click dialog.load
wait_for '^message reference: reference.pfm' "$lines"
wait_for '^accuracy against reference.pfm · FLIP 0\.[0-9]+ at [0-9,]+ spp' "$lines"
lines=$(here)
key r # so that the curve begins at the first sample
wait_for '^frame 1 ([3-9][0-9][0-9]|[0-9]{4,}) ' "$lines"
lines=$(here)
point chart 60 55
wait_for '^reading path · random.*: ' "$lines"

# The view of errors is shown as a picture, and switching to it starts nothing over.
bright=$(brightness picture)
lines=$(here)
key 8
wait_for '^widget image.view.error .* on' "$lines"
shows_errors() {
  dark=$(brightness picture)
  compares "$dark < 0.7 * $bright"
}
wait_until shows_errors
key 9
shows_flip() { compares "abs($(brightness picture) - $dark) > 2"; }
wait_until shows_flip
key 1
shows_picture() { compares "abs($(brightness picture) - $bright) < 2"; }
wait_until shows_picture
[ "$(submits)" = 1 ] || fail "$(submits) submits instead of 1"

for number in 001 002; do
  lines=$(here)
  click chart.export
  wait_for "^saved .*scene-chart-$number" "$lines"
done
[ "$(head -1 scene-chart-001.csv)" = method,spp,seconds,relmse ] || fail 'the CSV has no head'
grep -q 'scene: true error against reference.pfm' scene-chart-001.svg || fail 'the SVG does not say what it shows'
python3 - scene-chart-002.csv <<'PY' || fail 'the curve does not fall as noise does'
import csv, sys
rows = [(float(r["spp"]), float(r["relmse"])) for r in csv.DictReader(open(sys.argv[1]))]
first, last = rows[-1], rows[-1]
for row in reversed(rows):  # the newest curve
    if row[0] > first[0]:
        break
    first = row
# Independent samples: what is measured is the noise of the picture and of the reference's 256 samples together.
noise = lambda spp: 1 / spp + 1 / 256
found, expected = last[1] / first[1], noise(last[0]) / noise(first[0])
print(len(rows), "points, from", first, "to", last, "fallen to", found, "expected", expected)
sys.exit(not expected < 0.9 or not 0.75 < found / expected < 1.33)
PY

# After an edit the reference belongs to another scene; after undo it fits again.
lines=$(here)
type_value gold.fuzz.value 0.5
wait_for '^accuracy reference of another scene: reference.pfm' "$lines"
key 8
wait_for '^widget image.view.error .* on' "$lines"
lines=$(here)
chord ctrl z
wait_for '^accuracy against reference.pfm' "$lines"

# Without the reference the error is estimated again, and the view of errors is gone.
lines=$(here)
click chart.reference
wait_for '^widget dialog.drop' "$lines"
click dialog.drop
wait_for '^widget image.view.beauty .* on' "$lines"
wait_for '^accuracy $' "$lines"
finish

# The reference can also be given on the command line.
start scene.json --reference reference.pfm
wait_for '^accuracy against reference.pfm'
finish
status=0
"$tyndall" view scene.json --reference small.pfm 2>errors || status=$?
[ "$status" = 2 ] || fail "a reference of another size: exit code $status"
grep -q 'small.pfm: found 100x60 pixels, expected 160x100' errors || fail 'it is not said'
