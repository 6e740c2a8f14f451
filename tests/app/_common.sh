# shellcheck shell=bash
# Sourced by the command tests with their own arguments: the program, a scratch folder, the source root.
# The tests run in an empty folder below the scratch folder.
set -u
tyndall=$1
source_root=$3
export source_root
# shellcheck disable=SC2034 # used where this is sourced
# Cases of "tyndall verify", of all models, for where it runs so slowly that all cases would take hours.
quick_cases=(motion furnace fuzzy-ball/fuzz1-b0.99 coloured-glass/n1.5-density1-b0.5 smoke-ball/inside-density1 square-lamp small-lamp)
cd "$2" && rm -rf work && mkdir work && cd work || exit 1
failures=0

fail() {
  echo "FAIL: $*"
  failures=$((failures + 1))
}

# expect CODE COMMAND...: runs it with its output in the files out and err, and checks the exit code.
expect() {
  local code=$1 got=0
  shift
  "$@" >out 2>err </dev/null || got=$?
  [ "$got" -eq "$code" ] || fail "exit code $got instead of $code: ${*/#$tyndall/tyndall}: $(cat err)"
}

# complains TEXT...: standard error is one line, begins with "tyndall: " and contains each TEXT; nothing on standard output.
complains() {
  local text
  [ "$(wc -l <err)" -eq 1 ] || fail "expected one line on standard error: $(cat err)"
  grep -q '^tyndall: ' err || fail "expected 'tyndall: ': $(cat err)"
  [ ! -s out ] || fail "standard output is not empty: $(cat out)"
  for text in "$@"; do
    grep -qF -- "$text" err || fail "expected '$text' in: $(cat err)"
  done
}

# json FILE KEY: the value of a key that has a line of its own, as files of Tyndall have it.
json() {
  sed -n "s/^ *\"$2\": \(.*[^,]\),\{0,1\}\$/\1/p" "$1"
}

# same NAME A B: fails, and names what differs, unless A and B are equal.
same() {
  [ "$2" = "$3" ] || fail "$1: '$2' and '$3' differ"
}

# image_hash RENDER-OPTIONS...: renders by "renderer", which is the program, and prints the image's hash.
renderer=("$tyndall")
image_hash() {
  "${renderer[@]}" render "$@" -q -o hashed.pfm --stats hashed.json </dev/null && json hashed.json image_hash
}

# finish: fails if anything has failed, or if a file is left that was only half written.
finish() {
  local left
  left=$(find . -name '*.tmp-*')
  [ -z "$left" ] || fail "left behind: $left"
  [ "$failures" -eq 0 ] || echo "$failures failures"
  exit $((failures > 0))
}
