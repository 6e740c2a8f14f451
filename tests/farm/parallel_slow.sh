#!/usr/bin/env bash
# assets/farm/parallel.sh on this machine alone: the bits of one render, also when it is started again after half of it.
. "$(dirname "$0")/../app/_common.sh"
command -v parallel >probe || { echo 'skipped: GNU parallel is missing'; exit 77; }
export HOME=$PWD TYNDALL=$tyndall SHARDS=4 SAMPLES=10
mkdir -p .parallel && touch .parallel/will-cite
whole=$(image_hash cornell-smoke --size 24x24 --samples 0:10)
expect 0 "$source_root/assets/farm/parallel.sh" cornell-smoke farm.exr --size 24x24
same 'standard output' 'farm.exr: all 10 samples' "$(tail -1 out)"
rm farm.exr farm.exr.parts/2.exr
expect 0 "$source_root/assets/farm/parallel.sh" cornell-smoke farm.exr --size 24x24
expect 0 "$tyndall" render cornell-smoke --size 24x24 --samples 0:10 --resume -q -o farm.exr --stats farm.json
same 'hash' "$whole" "$(json farm.json image_hash)"
expect 2 env SHARDS=11 "$source_root/assets/farm/parallel.sh" cornell-smoke farm.exr
expect 2 "$source_root/assets/farm/parallel.sh" cornell-smoke
finish
