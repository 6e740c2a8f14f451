#!/usr/bin/env bash
# Programs of several source files, options that do not fit a program's scene, and a chart of one.
. "$(dirname "$0")/../app/_common.sh"
cp -r "$source_root/tests/book" copy

expect 2 "$tyndall" render copy/newest/main.cc --set /camera/vfov=300 -q -o small.png
complains 'newest/main.cc: /camera/vfov: found 300'
expect 0 "$tyndall" chart copy/newest/main.cc --size 8x6 --budget 1 -q -o chart.svg

# Several source files, and folders of headers.
expect 0 "$tyndall" convert copy/several/main.cc copy/several/world.cc -I copy/several/include -o several.json
same 'the header that -I names' "$(json several.json background)" '[0.125, 0.25, 0.5]'
# A source file beside the header that announces its functions is found; one of another name is not.
expect 0 "$tyndall" convert copy/several/main.cc -Icopy/several/include -o beside.json
same 'the source file beside world.h' "$(cat beside.json)" "$(cat several.json)"
mv copy/several/world.cc copy/several/balls.cc
expect 2 "$tyndall" convert copy/several/main.cc -Icopy/several/include -o several.json
complains 'several/main.cc: undefined reference to' 'balls()' 'name that, too'
expect 2 "$tyndall" convert copy/several/main.cc several.json -o refused.json
complains 'unexpected argument "several.json"'

finish
