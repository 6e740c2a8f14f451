#!/usr/bin/env bash
# Which kernels a folder gets: those of this processor, all, or a list; what it keeps; and that packages need all. What
# "cmake --install" does after ./run, which builds the program alone: it installs that, and says what is not there.
. "$(dirname "$0")/_common.sh"
command -v cmake ninja >/dev/null || { echo 'skipped: cmake or ninja is missing'; exit 77; }
grep -q 'avx2' /proc/cpuinfo || { echo 'skipped: a processor with AVX2 is needed'; exit 77; }
configure() { cmake -S "$source_root" -B folder -G Ninja -DTYNDALL_TESTS=OFF -DTYNDALL_WINDOW=OFF -DTYNDALL_PYTHON=OFF "$@" >log 2>&1; }
built() { sed -n 's/^#define TYNDALL_BUILT_TARGETS //p' folder/generated/tyndall_targets.h; }
best=$(grep -q -w avx512vl /proc/cpuinfo && echo avx512 || echo avx2)

rm -rf folder
configure || fail "plain CMake: $(tail -3 log)"
same 'the sets of plain CMake' 'Target::scalar, Target::sse4, Target::avx2, Target::avx512' "$(built)"
configure -DTYNDALL_INSTRUCTION_SETS=native
same 'a folder that has more than native keeps it' 'Target::scalar, Target::sse4, Target::avx2, Target::avx512' "$(built)"
configure -DTYNDALL_INSTRUCTION_SETS='avx2;sse4'
same 'a list, in any order' 'Target::scalar, Target::sse4, Target::avx2' "$(built)"
configure -DTYNDALL_INSTRUCTION_SETS=scalar
same 'scalar alone' 'Target::scalar' "$(built)"
configure -DTYNDALL_INSTRUCTION_SETS=native
same 'native' "Target::scalar, Target::$best" "$(built)"
! (cd folder && cpack) >log 2>&1 || fail 'a folder that lacks sets was packed'
grep -q 'cmake --preset package' log || fail "what is needed for a package is not told: $(cat log)"
! configure -DTYNDALL_INSTRUCTION_SETS=avx3 || fail 'a set that does not exist was accepted'
grep -q 'found avx3, expected native, all, or a list of' log || fail "a wrong set: $(cat log)"

cp "$tyndall" folder/tyndall # stands for the one that would be built
expect 0 cmake --install folder --prefix "$PWD/there"
grep -q 'not built, so not installed: libtyndall\.so.*--target tyndall_library' err || fail "the library is not told: $(cat err)"
for file in bin/tyndall share/tyndall/scenes/showroom.json share/man/man1/tyndall.1.gz; do
  [ -s "there/$file" ] || fail "$file was not installed"
done
[ -z "$(find there -name 'libtyndall*')" ] || fail 'a library comes from somewhere'
expect 0 env -u TYNDALL_ASSETS there/bin/tyndall scenes
finish
