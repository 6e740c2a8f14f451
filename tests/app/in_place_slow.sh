#!/usr/bin/env bash
# Outputs that nothing can take the place of: found before the first sample, written into when the picture is finished,
# and never the reason for which a picture is lost.
. "$(dirname "$0")/_common.sh"
export TMPDIR=$PWD/temporary
mkdir "$TMPDIR"
scene=(cornell-box --size 24x16)
expect 0 "$tyndall" render "${scene[@]}" --spp 2 -q -o right.pfm
# Seconds of work after which a small render has surely begun: some times what a whole one takes.
begun=$(awk "BEGIN { print 0.1 + 3 * $(work_of "$tyndall" render "${scene[@]}" --spp 2 -q -o begun.pfm) }")
rm -f begun.pfm
beside() { # FILES...: these are all that the folder holds, but for what commands printed
  same 'files' "$(find . -maxdepth 1 -type f ! -name out ! -name err -printf '%f\n' | sort | tr '\n' ' ')" "$* "
}

# What is in the way when the render ends: the picture goes to a name beside it, and the line says so.
mkdir late && cd late || exit 1
taken_meanwhile() { # COMMAND...: runs a long render of a.pfm, and the command while it runs
  "$tyndall" render "${scene[@]}" --spp 10000000 -q -o a.pfm 2>err &
  local render=$! code=0
  wait_worked "$render" "$begun"
  "$@"
  kill -TERM "$render"
  wait "$render" || code=$?
  same 'exit code where an output cannot be replaced at the end' "$code" 3
}
taken_meanwhile mkdir a.pfm
grep -q 'a.pfm: cannot write: .*; it is in a.new.pfm instead' err || fail "a folder of that name: $(cat err)"
expect 0 "$tyndall" compare a.new.pfm a.new.pfm --max-rmse 0
rmdir a.pfm
taken_meanwhile mkdir a.pfm
grep -q 'it is in a.new-2.pfm instead' err || fail "a name beside that is taken: $(cat err)"
rmdir a.pfm
cd .. || exit 1
# Without its folder it goes to a temporary one.
mkdir gone
"$tyndall" render "${scene[@]}" --spp 10000000 -q -o gone/a.pfm --stats gone/a.json 2>err &
render=$!
wait_worked "$render" "$begun"
rmdir gone
kill -TERM "$render"
code=0
wait "$render" || code=$?
same 'exit code where the folder is gone' "$code" 3
for name in a.pfm a.json; do
  rescued=$(sed -n "s|.*gone/$name: .*; it is in \\(.*\\) instead|\\1|p" err)
  [ -s "$rescued" ] || fail "$name is lost with its folder: $(cat err)"
  [[ $rescued == "$TMPDIR"/tyndall-??????/$name ]] || fail "$name is in $rescued"
done

# Devices, pipes and open files take the bytes at the end.
ln -s /dev/null null.png
ln -s /dev/full full.png
expect 0 "$tyndall" render "${scene[@]}" --spp 1 -q -o null.png
[ -c /dev/null ] && [ -L null.png ] || fail 'a device was replaced'
if [ -w /dev/full ]; then
  expect 3 "$tyndall" render "${scene[@]}" --spp 1 -q -o full.png -o kept.png :: full.png space
  [ -s kept.png ] || fail 'an output beside a full device was not written'
fi
# Where one of several outputs fails, the others are still written.
if [ -w /dev/full ]; then
  ln -s /dev/full full.html
  expect 0 "$tyndall" compare right.pfm --baseline kept --update
  expect 3 "$tyndall" compare right.pfm --baseline kept --report full.html --junit whole.xml
  grep -q 'full.html: cannot write: No space' err && grep -q right.pfm out || fail "a full report: $(cat out err)"
  grep -q '</testsuite' whole.xml || fail 'no JUnit beside a report that failed'
  expect 3 "$tyndall" compare right.pfm right.pfm --heatmap full.png :out FLIP
fi
"$tyndall" render "${scene[@]}" --spp 1 -q -o a.pfm --stats /dev/stdout | grep -q image_hash || fail '--stats /dev/stdout'
echo before >open.txt
"$tyndall" render "${scene[@]}" --spp 1 -q -o a.pfm --stats /dev/stdout >>open.txt || fail '--stats /dev/stdout >>file'
[ "$(head -1 open.txt)" = before ] && grep -q image_hash open.txt || fail "an open file lost what it held: $(cat open.txt)"

# What the file system protects from everybody.
mkdir protected
echo old >protected/a.pfm
if chattr +i protected/a.pfm 2>probe; then
  expect 3 "$tyndall" render "${scene[@]}" --spp 10000000 -q -o protected/a.pfm
  complains protected/a.pfm 'it may not be changed' 'Operation not permitted'
  chattr -i protected/a.pfm
  chattr +a protected
  expect 0 "$tyndall" render "${scene[@]}" --spp 2 -q -o protected/a.pfm :: 'its folder may only be appended to'
  cmp -s protected/a.pfm right.pfm || fail 'no picture in a folder that only grows'
  expect 3 "$tyndall" render "${scene[@]}" --spp 10000000 -q -o protected/b.pfm
  complains protected/b.pfm 'its folder may only be appended to'
  chattr -a protected
  same 'files of a protected folder' "$(ls protected)" a.pfm
