#!/usr/bin/env bash
# The program by clang, with GCC's standard library and with clang's own: built without a warning, it draws the same bits.
# Takes an hour.
. "$(dirname "$0")/_common.sh"
skip() { echo "skipped: $*"; exit 77; }
command -v clang++ >probe || skip 'clang is missing (clang)'
clang++ -stdlib=libc++ -fsyntax-only -x c++ - <<<'#include <vector>' 2>probe || skip "clang's library is missing (libc++-dev, libc++abi-dev)"
scratch=$PWD
for preset in clang clang-libcxx; do
  (cd "$source_root" && cmake --preset $preset -B "$scratch/$preset" && cmake --build "$scratch/$preset" --target tyndall) >$preset.log 2>&1 ||
    { tail -50 $preset.log; fail "$preset: building"; continue; }
  ! grep -n 'warning:' $preset.log || fail "$preset warns"
  for isa in $("$tyndall" version | sed -n 's/^kernels .* runs //p'); do
    picture=(cornell-smoke --size 32x32 --spp 8 --isa "$isa")
    same "$preset, $isa" "$(image_hash "${picture[@]}")" "$(renderer=("$scratch/$preset/tyndall") && image_hash "${picture[@]}")"
  done
done
finish
