#!/usr/bin/env bash
# A disk that is full while images are written: exit code 3, no half file, and what fits elsewhere is written.
. "$(dirname "$0")/_common.sh"

# What a full disk does not take goes among the temporary files, where these have room.
export TMPDIR=$PWD/temporary
mkdir "$TMPDIR"

# 600x600 pixels: 4 MB as PFM, more as EXR.
render=(render cornell-box --spp 1 -q)
exr=()
if has_exr; then exr=(-o big.exr); fi
(
  ulimit -f 200 # blocks of 1 kB
  "$tyndall" "${render[@]}" -o big.pfm "${exr[@]}" -o small.png --stats figures.json
) >out 2>err
code=$?
[ "$code" -eq 3 ] || fail "file size limit: exit code $code: $(cat err)"
grep -q 'big.pfm: cannot write' err || fail "big.pfm is not named: $(cat err)"
[ ${#exr[@]} -eq 0 ] || grep -q 'big.exr: cannot write' err || fail "big.exr is not named: $(cat err)"
[ ! -e big.pfm ] && [ ! -e big.exr ] || fail 'a half file is left'
[ -z "$(ls "$TMPDIR")" ] || fail "left among the temporary files, which have no room either: $(ls "$TMPDIR")"
same 'spp' "$(json figures.json spp)" 1
no_leftovers

# A file that was there before stays as it was.
echo precious >big.pfm
(
  ulimit -f 200
  "$tyndall" "${render[@]}" -o big.pfm
) >out 2>err
[ $? -eq 3 ] || fail 'file size limit over an old file'
[ "$(cat big.pfm)" = precious ] || fail 'the old file is lost'

# A real full disk, where one can be mounted.
if mkdir disk && mount -t tmpfs -o size=1m tmpfs disk 2>/dev/null; then
  trap 'umount disk' EXIT
  expect 3 "$tyndall" "${render[@]}" -o disk/big.pfm -o kept.png :: 'disk/big.pfm' 'space' "it is in $TMPDIR/tyndall-"
  cmp -s "$TMPDIR"/tyndall-*/big.pfm <("$tyndall" "${render[@]}" -o - --format pfm) || fail 'the picture is lost'
  [ -s kept.png ] || fail 'the image that fits elsewhere was not written'
  [ -z "$(ls disk)" ] || fail "left on the disk: $(ls disk)"
else
  echo 'no tmpfs can be mounted: only the file size limit was tested'
fi

finish