else
  echo 'files cannot be protected here (chattr): this was not tested'
fi

# A folder that takes no new files, and a file in it that may be written; as a user to whom permissions apply.
as_user=()
if [ "$(id -u)" = 0 ]; then as_user=(setpriv --reuid=65534 --regid=65534 --clear-groups); fi
if "${as_user[@]}" "$tyndall" scenes >probe 2>&1; then
  mkdir closed sticky
  cp right.pfm closed/a.pfm
  echo old >closed/a.exr
  head -c 100000 /dev/zero >closed/a.json
  echo old >closed/locked.pfm
  chmod 666 closed/a.*
  chmod 444 closed/locked.pfm
  [ "$(id -u)" != 0 ] || chmod 777 "$TMPDIR"
  chmod 555 closed
  expect 0 "${as_user[@]}" "$tyndall" render "${scene[@]}" --spp 2 -q -o closed/a.pfm --fresh
  complains closed/a.pfm 'cannot be replaced' 'its folder takes no new files (Permission denied)'
  cmp -s closed/a.pfm right.pfm || fail 'another picture was written into a file'
  expect 0 "${as_user[@]}" "$tyndall" convert cornell-box -o closed/a.json
  "$tyndall" convert cornell-box -o - | cmp - closed/a.json || fail 'a longer file is not cut where it was written into'
  if has_exr; then
    expect 0 "${as_user[@]}" "$tyndall" render "${scene[@]}" --spp 2 -q -o closed/a.exr :: 'no checkpoints are kept'
    expect 0 "$tyndall" compare closed/a.exr right.pfm --max-rmse 0
  fi
  expect 3 "${as_user[@]}" "$tyndall" render "${scene[@]}" --spp 10000000 -q -o closed/locked.pfm
  complains closed/locked.pfm 'Permission denied'
  expect 3 "${as_user[@]}" "$tyndall" render "${scene[@]}" --spp 10000000 -q -o closed/none.pfm
  complains closed/none.pfm 'Permission denied'
  # A shared folder in which only the owner of a file may replace it.
  if [ "$(id -u)" = 0 ]; then
    echo old >sticky/a.pfm
    chmod 666 sticky/a.pfm
    chown 12345 sticky/a.pfm sticky
    chmod 1777 sticky
    expect 0 "${as_user[@]}" "$tyndall" render "${scene[@]}" --spp 2 -q -o sticky/a.pfm :quiet
    cmp -s sticky/a.pfm right.pfm || fail 'no picture in a sticky folder'
    same 'owner in a sticky folder' "$(stat -c %u sticky/a.pfm)" 12345
    same 'files of a sticky folder' "$(ls sticky)" a.pfm
  fi
  chmod 755 closed
else
  echo 'the program cannot be run as a user without privileges: folders that take no new files were not tested'
fi

# Files that are mounted.
if ! unshare -rm true 2>probe; then
  echo 'skipped: files cannot be mounted here, so that those that are were not tested'
  [ "$failures" -eq 0 ] && exit 77
  finish
