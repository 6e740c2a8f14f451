#!/usr/bin/env bash
# A program is compiled and run only where it is named as the scene on the command line. Any other way to a C++ source
# file never starts a compiler.
. "$(dirname "$0")/_program.sh"
mkdir folder
program folder/main <<<'int main() {}'
mkdir temporary
export TMPDIR=$PWD/temporary

# compiled: whether a temporary folder was made for a compiler since the last question.
compiled() {
  local changed
  changed=$(stat -c %Y temporary)
  touch -d 2000-01-01 temporary
  [ "$changed" != "$(stat -c %Y temporary)" ]
}
refuses() { # CODE COMMAND...: fails so, and nothing was compiled
  expect "$@"
  if compiled; then fail "compiled by: ${*:2}"; fi
}
compiled
echo '{ "tyndall": 1, "textures": { "t": { "type": "image", "file": "folder/main.cc" } } }' >texture.json
refuses 2 "$tyndall" inspect texture.json
refuses 2 "$tyndall" convert texture.json -o out.json
expect 2 "$tyndall" inspect - <folder/main.cc
if compiled; then fail 'compiled from standard input'; fi
cp folder/main.cc renamed.json
refuses 2 "$tyndall" inspect renamed.json
"$tyndall" render showroom --size 8x8 --spp 1 -q -o picture.png
refuses 3 "$tyndall" compare folder/main.cc picture.png
"$tyndall" compare picture.png --baseline kept --update >/dev/null
cp folder/main.cc kept/
refuses 1 "$tyndall" compare folder --baseline kept
refuses 0 "$tyndall" compare picture.png --baseline kept
refuses 3 "$tyndall" chart showroom --reference folder/main.cc --budget 1 -o chart.svg
refuses 2 "$tyndall" merge folder/main.cc -o out.exr
refuses 2 "$tyndall" denoise folder/main.cc -o out.png
refuses 2 "$tyndall" render showroom --set /textures/t='{"type":"image","file":"folder/main.cc"}' -o out.png
grep -rlE --exclude=README.md '\.(cc|cpp|cxx)|c\+\+' "$source_root/assets/desktop" && fail 'the desktop opens C++ files by the program'

# Named as the scene it is compiled.
expect 2 "$tyndall" inspect folder/main.cc
compiled || fail 'no temporary folder is made'

finish
