#!/usr/bin/env bash
# Wrong usage, missing scenes and files that cannot be written: exit code, one line, nothing half done.
. "$(dirname "$0")/_common.sh"

small=(--size 16x16 --spp 1)

for arguments in --help -h --version 'render --help' 'compare --help' 'view --help' 'scenes --help'; do
  # shellcheck disable=SC2086
  expect 0 "$tyndall" $arguments
  [ -s out ] || fail "$arguments prints nothing"
  [ ! -s err ] || fail "$arguments complains: $(cat err)"
done

# Wrong usage gives exit code 2.
expect 2 "$tyndall" render
complains 'SCENE is missing'
expect 2 "$tyndall" render cornell-box
complains 'an output'
expect 2 "$tyndall" render cornell-box -o a.png --sied 3
complains '--sied' 'did you mean "--seed"?'
expect 2 "$tyndall" redner cornell-box -o a.png
complains 'unknown command "redner"' 'render'
expect 2 "$tyndall" render cornell-box -o a.png --size 12
complains '--size' '"12"' 'WIDTHxHEIGHT'
expect 2 "$tyndall" render cornell-box -o a.png --size 0x10
expect 2 "$tyndall" render cornell-box -o a.png --size 70000x10
complains 'width'
expect 2 "$tyndall" render cornell-box -o a.png --spp 4 --samples 0:4
complains '--spp' '--samples'
expect 2 "$tyndall" render cornell-box -o a.png --region 0,0,601,10
complains '--region' '600'
expect 2 "$tyndall" render cornell-box -o a.png --isa sse5
expect 2 "$tyndall" render cornell-box -o a.png --integrator miss
complains 'miss' 'mis'
expect 2 "$tyndall" render cornell-box -o a.png --sampler halton
complains 'halton' 'sobol'
expect 2 "$tyndall" render cornell-box -o a.png --resume
complains '--resume' '.exr'
expect 2 "$tyndall" render cornell-box -o a.jpg
complains 'a.jpg' '.png'
expect 2 "$tyndall" render cornell-box -o a.png -o noending
complains 'noending'
expect 2 "$tyndall" render cornell-box -o a.png -o a.png
complains 'twice'
expect 2 "$tyndall" render cornell-box -o a.png -o ./a.png
complains 'twice'
expect 2 "$tyndall" render cornell-box -o a.png --stats a.png
complains '--stats' '.json'
expect 2 "$tyndall" chart cornell-box -o a.png
complains .svg
expect 2 "$tyndall" verify plaet
complains '"plaet"' 'did you mean "plate"?'
expect 2 "$tyndall" verify plate fog-bal/
complains '"fog-bal/"' 'fog-ball'

# Scenes that cannot be read give exit code 2.
expect 2 "$tyndall" render missing.json -o a.png
complains 'missing.json'
expect 2 "$tyndall" render cornell-bxo -o a.png
complains 'cornell-box'
expect 2 "$tyndall" render . -o a.png
echo '{ "tyndall": 1, "camera": { "vfov": 400 } }' >wide.json
expect 2 "$tyndall" render wide.json -o a.png
complains 'wide.json' '/camera/vfov' '400'
printf 'not a scene\n' >broken.json
expect 2 "$tyndall" inspect broken.json
complains 'broken.json'
expect 2 "$tyndall" render cornell-box -o a.png --set /materials/nobody/fuzz=1
complains '/materials/nobody'
expect 2 "$tyndall" render cornell-box -o a.png --set /camera/vfov=fast
complains '/camera/vfov' 'fast'

# Files that cannot be read or written give exit code 3.
expect 3 "$tyndall" render cornell-box -o folder/a.png --spp 100000
complains 'folder/a.png' 'folder'
expect 3 "$tyndall" render cornell-box -o /proc/tyndall.png --spp 100000
complains '/proc/tyndall.png'
mkdir taken.png
expect 3 "$tyndall" render cornell-box -o taken.png --spp 100000
complains 'taken.png'
expect 3 "$tyndall" render cornell-box -o a.png --stats folder/s.json --spp 100000
complains 'folder/s.json'
expect 3 "$tyndall" compare missing.png missing.png
complains 'missing.png'
expect 3 "$tyndall" merge missing.exr -o m.png
expect 2 env TYNDALL_ASSETS=/nowhere "$tyndall" verify
complains 'cases.json' 'TYNDALL_ASSETS'
expect 3 env TYNDALL_ASSETS=/nowhere "$tyndall" scenes
complains 'TYNDALL_ASSETS'
[ ! -e a.png ] || fail 'an image was written in spite of an error'

# If standard output is closed or full, commands that print data fail; a render that writes an image does not.
expect 3 bash -c '"$0" scenes >&-' "$tyndall"
complains 'standard output'
if [ -w /dev/full ]; then
  expect 3 bash -c '"$0" scenes >/dev/full' "$tyndall"
  complains 'standard output' 'space'
fi
expect 0 bash -c 'exec "$0" "$@" >&- 2>&- <&-' "$tyndall" render cornell-box "${small[@]}" -o closed.pfm
expect 0 "$tyndall" render cornell-box "${small[@]}" -o open.pfm
cmp -s closed.pfm open.pfm || fail 'closed streams change the image'

finish
