#!/usr/bin/env bash
# The build for browsers renders the bits of the native build: node's hashes of all built-in scenes are those of the SSE4
# kernel. hashes_nightly.sh TYNDALL HEADLESS: a native program with that kernel, and build/web/tyndall_headless.js.
set -euo pipefail
tyndall=$1 headless=$2 root=$(cd "$(dirname "$0")/../.." && pwd)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mapfile -t scenes < <(cd "$root/assets/scenes" && basename -s .json ./*.json)
for scene in "${scenes[@]}"; do
  "$tyndall" render "$scene" --size 32x24 --spp 2 --isa sse4 -o "$folder/p.pfm" --stats "$folder/stats.json" 2>"$folder/said" ||
    { cat "$folder/said" >&2 && exit 1; }
  echo "$scene $(grep -oE '"image_hash": "[0-9a-f]+"' "$folder/stats.json" | cut -d '"' -f 4)"
done >"$folder/native"
node --no-experimental-fetch "$headless" "$root/assets" wasm 32 24 2 2 "${scenes[@]}" | cut -d ' ' -f 1,2 >"$folder/page"
diff "$folder/native" "$folder/page" || { echo "the page renders other pictures (>) than the program (<)" >&2 && exit 1; }
echo "${#scenes[@]} scenes have the same picture"
