#!/usr/bin/env bash
# render: what it writes, what it says, and that the picture depends on nothing but scene and settings.
. "$(dirname "$0")/_common.sh"

small=(--size 40x30 --spp 4)
reference=$(image_hash cornell-box "${small[@]}")
[ "${#reference}" -eq 18 ] || fail "no hash of 16 digits: $reference" # with quotes

# Every image format is written. Standard output stays empty, and so does standard error for a short render.
files=(a.png a.pfm a.hdr)
reopened=(again.png)
if has_exr; then
  files+=(A.EXR)
  reopened+=(again.exr)
fi
expect 0 "$tyndall" render cornell-box "${small[@]}" "${files[@]/#/--output=}" --stats a.json
[ ! -s out ] || fail "standard output: $(cat out)"
[ ! -s err ] || fail "standard error: $(cat err)"
for file in "${files[@]}"; do [ -s "$file" ] || fail "no $file"; done
head -c 8 a.png | grep -q PNG || fail 'a.png is no PNG'
[ "$(head -n 2 a.pfm | tr '\n' ' ')" = 'PF 40 30 ' ] || fail "a.pfm: $(head -n 2 a.pfm | tr '\n' ' ')"
expect 0 "$tyndall" compare a.pfm a.pfm --max-rmse 0
if has_exr; then expect 0 "$tyndall" compare A.EXR a.pfm --max-rmse 0; fi
expect 0 "$tyndall" compare a.hdr a.pfm --max-relmse 0.001
expect 0 "$tyndall" compare a.png a.pfm --max-flip 0.1

# The figures that --stats writes have exactly these names, and they are true.
python3 - a.json <<'CHECK' || fail 'stats'
import json, sys
stats = json.load(open(sys.argv[1]))
assert list(stats) == """scene width height spp samples rays shadow_rays seconds_render seconds_total seconds_build
mrays_per_s msamples_per_s threads isa lanes kernel_features integrator sampler fresnel relative_error_estimate
rejected_samples truncated_paths peak_memory_bytes image_hash version
truncated_throughput first_rejected adaptive least_spp most_spp rare_bright_paths caustics denoised denoised_relative_error_estimate seconds_denoise denoised_hash sharing threads_from guide_ms guide_lobes split_events""".split(), list(stats)
assert (stats["scene"], stats["width"], stats["height"]) == ("cornell-box", 40, 30)
assert stats["spp"] == 4 and stats["samples"] == 4 * 40 * 30
assert stats["split_events"] == 0  # no glass
assert stats["rays"] >= stats["samples"] and 0 < stats["shadow_rays"] < stats["rays"]
assert 0 < stats["seconds_render"] <= stats["seconds_total"] and 0 <= stats["seconds_build"] <= stats["seconds_total"]
assert abs(stats["mrays_per_s"] * stats["seconds_render"] * 1e6 / stats["rays"] - 1) < 1e-6
assert stats["threads"] >= 1 and stats["lanes"] >= 1 and stats["isa"]
assert {"boxes", "quads", "lambertian", "lights"} <= set(stats["kernel_features"])
assert not {"media", "metal", "dielectric"} & set(stats["kernel_features"])
assert (stats["integrator"], stats["sampler"], stats["fresnel"]) == ("mis", "sobol", "exact")
assert 0 < stats["relative_error_estimate"] < 10 and stats["rejected_samples"] == 0
assert 1e6 < stats["peak_memory_bytes"] < 1e9
CHECK
same 'hash in the figures' "$(json a.json image_hash)" "$reference"

# One sample gives no estimate: null, and still JSON.
expect 0 "$tyndall" render cornell-box --size 8x8 --spp 1 -o one.pfm --stats one.json
same 'error of one sample' "$(json one.json relative_error_estimate)" null

# Threads, pauses of other kinds and the way the scene comes in do not change the picture.
for threads in 1 2 7; do
  same "-t $threads" "$(image_hash cornell-box "${small[@]}" -t "$threads")" "$reference"
done
same 'from a file' "$(image_hash "$source_root/assets/scenes/cornell-box.json" "${small[@]}")" "$reference"
piped=$("$tyndall" render - "${small[@]}" -q -o piped.pfm --stats piped.json \
  <"$source_root/assets/scenes/cornell-box.json" && json piped.json image_hash)
