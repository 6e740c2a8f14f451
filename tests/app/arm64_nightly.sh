#!/usr/bin/env bash
# The program for 64-bit ARM: cross compiled without a warning, and run by qemu-user. Its scalar kernels give the bits of
# this processor's scalar ones, NEON those of the instruction sets that fuse multiplication and addition like it, the lanes do
# what they do one by one, and "tyndall verify" passes (of the scalar kernels a choice of cases). Takes two hours or three.
. "$(dirname "$0")/_common.sh"
scratch=$PWD
skip() { echo "skipped: $*"; exit 77; }
command -v aarch64-linux-gnu-g++ >probe || skip 'the cross compiler is missing (g++-aarch64-linux-gnu)'
qemu=$(command -v qemu-aarch64-static || command -v qemu-aarch64) || skip 'qemu-user is missing (qemu-user-static)'
"$tyndall" version | grep -q '^kernels .* runs .* avx2' || skip 'there is nothing to compare with: this processor has no AVX2'
cd "$source_root" || exit 1
libraries=$PWD/build/arm64-libraries
third_party/arm64_libraries.sh "$libraries" || skip 'the libraries cannot be fetched'
cmake --preset arm64 >"$scratch/cmake.log" 2>&1 || { cat "$scratch/cmake.log"; fail 'cmake'; finish; }
cmake --build build/arm64 --target tyndall core_tests >"$scratch/build.log" 2>&1 || { tail -50 "$scratch/build.log"; fail 'building'; finish; }
cd "$scratch" || exit 1
grep -n 'warning:' build.log && fail 'the compiler warns'
on_arm() { "$qemu" -L "$libraries" "$@"; }
arm=$source_root/build/arm64/tyndall
on_arm "$arm" version | grep -q '^kernels  *scalar neon; this CPU runs scalar neon$' || fail "version: $(on_arm "$arm" version)"

arm_hash() { renderer=(on_arm "$arm") && image_hash "$@"; }
pictures=0
for scene in $("$tyndall" scenes | awk '{ print $1 }'); do
  small=("$scene" --size 32x24 --samples 0:8 -t 1)
  same "$scene, scalar" "$(arm_hash "${small[@]}" --isa scalar)" "$(image_hash "${small[@]}" --isa scalar)"
  same "$scene, neon" "$(arm_hash "${small[@]}" --isa neon)" "$(image_hash "${small[@]}" --isa avx2)"
  pictures=$((pictures + 2))
done
echo "$pictures pictures compared"
[ "$pictures" -gt 100 ] || fail 'too few scenes'

on_arm "$source_root/build/arm64/tests/core_tests" --source-file='*/tests/base/*,*/tests/targets/kernel_sets_test.cpp,*/tests/clean/*' >tests.log ||
  { cat tests.log; fail 'unit tests'; }
# Its progress is in neon.progress, because this takes longest by far.
on_arm "$arm" verify --progress plain --isa neon >verify.log 2>neon.progress || { cat verify.log; fail 'verify, neon'; }
tail -2 verify.log
on_arm "$arm" verify -q --isa scalar "${quick_cases[@]}" >verify.log || { cat verify.log; fail 'verify, scalar'; }
tail -2 verify.log
finish
