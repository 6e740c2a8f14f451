#!/usr/bin/env bash
# Filtered pictures in files: only when asked, labelled, the film untouched; the same of a render, of merged parts and of
# a film that is read again.
. "$(dirname "$0")/_common.sh"

scene=(cornell-box --size 48x40)
expect 0 "$tyndall" render "${scene[@]}" --spp 4 -q -o raw.pfm --stats raw.json
expect 0 "$tyndall" render "${scene[@]}" --spp 4 -q -o clean.pfm -o clean.png --denoise --stats clean.json
same 'the hash of the unfiltered picture' "$(json clean.json image_hash)" "$(json raw.json image_hash)"
same denoised "$(json raw.json denoised) $(json clean.json denoised)" 'false true'
same 'what a raw picture says of a filtered one' \
  "$(json raw.json denoised_relative_error_estimate) $(json raw.json denoised_hash)" 'null null'
cmp -s raw.pfm clean.pfm && fail 'the filtered picture is the raw one'
python3 - "$(json clean.json denoised_relative_error_estimate)" "$(json clean.json relative_error_estimate)" \
  "$(json clean.json seconds_denoise)" <<'PY' || fail 'figures of the filtered picture'
import sys
clean, raw, seconds = map(float, sys.argv[1:])
sys.exit(not (0 < clean < raw / 2 and 0 < seconds < 60))
PY
grep -aq '"denoised": *true' clean.png || fail 'the PNG does not say that it is filtered'
expect 0 "$tyndall" render clean.png -q -o again.pfm
cmp -s raw.pfm again.pfm || fail 'a filtered PNG rendered again is filtered'

expect 0 "$tyndall" render cornell-box --size 192x160 --target-error 0.1 --denoise -q -o target.png --stats target.json
python3 -c 'import sys; sys.exit(not float(sys.argv[1]) <= 0.1 < float(sys.argv[2]))' \
  "$(json target.json denoised_relative_error_estimate)" "$(json target.json relative_error_estimate)" ||
  fail 'the filtered error does not end the render'

has_exr || finish
expect 0 "$tyndall" render "${scene[@]}" --spp 4 -q -o whole.exr --denoise
expect 0 "$tyndall" denoise whole.exr -o read.pfm -o read.exr --stats read.json
cmp -s read.pfm clean.pfm || fail 'a film that is read again is filtered to another picture'
same 'hash of the filtered picture' "$(json read.json denoised_hash)" "$(json clean.json denoised_hash)"
same 'hash of the film' "$(json read.json image_hash)" "$(json raw.json image_hash)"
for file in whole.exr read.exr; do
  for channel in denoised.R denoised.G denoised.B denoised.error; do
    grep -aq "$channel" "$file" || fail "$file has no channel $channel"
  done
  expect 0 "$tyndall" compare "$file" raw.pfm --max-rmse 0
done
for part in 0:2 2:4; do expect 0 "$tyndall" render "${scene[@]}" --samples $part -q -o "part-${part%:*}.exr"; done
expect 0 "$tyndall" merge part-2.exr part-0.exr --denoise -o merged.pfm
cmp -s merged.pfm clean.pfm || fail 'merged parts are filtered to another picture'
finish
