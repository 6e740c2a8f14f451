#!/usr/bin/env bash
# Renders longer than the usual interval of checkpoints: their film is kept without being asked for; without an .exr output
# it is said that nothing is kept.
. "$(dirname "$0")/_common.sh"
has_exr || finish

long=(render cornell-box --size 64x64 --spp 16000000 -t 1 -q)
"$tyndall" "${long[@]}" -o kept.exr 2>kept.err &
kept=$!
"$tyndall" "${long[@]}" -o image.png 2>image.err &
image=$!
sleep 25
[ ! -e kept.exr ] || fail 'a checkpoint before 30 seconds'
sleep 10
kill -KILL "$kept" "$image"
wait "$kept" "$image" 2>/dev/null
grep -aq unfinished kept.exr || fail 'no checkpoint after 35 seconds'
[ ! -s kept.err ] || fail "with a checkpoint it says: $(cat kept.err)"
[ "$(wc -l <image.err)" -eq 1 ] && grep -q 'nothing is kept' image.err || fail "nothing is kept, and it says: $(cat image.err)"
expect 0 "$tyndall" "${long[@]}" --spp 1 --time 1 -o kept.exr
finish
