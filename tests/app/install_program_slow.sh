#!/usr/bin/env bash
# What "cmake --install" does after ./run, which builds the program alone: it installs that, and says what is not there.
. "$(dirname "$0")/_common.sh"
[ -f "$(dirname "$tyndall")/cmake_install.cmake" ] || { echo "skipped: the program lies in no build folder"; exit 77; }
cmake -S "$source_root" -B build -G Ninja -DCMAKE_BUILD_TYPE=Release -DTYNDALL_TESTS=OFF >log 2>&1 || { cat log; fail 'cmake'; }
cp "$tyndall" build/tyndall # stands for the one that would be built
expect 0 cmake --install build --prefix "$PWD/there"
grep -q 'not built, so not installed: libtyndall\.so.*--target tyndall_library' err || fail "the library is not told: $(cat err)"
for file in bin/tyndall share/tyndall/scenes/showroom.json share/man/man1/tyndall.1.gz; do
  [ -s "there/$file" ] || fail "$file was not installed"
done
[ -z "$(find there -name 'libtyndall*')" ] || fail 'a library comes from somewhere'
expect 0 env -u TYNDALL_ASSETS there/bin/tyndall scenes
finish
