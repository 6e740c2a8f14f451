#!/usr/bin/env bash
# Images through standard output and named pipes are those that files get.
. "$(dirname "$0")/_common.sh"

scene=(cornell-box --size 20x16 --spp 2 -q)
formats=(png pfm hdr ppm)
has_exr && formats+=(exr)
for format in "${formats[@]}"; do
  expect 0 "$tyndall" render "${scene[@]}" -o file.$format
  "$tyndall" render "${scene[@]}" -o - --format $format >stream 2>err || fail "rendering $format to standard output"
  [ ! -s err ] || fail "it says: $(cat err)"
  if [ $format = exr ] || [ $format = png ]; then # these carry how long the run took
    expect 0 "$tyndall" compare stream file.$format --max-rmse 0
  else
    cmp -s stream file.$format || fail "standard output gets another $format than a file"
  fi
  "$tyndall" render "${scene[@]}" -o - --format $format | cat >piped
  [ "$(wc -c <piped)" -gt 100 ] || fail "a pipe gets no $format"
done

# A named pipe is written to, not replaced, and opened only when the image is there.
mkfifo pipe.pfm
timeout 60 cat pipe.pfm >from_pipe &
reader=$!
expect 0 "$tyndall" render "${scene[@]}" -o pipe.pfm -o file2.pfm
wait $reader
[ -p pipe.pfm ] || fail 'the pipe was replaced'
cmp -s from_pipe file.pfm || fail 'a named pipe gets another image than a file'

# Images and scenes are read from pipes, too. EXR is not read in order, and says so.
expect 0 bash -c '"$0" compare <(cat file.png) <(cat file.png) --max-rmse 0' "$tyndall"
expect 0 bash -c '"$0" render <(echo "{ \"tyndall\": 1 }") --size 4x4 --spp 1 -q -o - --format png >none.png' "$tyndall"
if has_exr; then
  expect 3 bash -c '"$0" compare <(cat file.exr) file.png' "$tyndall" :: 'an EXR in a pipe'
  "$tyndall" merge file.exr -o - --format pfm >merged.pfm || fail 'merging to standard output'
  cmp -s merged.pfm file.pfm || fail 'merge gives standard output another image'
fi

finish
