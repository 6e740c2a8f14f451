#!/usr/bin/env bash
# The page for browsers: node renders the bits of the native SSE4 kernel in all built-in scenes, and page.mjs uses the page in a
# headless Chromium as a user would. Wants the packages web_packages of third_party/packages.sh, chromium, and node 20.
. "$(dirname "$0")/../app/_common.sh"
scratch=$PWD
skip() { echo "skipped: $*"; exit 77; }
for needed in emcc chromium; do command -v $needed >probe || skip "$needed is missing"; done
[ "$(node --version | grep -oE '[0-9]+' | head -1)" -ge 20 ] || skip 'node 20 or later is missing'
cd "$source_root" || exit 1
third_party/web_libraries.sh build/web-libraries || skip 'the libraries cannot be fetched'
build() {
  local folder=$1 target=$2
  shift 2
  # shellcheck disable=SC2086 # several targets
  { cmake -B "$folder" "$@" && cmake --build "$folder" --target $target; } >"$scratch/build.log" 2>&1 ||
    { tail -50 "$scratch/build.log"; fail "building $target"; finish; }
}
build build/web 'tyndall_page tyndall_headless' --preset web
build "$scratch/sse4" tyndall -S . -G Ninja -DTYNDALL_INSTRUCTION_SETS=sse4 -DTYNDALL_WINDOW=OFF -DTYNDALL_TESTS=OFF
native=$scratch/sse4/tyndall

mapfile -t scenes < <("$native" scenes | awk '{ print $1 }')
[ ${#scenes[@]} -gt 50 ] || fail 'too few scenes'
for isa in sse4:wasm scalar:scalar; do # native:page
  for scene in "${scenes[@]}"; do
    echo "$scene $(cd "$scratch" && renderer=("$native") && image_hash "$scene" --size 32x24 --spp 2 --isa ${isa%:*})"
  done >"$scratch/native"
  node --no-experimental-fetch build/web/tyndall_headless.js assets ${isa#*:} 32 24 2 2 "${scenes[@]}" | cut -d ' ' -f 1,2 >"$scratch/page"
  diff "$scratch/native" "$scratch/page" || fail "pictures of the page (>) that are not those of the program (<), $isa"
done
node --experimental-websocket tests/web/page.mjs "$native" build/web "$scratch/shots" || fail 'the page, see shots'
finish
