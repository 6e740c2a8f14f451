#!/usr/bin/env bash
# Every C++ file of app, core and tests looks as clang-format writes it. The version counts: others break lines
# elsewhere. Skipped where that version is not installed; "./test --all" installs it.
set -euo pipefail
cd "$3"

tool=clang-format-14
if ! command -v "$tool" >/dev/null; then
  echo "skipped: $tool is not installed"
  exit 77
fi
mapfile -t files < <(find app core tests -name '*.cpp' -o -name '*.h' | sort)
if ! "$tool" --dry-run --Werror "${files[@]}" 2>"$2/report"; then
  grep -oE "^[^ :]+:[0-9]+:[0-9]+: error" "$2/report" | cut -d: -f1,2
  echo "FAIL: to mend: $tool -i FILE..."
  exit 1
fi
echo "${#files[@]} files"
