#!/usr/bin/env bash
# Which lines of core its quick tests and a choice of the cases of "tyndall verify" run: at least 90 %. A build of its own in
# build/coverage, without the wide instruction sets, whose kernels are the same lines. A line of a header counts as run if
# any of its instances was. Threads count without waiting for each other: a count may be too small then, but never 0. The
# table of all files is kept in coverage.txt.
. "$(dirname "$0")/_common.sh"
scratch=$PWD
command -v gcovr >probe || { echo 'skipped: gcovr is missing'; exit 77; }
cd "$source_root" || exit 1
build=$PWD/build/coverage
cmake --preset coverage >"$scratch/cmake.log" 2>&1 || { cat "$scratch/cmake.log"; fail 'cmake'; finish; }
cmake --build "$build" --target core_tests tyndall >"$scratch/build.log" 2>&1 || { tail -50 "$scratch/build.log"; fail 'building'; finish; }
find "$build" -name '*.gcda' -delete
(cd "$scratch" && "$build/tests/core_tests" >tests.log && "$build/tyndall" verify -q "${quick_cases[@]}" >verify.log) || fail "tests: $(tail -n 5 "$scratch/tests.log")"
gcovr --root . --filter core/ --object-directory "$build" --exclude-unreachable-branches --exclude-throw-branches \
  --gcov-ignore-parse-errors -j 2 --fail-under-line 90 "$build" >"$scratch/coverage.txt" 2>"$scratch/gcovr.log" ||
  fail "coverage: $(tail -3 "$scratch/gcovr.log")"
cd "$scratch" || exit 1
grep '^TOTAL' coverage.txt
finish
