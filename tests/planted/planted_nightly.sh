#!/usr/bin/env bash
# Bugs planted in every room of core, and whether the tests catch them. Takes half an hour.
. "$(dirname "$0")/../app/_common.sh"
python3 -B "$source_root/tests/planted/planted.py" "$source_root" "$(dirname "$tyndall")/planted" || fail 'a planted bug survived'
finish
