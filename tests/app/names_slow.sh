#!/usr/bin/env bash
# Names that hold anything, of files, scenes, objects, materials and methods: what is written is well-formed, messages are one
# line each, and pictures carry them unchanged.
. "$(dirname "$0")/_common.sh"
. "$source_root/tests/app/_pfm.sh"
well_formed() { python3 -B "$source_root/tests/app/_well_formed.py" "$@" || fail "not well-formed: $*"; }
pfm grey.pfm 16 8 0.5 0.5 0.5
pfm red.pfm 16 8 0.9 0.5 0.5
names=($'ctl\x01x' $'esc\x1b[31m' $'del\x7f' $'bytes\xffutf' $'cut\xc3' $'surrogate\xed\xa0\x80' $'long form\xc0\xaf' $'non\xef\xbf\xbe' $'\xef\xbf\xbf'
  $'line\nfeed' $'return\r' $'tab\t' $'next\xc2\x85line' $'separator\xe2\x80\xa8' $'turned\xe2\x80\xae' '"quotes" '"'and'" '<b>&amp; & ]]>' '--> <!--'
  'per%cent %s {} {0}' '-dash' 'back\slash\n' '$HOME `id`' ' spaces ' 'Grüße, 世界 🙂' '#?*' "$(printf 'ä%.0s' {1..125})" "$(printf '\x01%.0s' {1..250})")
mkdir r
for name in "${names[@]}"; do cp grey.pfm "r/$name.pfm" || fail "a file of that name: $name"; done

# A baseline of them.
expect 0 "$tyndall" compare r --baseline k --update --max-flip 0.5
same 'lines of the update' "${#names[@]}" "$(wc -l <out)"
[ ! -s err ] || fail "the update: $(cat err)"
diff -r -x tolerances.json r k || fail 'the update lacks pictures'
well_formed k/tolerances.json
expect 0 "$tyndall" compare r --baseline k --report report.html --junit junit.xml
same 'lines of the check' "${#names[@]}" "$(grep -c '^ok ' out)"
[ ! -s err ] || fail "the check: $(cat err)"
well_formed report.html junit.xml
# The tolerances are found again, each by its name; and each failure is one line.
python3 - <<'MSG'
import json
kept = json.load(open("k/tolerances.json"))
assert len(kept) == len(set(kept)) and "ctl\x01x.pfm" in kept and "bytes\\xffutf.pfm" in kept, list(kept)
for limits in kept.values():
    limits["max_flip"] = 0.0001
json.dump(kept, open("k/tolerances.json", "w"))
MSG
for name in "${names[@]}"; do cp red.pfm "r/$name.pfm"; done
expect 1 "$tyndall" compare r --baseline k --report report.html --junit junit.xml
same 'failures' "${#names[@]}" "$(wc -l <err)"
same 'failures by the tolerances' "${#names[@]}" "$(grep -c '^tyndall: .*FLIP is .*, expected at most 0.0001$' err)"
same 'lines of the failed check' "${#names[@]}" "$(wc -l <out)"
well_formed report.html junit.xml
rm r/* && expect 1 "$tyndall" compare r --baseline k --report report.html --junit junit.xml
same 'pictures that are missed' "${#names[@]}" "$(grep -c 'it was not rendered' err)"
well_formed report.html junit.xml

# Scenes: files and what is in them.
python3 - <<'MSG'
import json
odd = "ctl \u0001 \u001b \n \t \u007f \u0085 \u2028 \ufffe \uffff ]]> <b> & \"q\" 'a' \\ % {} \U0001f642 " + "ä" * 200
scene = {"tyndall": 1, "name": odd, "image": {"width": 8, "height": 8},
         "textures": {odd: {"type": "solid", "color": [0.5, 0.5, 0.5]}},
         "materials": {odd: {"type": "lambertian", "albedo": odd}, "lamp": {"type": "light", "radiance": [1, 1, 1]}},
         "objects": [{"name": odd, "type": "sphere", "center": [0, 0, -3], "radius": 1, "material": odd},
                     {"name": "lamp", "type": "sphere", "center": [0, 3, -3], "radius": 1, "material": "lamp"}]}
json.dump(scene, open("odd.json", "w"))
MSG
expect 0 "$tyndall" convert odd.json -o normal.json
well_formed normal.json
expect 0 "$tyndall" render odd.json --spp 2 -q -o odd.png -o odd.exr --stats stats.json
well_formed stats.json
for image in odd.png odd.exr; do
  expect 0 "$tyndall" convert $image -o back.json
  python3 - $image <<'MSG' || fail "$image: other names come back"
import json
a, b = (json.load(open(name)) for name in ("normal.json", "back.json"))
assert all(a[key] == b[key] for key in ("name", "textures", "materials", "objects")), (a, b)
MSG
done
expect 0 "$tyndall" inspect odd.png --json && cp out inspected.json && well_formed inspected.json
expect 0 "$tyndall" inspect odd.exr
same 'lines of inspect' "$("$tyndall" inspect cornell-box | grep -cv '^  ')" "$(wc -l <out)"
expect 0 "$tyndall" render odd.json --replay 4,4,0
python3 -c 'import json
text = open("odd.json").read().replace("solid", "sol\\u0001\\nid")
open("bad.json", "w").write(text)'
expect 2 "$tyndall" render bad.json -o bad.png :: bad.json

python3 -c 'import json
scene = json.load(open("odd.json")); del scene["name"]; json.dump(scene, open("unnamed.json", "w"))'

# A texture behind a folder's name that JSON cannot hold.
mkdir $'folder\xff' && cp odd.png $'folder\xff/t.png'
python3 -c 'import json
scene = json.load(open("unnamed.json")); texture, = scene["textures"]
scene["textures"][texture] = {"type": "image", "file": "t.png"}
json.dump(scene, open(b"folder\xff/scene.json", "w"))'
expect 0 "$tyndall" convert $'folder\xff/scene.json' -o outside.json
well_formed outside.json
expect 2 "$tyndall" inspect outside.json :: outside.json /textures/ 'xff/t.png'

# Charts, of scenes with and without a name, of methods with names.
pfm r.pfm 8 8 0.5 0.5 0.5
expect 0 "$tyndall" chart odd.json --budget 0.3 -q -o chart.svg --method $'a <b> & "c" \x01\x1b\xff\n=' --method '--> ]]>='
same 'lines of the table' 3 "$(wc -l <out)"
well_formed chart.svg
for name in "${names[@]:0:24}"; do
  cp unnamed.json "./$name.json"
  expect 0 "$tyndall" chart "./$name.json" --budget 0.05 -q -o "./$name.svg" --reference r.pfm --method 'x='
  well_formed "./$name.svg"
done

# Messages about files of such names are one line.
for name in "${names[@]}"; do
  expect 2 "$tyndall" render "./$name.nothing" -o a.png :: found
  expect 2 "$tyndall" render odd.json -o "./$name.png" -o "./$name.png" :: twice
  expect 3 "$tyndall" compare "./$name.pfm" odd.png :: 'cannot read'
  expect 3 "$tyndall" render odd.json -o "./$name/a.png" :: 'there is no folder'
  expect 2 "$tyndall" render odd.json -o a.png --set "/name$name=1" :: found
  expect 2 "$tyndall" "x$name" :: found
done
finish
