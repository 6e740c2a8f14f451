#!/usr/bin/env bash
# render --replay: one path, in words and to the last bit.
. "$(dirname "$0")/_common.sh"

# The last line is what the scalar kernel renders, for any sample of any pixel.
for key in "3 4 0" "20 11 1" "31 23 6"; do
  read -r x y sample <<<"$key"
  for scene in showroom cornell-smoke next-week; do
    expect 0 "$tyndall" render "$scene" --size 32x24 --replay "$x,$y,$sample"
    cp out path.txt
    [ ! -s err ] || fail "standard error is not empty: $(cat err)"
    expect 0 "$tyndall" render "$scene" --size 32x24 --region "$x,$y,$((x + 1)),$((y + 1))" \
      --samples "$sample:$((sample + 1))" --isa scalar -q -o one.pfm
    python3 - path.txt one.pfm <<'CHECK' || fail "$scene: sample $sample of $x,$y"
import struct, sys
lines = open(sys.argv[1]).read().splitlines()
assert lines[0] == "0 camera" and lines[-1].startswith("sample ")
value = struct.pack("<3f", *map(float, lines[-1].split()[1:]))
assert value == open(sys.argv[2], "rb").read()[-12:], (lines[-1], struct.unpack("<3f", value))
assert sum(line.startswith("    throughput") for line in lines) >= 1
CHECK
  done
done

# What is met is named as in the file; places are the scene's own.
expect 0 "$tyndall" render cornell-box --size 32x24 --replay 16,4,0 --set /camera/look_from=[278,278,-800]
grep -q '^    point       278 278 -800$' out || fail "the camera: $(cat out)"
grep -Eq '^1 after [0-9.]+ meets .* \(white\), ' out || fail "the ceiling: $(cat out)"
expect 0 "$tyndall" render cornell-box --size 32x24 --max-depth 0 --replay 16,12,0
grep -q 'is cut at max_depth' out || fail "the cut: $(cat out)"

# Light that chains found is said to be theirs.
expect 0 "$tyndall" render stress-caustic-shell --size 32x24 --replay 10,20,1
grep -q '^    by chains   [0-9]' out || fail "no chains: $(cat out)"
expect 0 "$tyndall" render stress-caustic-shell --size 32x24 --replay 10,20,1 --caustics scatter
! grep -q 'by chains' out || fail "chains by chance: $(cat out)"

# Requests that cannot be fulfilled are refused.
expect 2 "$tyndall" render showroom --size 32x24 --replay 32,0,0
complains '--replay' '32,0' '32x24'
expect 2 "$tyndall" render showroom --replay 1,2
complains '--replay' 'X,Y,SAMPLE'
expect 2 "$tyndall" render showroom --replay 1,2,-3
complains '--replay' 'X,Y,SAMPLE'
expect 2 "$tyndall" render showroom --replay 1,2,3 -o a.png
complains '--replay' '-o'
expect 2 "$tyndall" render nowhere.json --replay 1,2,3
complains 'nowhere.json'

finish
