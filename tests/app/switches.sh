#!/usr/bin/env bash
# Variables of the environment that say yes or no, as scripts read them: in any case of letters, and nothing else.
. "$(dirname "$0")/_common.sh"
# says CODE FUNCTION: what it answers.
says() { expect "$1" bash -c ". '$source_root/third_party/switches.sh'; $2"; }
for yes in 1 yes true on YES On; do
  TYNDALL_SOME=$yes says 0 'is_on TYNDALL_SOME'
done
for no in '' 0 no false off NO False; do
  TYNDALL_SOME=$no says 1 'is_on TYNDALL_SOME'
  CI=$no says 1 in_ci
done
(unset CI && says 1 'is_on TYNDALL_SOME || in_ci')
CI=Jenkins says 0 in_ci
for neither in 2 maybe ' '; do
  TYNDALL_SOME=$neither says 2 'is_on TYNDALL_SOME; exit 0'
  grep -qF "TYNDALL_SOME: found \"$neither\", expected 1, yes, true or on, or 0, no" err || fail "$neither: $(cat err)"
done
TYNDALL_SKIP_PACKAGES=perhaps expect 2 "$source_root/run" --help
grep -q '^TYNDALL_SKIP_PACKAGES: found "perhaps", expected 1' err || fail "run: $(cat err)"
finish
