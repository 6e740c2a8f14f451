#!/usr/bin/env bash
# clang-tidy has nothing to say about app and core; .clang-tidy lists what it looks for, and why not for more. It reads
# each folder as one file (TYNDALL_QUICK_BUILD): that takes about two minutes of one core, less than file by file, and
# also shows two files of a folder that give one name to two things. Skipped where the tool is not installed;
# "./test --all" installs it.
set -euo pipefail
scratch=$2
root=$3

tool=clang-tidy-14
if ! command -v "$tool" >/dev/null; then
  echo "skipped: $tool is not installed"
  exit 77
fi
build=$scratch/build
cmake -S "$root" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DTYNDALL_QUICK_BUILD=ON -DTYNDALL_TESTS=OFF >/dev/null
if grep -q tyndall_shader_header "$build/build.ninja"; then
  cmake --build "$build" --target tyndall_shader_header tyndall_glad >/dev/null # headers that are generated
fi
sed -i -E 's/ -(flive-range-shrinkage|fno-gcse-after-reload|m(move|store)-max=[0-9]+|-param=[^ ]+)//g' "$build/compile_commands.json" # options of GCC alone
sed -n -E '/(\.c|\/empty\.cpp)"/!s/^ *"file": "(.*)",?$/\1/p' "$build/compile_commands.json" >"$scratch/files"
[ -s "$scratch/files" ] || { echo "FAIL: nothing to look at in $build/compile_commands.json"; exit 1; }

status=0
# A unit that joins files does nothing but include them. This version of Clang does not know the name of every feature
# that the program asks the processor for.
xargs -P 2 -n 1 "$tool" -p "$build" --quiet --config-file="$root/.clang-tidy" \
  --checks=-bugprone-suspicious-include --warnings-as-errors='*' '--extra-arg=-D__builtin_cpu_supports(name)=0' \
  <"$scratch/files" >"$scratch/report" 2>"$scratch/errors" || status=$?
if [ "$status" -ne 0 ]; then
  grep -E '(warning|error):' "$scratch/report" "$scratch/errors" -h | sort -u
  echo "FAIL: findings of $tool"
  exit 1
fi
echo "$(wc -l <"$scratch/files") units"
