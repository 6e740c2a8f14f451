#!/usr/bin/env bash
# Memory is known before it is taken: a picture that does not fit is refused before the first sample, with the number of
# bytes, which is that of the render within a tenth.
. "$(dirname "$0")/_common.sh"

limit=120000 # kB of address space, too few for the renders below
bash -c 'ulimit -v "$1"; "$0" -V' "$tyndall" $limit >probe 2>&1 || { echo 'skipped: sanitizers need more memory'; exit 77; }

# needs PERCENT COMMAND...: compares the bytes that a refusal names with what the same command takes.
needs() {
  local percent=$1 said
  shift
  rm -f m.*
  expect 2 bash -c 'ulimit -v "$1"; shift; exec "$@"' - $limit "$tyndall" "$@" :: 'ulimit -v' 'bytes'
  [ -z "$(find . -name 'm.*')" ] || fail 'a refused command wrote something'
  said=$(sed 's/.* takes \([0-9]*\) bytes .*/\1/' err)
  python3 -c '
import os, subprocess, sys
said, percent, command = float(sys.argv[1]), float(sys.argv[2]), sys.argv[3:]
_, status, used = os.wait4(subprocess.Popen(command, stdout=subprocess.DEVNULL).pid, 0)
took = 1024 * used.ru_maxrss
print(f"{100 * said / took - 100:+.1f} % of {took / 1e6:.0f} MB: {command[1:]}")
sys.exit(status != 0 or abs(said / took - 1) > percent / 100)' "$said" "$percent" "$tyndall" "$@" || fail "$*: said $said"
}

needs 10 render quads -q --size 1200x750 --spp 1 -o m.pfm
needs 10 render cornell-box -q --size 1200x750 --spp 1 -o m.pfm
needs 10 render cornell-box -q --size 1200x750 --spp 1 -o m.png
needs 10 render cornell-box -q --size 1200x750 --spp 1 -o m.ppm
needs 10 render cornell-box -q --size 1200x750 --spp 1 -o m.hdr -o m.pfm
needs 10 render cornell-box -q --size 1200x750 --spp 2 -o m.pfm --denoise
needs 10 render cornell-box -q --size 2400x750 --region 0,0,1200,750 --spp 1 -o m.pfm
if has_exr; then
  needs 10 render cornell-box -q --size 1200x750 --spp 1 -o m.exr
  needs 10 render quads -q --size 1200x750 --spp 1 -o m.exr --exr-film no
  needs 10 render cornell-box -q --size 1200x750 --spp 2 -o m.exr --denoise
  needs 10 render cornell-box -q --size 1200x750 --spp 1 -o - --format exr
  for samples in 0:2 2:3; do
    expect 0 "$tyndall" render cornell-box --size 1200x750 -q --samples $samples -o "p${samples%:*}.exr"
  done
  needs 10 merge p0.exr p2.exr -o m.exr
  needs 10 merge p0.exr p2.exr -o m.png --denoise
  needs 10 denoise p0.exr -o m.PNG
  rm p0.exr p2.exr
fi

# A lean EXR has no film, so nothing can go on from it.
if has_exr; then
  expect 0 "$tyndall" render quads --size 128x96 --spp 2 -q -o lean.exr --exr-film no
  expect 0 "$tyndall" render quads --size 128x96 --spp 2 -q -o full.exr -o full.pfm
  expect 0 "$tyndall" compare lean.exr full.pfm --max-rmse 0
  [ "$(wc -c <lean.exr)" -lt $(($(wc -c <full.exr) * 2 / 3)) ] || fail 'without its film an EXR is not smaller'
fi

# PNG is dithered, unless that is switched off; nothing else is.
sky=(quads --size 32x24 --spp 2 -q)
expect 0 "$tyndall" render "${sky[@]}" -o on.png -o on.pfm
expect 0 "$tyndall" render "${sky[@]}" -o off.png -o off.pfm --dither off
cmp -s on.pfm off.pfm || fail '--dither changes PFM'
cmp -s on.png off.png && fail '--dither off changes nothing'
expect 0 "$tyndall" render off.png -o again.png -q
expect 0 "$tyndall" compare again.png off.png --max-rmse 0

finish
