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

# expect CODE COMMAND... [:: TEXT...] [:out PATTERN...] [:err PATTERN...] [:quiet]: runs it with its output in the files out
# and err, and checks the exit code; then that it complains with each TEXT, that lines have these patterns, that err is empty.
expect() {
  local code=$1 got=0 count=0 words=("${@:2}") word where=
  while [ "$count" -lt "${#words[@]}" ] && [[ ! ${words[count]} =~ ^:(:|out|err|quiet)$ ]]; do count=$((count + 1)); done
  local command="${words[*]:0:count}"
  "${words[@]:0:count}" >out 2>err </dev/null || got=$?
  [ "$got" -eq "$code" ] || fail "exit code $got instead of $code: ${command/#$tyndall/tyndall}: $(cat err)"
  for word in "${words[@]:count}"; do
    case $word in
      ::) where=complaint && complains ;;
      :out | :err) where=${word#:} ;;
      :quiet) [ ! -s err ] || fail "standard error is not empty: $command: $(cat err)" ;;
      *)
        if [ $where = complaint ]; then
          grep -qF -- "$word" err || fail "expected '$word' in: $(cat err)"
        else
          grep -q -- "$word" $where || fail "expected '$word' in what this says: $command: $(cat $where)"
        fi
        ;;
    esac
  done
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

# has_exr: whether this build reads and writes EXR.
has_exr() {
  "$tyndall" render cornell-box --size 8x8 --spp 1 -q -o probe.exr 2>probe.err && return 0
  grep -q OpenEXR probe.err || fail "probing for EXR: $(cat probe.err)"
  return 1
}

# json FILE KEY: the value of a key of a JSON file, as JSON; fails if the file is not strict JSON.
json() {
  python3 -c '
import json, sys
def refuse(name): raise ValueError(name + " is not JSON")
print(json.dumps(json.load(open(sys.argv[1]), parse_constant=refuse)[sys.argv[2]]))' "$1" "$2"
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

# no_leftovers: fails if a file is left that was only half written.
no_leftovers() {
  local left
  left=$(find . -name '*.tmp-*')
  [ -z "$left" ] || fail "left behind: $left"
}

finish() {
  no_leftovers
  [ "$failures" -eq 0 ] || echo "$failures failures"
  exit $((failures > 0))
}
