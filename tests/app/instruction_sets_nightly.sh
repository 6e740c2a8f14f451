#!/usr/bin/env bash
# A program with scalar kernels alone, on a processor that has more: renders only when told so.
. "$(dirname "$0")/_common.sh"
grep -q 'avx2' /proc/cpuinfo || { echo 'skipped: a processor with AVX2 is needed'; exit 77; }
cmake -S "$source_root" -B folder -G Ninja -DTYNDALL_TESTS=OFF -DTYNDALL_PYTHON=OFF -DTYNDALL_INSTRUCTION_SETS=scalar >log 2>&1 &&
  cmake --build folder --target tyndall >>log 2>&1 || { tail -20 log; fail 'the scalar program was not built'; finish; }
scalar=$PWD/folder/tyndall
"$scalar" version | grep -q '^kernels  *scalar; this CPU runs scalar, and could run sse4 avx2' || fail "version: $("$scalar" version)"
for command in 'render quads --size 16x16 --spp 1 -o x.png' 'sweep quads --size 16x16 --spp 1 --vary /camera/vfov=30:40:2 -o y.png' \
  'animate quads --size 16x16 --spp 1 --turntable --frames 1 -o z%d.png'; do
  # shellcheck disable=SC2086
  expect 2 "$scalar" $command
  grep -q 'only the scalar kernels.*TYNDALL_INSTRUCTION_SETS=all ./run.*--isa scalar' err || fail "the way out is not told: $(cat err)"
  # shellcheck disable=SC2086
  expect 0 "$scalar" $command --isa scalar
done
finish
