#!/usr/bin/env bash
# A hundred shards of 1920x1080 pixels, in random order, are merged in the memory of three films, to the picture of one
# render.
. "$(dirname "$0")/_common.sh"
has_exr || finish

scene=(cornell-box --size 1920x1080 --max-depth 2 -q)
for i in $(seq 0 99); do
  expect 0 "$tyndall" render "${scene[@]}" --samples "$i:$((i + 1))" -o "$i.exr"
done
mapfile -t parts < <(seq -f %g.exr 0 99 | shuf)
cat >peak.py <<'PYTHON'
import resource, subprocess, sys
code = subprocess.run(sys.argv[1:]).returncode
print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss // 1024)
sys.exit(code)
PYTHON
expect 0 python3 peak.py "$tyndall" merge "${parts[@]}" -o all.pfm
merging=$(cat out)
expect 0 "$tyndall" render "${scene[@]}" --spp 100 -o one.pfm --stats one.json
cmp -s all.pfm one.pfm || fail 'the merged picture is not that of one render'
film=$((1920 * 1080 * 160 / 1024 / 1024)) # a pixel of a scene with lamps has 160 bytes
echo "merging 100 films of $film MiB took $merging MiB"
[ "$merging" -lt $((3 * film)) ] || fail 'more than three films'
rm -f ./*.exr ./*.pfm
finish
