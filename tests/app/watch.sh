#!/usr/bin/env bash
# The library for programs with samples of their own: installed, found by CMake and by pkg-config, used from C++17, C99
# and Python, without a window. tests/window/watch_slow.sh opens its window.
. "$(dirname "$0")/_common.sh"
build=$(dirname "$tyndall")
[ -f "$build/cmake_install.cmake" ] || { echo "skipped: $build is no build folder"; exit 77; }
[ -e "$build/libtyndall-watch.so" ] || { echo "skipped: $build has no library"; exit 77; }
unset DISPLAY WAYLAND_DISPLAY
cmake --install "$build" --prefix "$PWD/there" --strip >log 2>&1 || { cat log; fail 'cmake --install failed'; }
mv there moved # the tree works wherever it is
library=$(find "$PWD/moved" -name libtyndall-watch.so.0)
[ -n "$library" ] || fail 'no library was installed'
folder=$(dirname "$library")
flags=$(PKG_CONFIG_PATH=$folder/pkgconfig pkg-config --cflags --libs tyndall-watch) || fail 'pkg-config'
export LD_LIBRARY_PATH=$folder

# Nothing but what the header declares is seen by programs, and what the library is called is its name.
same 'names' 'tyndall_watch tyndall_watch_fail' "$(nm -D --defined-only "$library" | awk '{ print $3 }' | sort | xargs)"
readelf -d "$library" | grep -q 'SONAME.*\[libtyndall-watch.so.0\]' || fail 'the soname'
! readelf -d "$library" | grep -qE 'RPATH|RUNPATH|TEXTREL' || fail 'the library looks elsewhere, or is changed when loaded'

strict='-Wall -Wextra -Wpedantic -Werror -Wconversion -Wshadow'
# shellcheck disable=SC2086
${CXX:-c++} -std=c++17 -O1 $strict "$source_root/tests/app/watch/probe.cpp" -o probe $flags || fail 'C++17'
# shellcheck disable=SC2086
${CC:-cc} -std=c99 $strict "$source_root/assets/examples/watch/rings.c" -o rings $flags -lm || fail 'C99'

# Each pixel is the mean of its own samples, whatever the number of threads; one file's format goes by its ending.
values() {
  python3 - "$1" <<'PY'
import struct, sys
with open(sys.argv[1], "rb") as file:
    assert file.readline() == b"PF\n"
    width, height = map(int, file.readline().split())
    assert file.readline() == b"-1.0\n"
    data = struct.unpack(f"<{3 * width * height}f", file.read())
wrong = [(x, y) for y in range(height) for x in range(width)
         if data[3 * ((height - 1 - y) * width + x):][:3] != (x, y, 4)]
print(width, height, len(wrong), "wrong")
PY
}
expect 0 ./probe colours
expect 0 ./probe place a.pfm
same 'values' '40 30 0 wrong' "$(values a.pfm)"
expect 0 ./probe twice b.pfm
cmp a.pfm b.pfm && cmp a.pfm again-b.pfm || fail 'the second picture of a program differs'
expect 0 ./probe threads c.pfm
same 'values of threads' '64 64 0 wrong' "$(values c.pfm)"
same 'threads' 'at most 3 at once' "$(cat out)"
for ending in png ppm hdr; do expect 0 ./probe place a.$ending; done
if has_exr; then
  expect 0 ./probe place a.exr
  expect 0 "$tyndall" compare a.exr a.pfm --max-rmse 0
fi
expect 0 ./rings rings.pfm
expect 0 python3 "$source_root/assets/examples/watch/rings.py" python.pfm
[ -s python.pfm ] || fail 'nothing from Python'

# Found by CMake: a program is configured and built.
if [ -z "${TYNDALL_THOROUGH:-}" ]; then
  : # ./test --all does that
elif cmake -S "$source_root/assets/examples/watch" -B example -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$PWD/moved" >log 2>&1 &&
  cmake --build example >>log 2>&1; then
  expect 0 example/rings cmake.pfm
  cmp rings.pfm cmake.pfm || fail 'the program built by CMake renders something else'
  expect 0 env -u LD_LIBRARY_PATH example/ball ball.png
else
  cat log
  fail 'find_package(tyndall)'
fi

# What fails is told once, with its pixel and sample, and left out.
told() { # HOW TEXT...
  expect 1 ./probe "$1" failed.pfm :: "pixel (3, 4), sample 2: " "${@:2}"
  rm failed.pfm || fail 'no picture'
}
told throws 'no mesh\nhere'
told throws-other 'no std::exception'
told nan 'found (1, nan, 1), expected finite numbers'
told infinite 'found (1, 1, inf)'
expect 1 ./probe silent failed.pfm
same 'lines' 2 "$(wc -l <err)"
grep -q '^tyndall: 16 samples have failed; the first: pixel (0, 0), sample 0: found (nan, nan, nan)' err || fail "$(cat err)"

# The program's own things stay as they were.
expect 0 ./probe process p.pfm
same 'process' 'rounds still signals C' "$(cat out)"

# What is wrong is one line.
expect 2 ./probe size x.png 0 10 :: 'found a picture of 0x10 pixels, expected 1 to 65536'
for size in '-3 10' '10 70000' '2147483647 2147483647'; do
  # shellcheck disable=SC2086
  expect 2 ./probe size x.png $size :: 'expected 1 to 65536'
done
expect 2 ./probe size x.png 65536 65536 :: '65536x65536 pixels'
expect 2 ./probe null :: 'found no function'
expect 2 ./probe wrong-size :: 'size of the options: found 0'
expect 2 ./probe wrong-threads x.png :: 'threads: found -1'
expect 2 ./probe wrong-reference x.png :: 'reference: found "cover", expected none beside output'
expect 2 ./probe place x.jpg :: "found \"x.jpg\", expected a name that ends in .png"
expect 3 ./probe place nowhere/x.png :: 'nowhere/x.png: cannot write: there is no folder nowhere'
expect 3 ./probe place - :: 'no display' 'option output'
no_leftovers
finish
