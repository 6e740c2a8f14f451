#!/usr/bin/env bash
# compare --baseline: which pictures are compared. A check of none fails, folders are gone through, what is left out is said.
. "$(dirname "$0")/_common.sh"
. "$source_root/tests/app/_pfm.sh"
pfm a.pfm 16 8 0.5 0.5 0.5
pfm b.pfm 16 8 0.9 0.1 0.5

# Nothing to compare.
mkdir none texts && echo text >texts/notes.txt && mkdir -p deep/er/still
for folder in none texts deep; do
  for baseline in none "$folder"; do
    expect 1 "$tyndall" compare $folder --baseline "$baseline" --report report.html --junit junit.xml
    grep -q "^tyndall: no picture: nothing was compared: there is no picture in $folder " err || fail "$folder: $(cat err)"
    python3 "$source_root/tests/app/_well_formed.py" report.html junit.xml || fail "$folder: the reports"
    grep -q 'tests="1" failures="1"' junit.xml && grep -q 'nothing was compared' report.html || fail "$folder: the reports"
  done
  expect 2 "$tyndall" compare $folder --baseline made --update
  [ ! -e made ] || fail 'a baseline of nothing'
done
expect 1 "$tyndall" compare texts --baseline none
grep -q '^tyndall: texts: left out, as their names end in none of .png .*: notes.txt$' err || fail "left out: $(cat err)"
complains_of() { grep -q "^tyndall: $1" err || fail "expected '$1' in: $(cat err)"; }
mkdir one && cp a.pfm one
expect 1 "$tyndall" compare none --baseline one
complains_of 'a.pfm: the baseline has it, and it was not rendered'

# Folders within the folder.
mkdir -p r/sub/deeper k/sub/deeper
for name in a.pfm sub/b.pfm sub/deeper/c.pfm; do cp a.pfm r/$name && cp a.pfm k/$name; done
expect 0 "$tyndall" compare r --baseline k
same 'pictures' 'ok a.pfm ok sub/b.pfm ok sub/deeper/c.pfm' "$(awk '{ print $1, $2 }' out | xargs)"
cp b.pfm r/sub/b.pfm
expect 1 "$tyndall" compare r --baseline k --junit junit.xml --report report.html
complains_of 'sub/b.pfm: FLIP is'
grep -q 'testcase classname="pictures" name="sub/b.pfm"' junit.xml && grep -q '<h2>sub/b.pfm ' report.html || fail 'the reports'
expect 0 "$tyndall" compare r --baseline k --update --max-flip 1
expect 0 "$tyndall" compare r --baseline k
cmp -s r/sub/b.pfm k/sub/b.pfm || fail 'the picture in the folder was not kept'
json k/tolerances.json sub/b.pfm | grep -q max_flip || fail "tolerances: $(cat k/tolerances.json)"
rm r/sub/deeper/c.pfm && mkdir r/new && cp a.pfm r/new/d.pfm
expect 1 "$tyndall" compare r --baseline k
complains_of 'sub/deeper/c.pfm: the baseline has it, and it was not rendered'
complains_of 'new/d.pfm: the baseline lacks it'
expect 0 "$tyndall" compare r --baseline k --update
complains_of 'sub/deeper/c.pfm: not rendered this time; the baseline keeps what it has'
[ -f k/sub/deeper/c.pfm ] && [ -f k/new/d.pfm ] || fail 'the update'

# What cannot be written is found before the first picture is copied.
cp -r k before && mkdir -p blocked && cp -r k/. blocked && rm blocked/sub/b.pfm && mkdir blocked/sub/b.pfm
cp b.pfm r/a.pfm && expect 3 "$tyndall" compare r --baseline blocked --update --max-flip 0.5
complains_of 'blocked/sub/b.pfm: cannot write'
diff -x b.pfm -r before blocked || fail 'the update stopped half done'
cp a.pfm r/a.pfm

# Links: to a folder elsewhere, in a circle, to themselves, to nothing.
mkdir elsewhere && cp a.pfm elsewhere/e.pfm
ln -s ../elsewhere r/linked && ln -s .. r/sub/up && ln -s . r/here && ln -s self r/self && ln -s gone r/gone.pfm
cp b.pfm k/gone.pfm
expect 1 timeout 60 "$tyndall" compare r --baseline k
complains_of 'linked/e.pfm: the baseline lacks it'
complains_of 'r: left out, as links to folders around them: here, sub/up$'
complains_of 'r: left out, as their names end in none of .*: self$'
complains_of 'gone.pfm: .*r/gone.pfm: cannot read'
rm -r r/linked r/sub/up r/here r/self r/gone.pfm k/gone.pfm

# The baseline within the folder is not compared with itself, nor the folder within the baseline missed in it.
rm -rf r k && mkdir -p r/kept && cp a.pfm r && cp a.pfm r/kept
expect 0 "$tyndall" compare r --baseline r/kept
same 'lines' 1 "$(wc -l <out)"
mkdir -p k/new && cp a.pfm k && cp a.pfm k/new
expect 0 "$tyndall" compare k/new --baseline k
same 'lines' 1 "$(wc -l <out)"

# Pictures of all kinds that can be read; what is no file fails and is not waited for.
"$tyndall" render cornell-box --size 16x8 --spp 1 -q -o k/box.PNG 2>log || fail "rendering: $(cat log)"
cp k/box.PNG k/new/box.PNG && cp k/box.PNG k/box.jpg && cp k/box.PNG k/new/box.jpg
mkfifo k/new/pipe.pfm && cp a.pfm k/pipe.pfm
expect 1 timeout 20 "$tyndall" compare k/new --baseline k
complains_of 'pipe.pfm: .*not an ordinary file'
same 'good pictures' 3 "$(grep -c '^ok ' out)"
[ "$(id -u)" = 0 ] || { mkdir k/new/closed && chmod 0 k/new/closed && expect 3 "$tyndall" compare k/new --baseline k; }
finish
