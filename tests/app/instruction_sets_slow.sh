#!/usr/bin/env bash
# Which kernels a folder gets: those of this processor, all, or a list; what it keeps; and that packages need all.
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

# ./run configures anew on another processor, and where other sets are asked for, and only then.
mkdir -p tree stand-ins
cp -r "$source_root/run" "$source_root/third_party" tree
cat >stand-ins/cmake <<'MSG'
#!/bin/sh
case $1 in
  --preset)
    mkdir -p "$4" && echo >"$4/build.ninja" && grep -m1 -E '^(flags|Features)' /proc/cpuinfo >"$4/processor.txt"
    echo "$5" >>configured
    echo "TYNDALL_INSTRUCTION_SETS:STRING=$(expr "${5:-=native}" : '.*=\(.*\)')" >"$4/CMakeCache.txt" ;;
  --build) printf '#!/bin/sh\n' >"$2/tyndall" && chmod +x "$2/tyndall" ;;
esac
MSG
chmod +x stand-ins/cmake
export PATH=$PWD/stand-ins:$PATH TYNDALL_SKIP_PACKAGES=1
expect 0 tree/run version
expect 0 tree/run version
same 'configured once' 1 "$(wc -l <tree/configured)"
expect 0 env TYNDALL_INSTRUCTION_SETS=all tree/run version
expect 0 tree/run version
same 'configured for all, and kept' $'\n-DTYNDALL_INSTRUCTION_SETS=all' "$(cat tree/configured)"
echo 'flags : of another processor' >tree/build/release/processor.txt
expect 0 tree/run version
same 'configured on another processor, for all' 3 "$(grep -c '' tree/configured)"
finish
