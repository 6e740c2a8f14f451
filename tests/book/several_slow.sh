#!/usr/bin/env bash
# Programs of several source files, and options that do not fit a program's scene.
. "$(dirname "$0")/_program.sh"
cp -r "$source_root/tests/book/several" several && cp "$source_root/tests/book/headers/books.h" several/include

expect 0 "$tyndall" convert several/main.cc several/world.cc -I several/include -o several.json
same 'the header that -I names' "$(json several.json background)" '[0.125, 0.25, 0.5]'
expect 2 "$tyndall" render several/main.cc -I several/include --set /camera/vfov=300 -q -o small.png
complains 'several/main.cc: /camera/vfov: found 300'
expect 0 "$tyndall" chart several/main.cc -I several/include --size 8x6 --budget 1 -q -o chart.svg
# A source file beside the header that announces its functions is found; one of another name is not.
expect 0 "$tyndall" convert several/main.cc -Iseveral/include -o beside.json
same 'the source file beside world.h' "$(cat beside.json)" "$(cat several.json)"
# So is a folder of headers beside main.cc, or beside its folder.
expect 0 "$tyndall" convert several/main.cc -o beside.json
same 'the folder of headers' "$(cat beside.json)" "$(cat several.json)"
mv several/world.cc several/balls.cc
expect 2 "$tyndall" convert several/main.cc -Iseveral/include -o several.json
complains 'several/main.cc: undefined reference to' 'balls()' 'name that, too'
expect 2 "$tyndall" convert several/main.cc several.json -o refused.json
complains 'unexpected argument "several.json"'

finish
