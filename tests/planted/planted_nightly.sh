#!/usr/bin/env bash
# Bugs planted in every room of core, and whether the tests catch them. Takes a quarter of an hour.
. "$(dirname "$0")/../app/_common.sh"
python3 -B "$source_root/tests/planted/planted.py" "$source_root" "$(dirname "$tyndall")" "$PWD/planted" || fail 'a planted bug survived'
finish
