#!/usr/bin/env bash
# compare --baseline: pictures that renders should go on looking like, and the reports of the check.
. "$(dirname "$0")/_common.sh"
render() { "$tyndall" render "$1" --size 32x18 --spp 4 --seed "${3:-0}" -q -o "$2" || fail "rendering $2"; }
mkdir new
render cornell-box new/box.png
render showroom 'new/a & <b>.pfm'

expect 0 "$tyndall" compare new/box.png --baseline base --update --max-flip 0.05 --max-rmse 0.5
same 'standard output' 'box.png  kept' "$(cat out)"
expect 0 "$tyndall" compare 'new/a & <b>.pfm' --baseline base --update
python3 - <<'MSG' || fail "the tolerances: $(cat base/tolerances.json)"
import json
assert json.load(open("base/tolerances.json")) == {"a & <b>.pfm": {"max_flip": 0.02}, "box.png": {"max_rmse": 0.5, "max_flip": 0.05}}
MSG
cmp -s new/box.png base/box.png || fail 'the picture that is kept is another one'
expect 0 "$tyndall" compare new --baseline base --report report.html --junit junit.xml
same 'lines' 2 "$(grep -c '^ok ' out)"
[ ! -s err ] || fail "standard error: $(cat err)"

# An update without limits keeps those that were given once.
expect 0 "$tyndall" compare new/box.png --baseline base --update
grep -q '"max_rmse": 0.5' base/tolerances.json || fail 'the tolerance was lost'

# One line for each failure: another picture, one of another size, one that is missing, one that is new, one that is none.
render cornell-smoke new/box.png
"$tyndall" render showroom --size 16x9 --spp 1 -q -o 'new/a & <b>.pfm'
cp base/box.png base/gone.png
cp base/box.png new/fresh.png
echo no picture >new/broken.png && cp base/box.png base/broken.png
expect 1 "$tyndall" compare new --baseline base --report report.html --junit junit.xml
same 'failures' 5 "$(wc -l <err)"
grep -q '^tyndall: box.png: FLIP is .*, expected at most 0.05$' err || fail "box.png: $(cat err)"
grep -q '^tyndall: a & <b>.pfm: .*found 16x9 pixels, expected 32x18' err || fail "another size: $(cat err)"
grep -q '^tyndall: gone.png: the baseline has it, and it was not rendered; delete it there if that is meant$' err || fail "missing: $(cat err)"
grep -q '^tyndall: fresh.png: the baseline lacks it; --update keeps it$' err || fail "new: $(cat err)"
grep -q '^tyndall: broken.png: ' err || fail "no picture: $(cat err)"
python3 - <<'MSG' || fail 'the reports'
import base64, json, re, xml.etree.ElementTree
suite = xml.etree.ElementTree.parse("junit.xml").getroot()
assert suite.get("tests") == "5" and suite.get("failures") == "5", suite.attrib
assert {case.get("name") for case in suite} == {"box.png", "a & <b>.pfm", "gone.png", "fresh.png", "broken.png"}
assert all(case.find("failure").get("message") for case in suite)
text = open("report.html").read()
images = re.findall(r'src="data:image/png;base64,([^"]+)"', text)
assert len(images) == 3 and all(base64.b64decode(i, validate=True).startswith(b"\x89PNG") for i in images)
assert not re.search(r'(src|href)="(?!data:|#p)', text), "the page needs other files"
assert "a &amp; &lt;b>.pfm" in text and "0 of 5 pictures" in text
assert text.count("<tr class=\"bad\"><th><a href") == 5 and "<code>tyndall render &#39;new/box.png&#39; -o &#39;box-again.png&#39;</code>" in text
pictures = {p["name"]: p for p in json.load(open("report.json"))["pictures"]}
box = pictures.pop("box.png")
assert not box["passed"] and box["failures"][0].startswith("FLIP is"), box
assert box["measured"]["flip"] > 0.05 and box["limits"] == {"flip": 0.05, "rmse": 0.5} and set(box["measured"]) >= {"relmse", "psnr"}, box
assert len(pictures) == 4 and all(p["failures"] and not p["measured"] for p in pictures.values()), pictures
MSG
[ -z "$(find . -name '*.part*')" ] || fail 'scraps are left'
# Some pictures only: the others of the baseline are not missed.
expect 0 "$tyndall" compare base/gone.png --baseline base
expect 0 "$tyndall" compare new/box.png --baseline base --max-flip 1

finish
