#!/usr/bin/env bash
# No command writes over what it reads: refused with exit code 2 before the first sample, and the input stays as it was.
. "$(dirname "$0")/_common.sh"

expect 0 "$tyndall" render cornell-box --size 8x8 --spp 1 -q -o texture.png -o reference.pfm
cat >scene.json <<'JSON'
{ "tyndall": 1, "image": { "width": 8, "height": 8 },
  "textures": { "t": { "type": "image", "file": "texture.png" } },
  "materials": { "m": { "type": "lambertian", "albedo": "t" } },
  "objects": [ { "type": "sphere", "center": [0, 0, -2], "radius": 1, "material": "m" } ] }
JSON
ln -s scene.json linked.json
ln scene.json hard.json
mkdir sub
ln -s . here
before=$(cat scene.json texture.png reference.pfm | sha256sum)

# kept TEXT COMMAND...: the command is refused, names TEXT, and no input has changed.
kept() {
  local text=$1
  shift
  expect 2 "$tyndall" "$@"
  complains "$text" 'input'
  same "inputs of $*" "$(cat scene.json texture.png reference.pfm | sha256sum)" "$before"
}
long=(--spp 1000000 -q)
for name in scene.json ./scene.json sub/../scene.json here/scene.json "$PWD/scene.json" linked.json hard.json; do
  kept --stats render scene.json "${long[@]}" -o new.png --stats "$name"
done
kept --output render scene.json "${long[@]}" -o texture.png
kept --output render texture.png "${long[@]}" -o texture.png
kept --output convert linked.json -o scene.json
kept --heatmap compare texture.png reference.pfm --heatmap texture.png
kept --heatmap compare reference.pfm texture.png --heatmap here/texture.png
ln -s reference.pfm chart.csv
kept --output chart scene.json -q --reference reference.pfm -o chart.svg
kept --ui-log view scene.json --ui-log texture.png
kept --ui-log view scene.json --reference reference.pfm --ui-log reference.pfm
if has_exr; then
  for part in 0:1 1:2; do expect 0 "$tyndall" render scene.json --samples $part -q -o "${part%:*}.exr"; done
  films=$(cat 0.exr 1.exr | sha256sum)
  kept --output merge 0.exr 1.exr -o 1.exr
  kept --output denoise 0.exr -o 0.exr
  kept --stats denoise 0.exr -o new.png --stats here/0.exr
  same films "$(cat 0.exr 1.exr | sha256sum)" "$films"
fi
# Two outputs that are one file.
expect 2 "$tyndall" render scene.json "${long[@]}" -o new.png -o here/new.png
complains --output twice
expect 2 "$tyndall" render scene.json "${long[@]}" -o new.png --stats s.json -o ./sub/../new.png
complains --output twice
[ ! -e new.png ] && [ ! -e s.json ] || fail 'something was written'
expect 0 "$tyndall" render scene.json --spp 1 -q -o new.png --stats s.json
finish