fi
mkdir bound && cd bound || exit 1
# in_mounts, mounted COMMAND...: the command sees "real" mounted at the name of the same ending.
in_mounts=(unshare -rm bash -c 'for name in png pfm exr json svg csv html xml; do
      [ ! -e a.$name ] || mount --bind real.$name a.$name || exit 99
    done
    exec "$@"' bash)
mounted() { "${in_mounts[@]}" "$@"; }
# stopped SIGNAL COMMAND...: the same, ended by the signal once it has worked and there is a checkpoint.
stopped() {
  local signal=$1 render
  shift
  "${in_mounts[@]}" "$@" 2>err &
  render=$!
  wait_worked "$render" "$begun"
  for _ in $(seq 1200); do [ -s a.unfinished.exr ] && break || sleep 0.05; done
  kill -"$signal" "$render"
  wait "$render" 2>/dev/null
}
put() { for name in "$@"; do echo "old old old $name" >"real.$name" && : >"a.$name"; done; }

put pfm png json
expect 0 mounted "$tyndall" render "${scene[@]}" --spp 2 -q -o a.pfm -o a.png --stats a.json :quiet
cmp -s real.pfm ../right.pfm || fail 'a mounted file got another picture'
same 'stats in a mounted file' "$(json real.json spp)" 2
expect 0 "$tyndall" compare real.png real.png --max-rmse 0
[ ! -s a.pfm ] || fail 'what is mounted over was written'
# The commands that write other things.
put json html xml svg csv
expect 0 mounted "$tyndall" convert cornell-box -o a.json
"$tyndall" convert cornell-box -o - | cmp - real.json || fail 'convert into a mounted file'
expect 0 mounted "$tyndall" compare real.pfm ../right.pfm --heatmap a.png
expect 0 "$tyndall" compare real.png real.png
mkdir kept
expect 0 "$tyndall" compare real.pfm --baseline kept --update
expect 0 mounted "$tyndall" compare real.pfm --baseline kept --report a.html --junit a.xml
grep -q '</html>' real.html && grep -q '</testsuite' real.xml || fail 'reports in mounted files'
cp ../right.pfm before.pfm
expect 0 unshare -rm bash -c 'mount --bind before.pfm kept/real.pfm && "$0" compare real.pfm --baseline kept --update' "$tyndall"
expect 0 mounted "$tyndall" chart cornell-box --size 8x8 --budget 1 -q -o a.svg
grep -q '</svg>' real.svg && grep -q spp real.csv || fail 'a chart in mounted files'
# Read only: found before the first sample.
put pfm
expect 3 unshare -rm bash -c 'mount --bind real.pfm a.pfm && mount -o remount,bind,ro a.pfm && exec "$@"' bash \
  "$tyndall" render "${scene[@]}" --spp 10000000 -q -o a.pfm
complains a.pfm 'it is a mount point, and into it: Read-only file system'
# No room for what is written into a file: it stays as it was, and the picture is elsewhere.
mkdir "$TMPDIR/disk"
expect 3 unshare -rm bash -c 'mount -t tmpfs -o size=64k disk "$1" && echo precious >"$1/real.pfm" &&
  mount --bind "$1/real.pfm" a.pfm && "$0" render cornell-box --size 200x200 --spp 1 -q -o a.pfm; code=$?
  grep -q precious a.pfm || code=98; exit $code' "$tyndall" "$TMPDIR/disk"
complains a.pfm 'No space' 'it is in a.new.pfm instead'
rm -f a.new.pfm
# Mounted while the render runs: written into like one that was mounted before.
put pfm
expect 0 unshare -rm bash -c '"$0" render cornell-box --size 24x16 -t 1 --time 2 -q -o a.pfm & sleep 0.5
  mount --bind real.pfm a.pfm; wait $!' "$tyndall"
expect 0 "$tyndall" compare real.pfm real.pfm --max-rmse 0

if has_exr; then
  # Checkpoints go beside it, the same command goes on from there, and only the finished film is written into it.
  long=(render cornell-box --size 64x64 -q)
  rm -f -- *.pfm *.png probe.exr
  put exr
  stopped KILL "$tyndall" "${long[@]}" --spp 10000000 --checkpoint 0.2 -o a.exr
  grep -q 'a.exr: cannot be replaced, as it is a mount point; .*checkpoints go to a.unfinished.exr' err ||
    fail "where checkpoints go is not said: $(cat err)"
  same 'a mounted film before the end' "$(cat real.exr)" 'old old old exr'
  [ -s a.unfinished.exr ] || fail 'no checkpoint beside a mounted file'
  expect 2 mounted "$tyndall" "${long[@]}" --spp 10000000 --seed 3 -o a.exr :: a.unfinished.exr 'seed 0' --fresh
  cp a.unfinished.exr killed.exr
  expect 0 mounted "$tyndall" merge a.unfinished.exr -o a.exr
  stopped TERM "$tyndall" "${long[@]}" --spp 10000000 -o a.exr
  grep -q 'a.unfinished.exr: goes on from' err || fail "it does not go on from the file beside: $(cat err)"
  grep -aq unfinished real.exr || fail 'the picture at a signal is not in the mounted file'
  [ ! -e a.unfinished.exr ] || fail 'the file beside stays when the film is in the mounted one'
  put exr
  stopped KILL "$tyndall" "${long[@]}" --spp 1000000 --checkpoint 0.2 -o a.exr
  [ -s a.unfinished.exr ] || fail 'no checkpoint beside a mounted file'
  expect 0 mounted "$tyndall" "${long[@]}" --spp 5000 -o a.exr --stats goes_on.json
  same 'a film that went on from the file beside' "$(json goes_on.json image_hash)" \
    "$(image_hash cornell-box --size 64x64 --spp "$(json goes_on.json spp)")"
  [ ! -e a.unfinished.exr ] || fail 'the file beside stays at the end'
  # The other writers of films.
  for part in 0:1 1:2; do expect 0 "$tyndall" render "${scene[@]}" --samples $part -q -o "${part%:*}.exr"; done
  put exr
  expect 0 mounted "$tyndall" merge 0.exr 1.exr -o a.exr
  expect 0 "$tyndall" compare real.exr ../right.pfm --max-rmse 0
  cp real.exr whole.exr
  put exr
  expect 0 mounted "$tyndall" denoise whole.exr -o a.exr
  expect 0 "$tyndall" compare real.exr ../right.pfm --max-rmse 0
fi
cd .. || exit 1
finish