same 'from standard input' "$piped" "$reference"
[ "$(image_hash cornell-box "${small[@]}" --seed 1)" != "$reference" ] || fail '--seed changes nothing'

# An image can be opened again as the scene that made it, with the settings that were used.
options=(--size 24x18 --spp 3 --seed 5 --max-depth 4 --exposure 1 --fresnel schlick
  --set '/camera/look_from=[278,278,-700]' --set /materials/white/albedo=[0.5,0.6,0.7])
for image in "${reopened[@]}"; do
  expect 0 "$tyndall" render cornell-box "${options[@]}" -o "$image" --stats first.json
  expect 0 "$tyndall" render "$image" -o second.png --stats second.json
  same "$image opened again" "$(json second.json image_hash)" "$(json first.json image_hash)"
done
cmp -s again.png second.png || fail 'the image of an image differs'
mkdir -p deep/er
expect 0 "$tyndall" render earth --size 24x18 --spp 2 -o deep/er/earth.png --stats first.json
expect 0 "$tyndall" render deep/er/earth.png -o earth.pfm --stats second.json
same 'an image with a texture opened again' "$(json second.json image_hash)" "$(json first.json image_hash)"

# --set changes what is rendered, like the same edit of the file.
sed 's/"vfov": 40/"vfov": 30/' "$source_root/assets/scenes/cornell-box.json" >edited.json
same '--set' "$(image_hash cornell-box "${small[@]}" --set /camera/vfov=30)" "$(image_hash edited.json "${small[@]}")"

# A region holds the same pixels as the whole image.
expect 0 "$tyndall" render cornell-box "${small[@]}" --region 8,4,24,20 -o part.pfm --stats part.json
same 'width of a region' "$(json part.json width)" 16
python3 - a.pfm part.pfm <<'CHECK' || fail 'the region differs from the whole image'
import sys
def rows(name):
    data = open(name, "rb").read()
    magic, size, scale, pixels = data.split(b"\n", 3)
    width, height = map(int, size.split())
    return [pixels[y * width * 12:(y + 1) * width * 12] for y in range(height)][::-1]
whole, part = rows(sys.argv[1]), rows(sys.argv[2])
assert len(part) == 16
assert part == [row[8 * 12:24 * 12] for row in whole[4:20]]
CHECK

# Limits: the scene's own count, time, and error.
expect 0 "$tyndall" render cornell-box --size 8x8 -o limit.pfm --stats limit.json
same "the scene's samples" "$(json limit.json spp)" 200
expect 0 "$tyndall" render cornell-box --size 8x8 --set '/render={}' -o limit.pfm --stats limit.json
same 'samples without any limit' "$(json limit.json spp)" 64
expect 0 "$tyndall" render cornell-box --size 64x64 --time 0.3 -o limit.pfm --stats limit.json
python3 -c 'import sys; sys.exit(not 0.3 <= float(sys.argv[1]) < 20)' "$(json limit.json seconds_render)" || fail '--time'
expect 0 "$tyndall" render metal-spheres --size 16x16 --target-error 0.05 -o limit.pfm --stats limit.json
python3 -c 'import sys; sys.exit(not float(sys.argv[1]) <= 0.05)' "$(json limit.json relative_error_estimate)" ||
  fail '--target-error'

# The warning that the error cannot be trusted is also given with -q.
expect 0 "$tyndall" render stress-light-and-fuzz --size 16x16 --spp 4 -q -o rare.pfm
complains 'not converged: rare bright paths'

# Every available instruction set works.
for isa in scalar sse4 avx2 avx512 neon; do
  if "$tyndall" render cornell-box "${small[@]}" --isa "$isa" -q -o isa.pfm --stats isa.json 2>/dev/null; then
    same "--isa $isa" "$(json isa.json isa)" "\"$isa\""
    expect 0 "$tyndall" compare isa.pfm a.pfm --max-relmse 0.05
  fi
done
expect 0 "$tyndall" render cornell-box "${small[@]}" --isa scalar -o isa.pfm

finish
