#!/usr/bin/env bash
# compare --max-z: no false alarms in 1,000 re-seeded pairs, and planted changes above the floor of noise are found.
. "$(dirname "$0")/_common.sh"
has_exr || finish
python3 "$source_root/tests/app/noise_pairs.py" "$tyndall" --scratch "$PWD" || fail 'false alarms or missed changes'
finish
