#!/usr/bin/env bash
# compare: NaN and infinity are equal to nothing, and the default check looks at what FLIP clips.
. "$(dirname "$0")/_common.sh"
. "$source_root/tests/app/_pfm.sh"
mkdir good
pfm good/a.pfm 16 8 0.5 0.5 0.5
# fails WHAT PIXELS PLACE: compare of one picture and of a baseline, with and without limits, in all its forms.
fails() {
  local line="$2 of 128 pixels \\(is\\|are\\) not finite, the first at $3" limits
  for limits in '' '--max-relmse 1e30'; do
    # shellcheck disable=SC2086 # words
    expect 1 "$tyndall" compare r/a.pfm k/a.pfm $limits
    grep -q "^tyndall: check failed: [rk]/a.pfm: $line" err || fail "$1 $limits: $(cat err)"
    # shellcheck disable=SC2086 # words
    expect 1 "$tyndall" compare r --baseline k $limits --report report.html --junit junit.xml
    grep -q "^tyndall: a.pfm: [rk]/a.pfm: $line" err || fail "$1 $limits, baseline: $(cat err)"
    grep -q '^FAILED a.pfm' out || fail "$1: $(cat out)"
    grep -q "<failure.*$line" junit.xml && grep -q "$line" report.html || fail "$1: the reports"
    python3 "$source_root/tests/app/_well_formed.py" report.html junit.xml || fail "$1: the reports"
  done
  expect 1 "$tyndall" compare r/a.pfm k/a.pfm --json --heatmap heat.png
  cp out compared.json
  json compared.json not_finite | grep -q "$line" || fail "$1: JSON: $(cat compared.json)"
  [ -s heat.png ] || fail "$1: no heat map"
}
for wrong in nan inf -inf; do
  rm -rf r k && mkdir r && cp -r good k
  pfm r/a.pfm 16 8 0.5 0.5 0.5 "3,1,0.5,$wrong,0.5" "2,7,$wrong,$wrong,$wrong"
  fails "$wrong in the picture" 2 "3,1 (green is $wrong)"
  rm -rf r k && mkdir k && cp -r good r
  pfm k/a.pfm 16 8 0.5 0.5 0.5 "0,6,$wrong,0.5,0.5"
  fails "$wrong in the reference" 1 "0,6 (red is $wrong)"
  rm -rf r k && mkdir r
  pfm r/a.pfm 16 8 0.5 0.5 0.5 "15,0,0,0,$wrong" && cp -r r k
  fails "$wrong at the same place" 1 "15,0 (blue is $wrong)"
done
rm -rf r k && mkdir r k && pfm r/a.pfm 16 8 nan nan nan && pfm k/a.pfm 16 8 0 0 0
fails 'all NaN, which FLIP took for black' 128 '0,0 (red is nan)'
# FLIP takes NaN for black: its map shows it as what differs most.
expect 1 "$tyndall" compare r/a.pfm k/a.pfm --json
cp out compared.json
same 'FLIP of NaN and black' 1.0 "$(json compared.json flip)"
expect 0 "$tyndall" compare good/a.pfm good/a.pfm --json --max-flip 0
cp out compared.json
same 'not finite in finite pictures' '[]' "$(json compared.json not_finite)"

# A baseline takes no such picture, and is not changed for the good ones beside it.
rm -rf r k new && mkdir r && cp good/a.pfm r/a.pfm && pfm r/b.pfm 16 8 0.5 0.5 0.5 '4,2,0,nan,0'
for folder in k new; do
  [ "$folder" = new ] || { expect 0 "$tyndall" compare good --baseline k --update --max-flip 0.5 && cp -r k before; }
  expect 2 "$tyndall" compare r --baseline "$folder" --update --max-flip 0.1
  complains r/b.pfm '1 of 128 pixels is not finite, the first at 4,2 (green is nan)' 'expected finite values'
done
diff -r before k || fail 'the refused update changed the baseline'
[ ! -e new ] || fail 'the refused update made a baseline'
echo none >r/b.pfm
expect 3 "$tyndall" compare r --baseline k --update --max-flip 0.1 :: r/b.pfm
diff -r before k || fail 'the failed update changed the baseline'

# References of the other commands.
pfm reference.pfm 16 8 0.5 0.5 inf
expect 2 "$tyndall" chart cornell-box --size 16x8 --budget 1 -q -o chart.svg --reference reference.pfm
complains reference.pfm '128 of 128 pixels are not finite, the first at 0,0 (blue is inf)'

# The default check: what FLIP clips may differ by relMSE 0.01.
# clipped CODE KEPT RENDERED [OPTIONS...]: pixels X,Y,RED,GREEN,BLUE on grey.
clipped() {
  rm -rf r k && mkdir r k
  pfm k/a.pfm 16 8 0.5 0.5 0.5 "$2" && pfm r/a.pfm 16 8 0.5 0.5 0.5 "$3"
  expect 0 "$tyndall" compare k --baseline k --update
  expect "$1" "$tyndall" compare r --baseline k "${@:4}"
}
clipped 1 1,1,5,5,5 1,1,6,5,5
grep -q '^tyndall: a.pfm: relMSE among the 3 values outside \[0, 1\], which FLIP clips, is 0.01332.*, expected at most 0.01$' err ||
  fail "what FLIP clips: $(cat err)"
clipped 0 1,1,5,5,5 1,1,5.5,5,5 # 0.25 / 25.01 / 3
clipped 1 1,1,5,5,5 1,1,1,5,5   # outside in the reference only
clipped 1 1,1,1,1,1 1,1,1,1,1.3 # and in the picture only
clipped 1 1,1,0,0,0 1,1,-1,0,0  # below 0
clipped 0 1,1,5,5,5 1,1,6,5,5 --max-flip 0.03
clipped 0 1,1,5,5,5 1,1,6,5,5 --max-relmse 1
clipped 0 1,1,0.5,0.5,0.5 1,1,0.51,0.5,0.5 # relMSE of 0.01 is not asked of what FLIP sees
rm k/tolerances.json && pfm r/a.pfm 16 8 0.5 0.5 0.5 '1,1,0.5,0.5,4'
expect 1 "$tyndall" compare r --baseline k --report report.html
grep -q 'relMSE outside' report.html || fail 'the page lacks the measured value'
finish
