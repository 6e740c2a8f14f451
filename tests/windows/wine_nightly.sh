#!/usr/bin/env bash
# The program for Windows, cross compiled and run by wine: the hashes of all scenes and instruction sets are those of this
# build, threads never hang, names and files are what Windows expects, outputs are whole or not there, the window opens and
# keeps its edits, and "tyndall verify" passes. TYNDALL_TRIALS: short renders by 2 and by 4 threads; all of it takes hours.
. "$(dirname "$0")/../app/_common.sh"
scratch=$PWD
skip() { echo "skipped: $*"; exit 77; }
command -v x86_64-w64-mingw32-g++-posix >probe || skip 'the cross compiler is missing (g++-mingw-w64-x86-64-posix)'
command -v wine >probe || skip 'wine is missing'
cd "$source_root" || exit 1
third_party/mingw_libraries.sh "$PWD/build/mingw-libraries" || skip 'the libraries cannot be fetched'
cmake --preset windows -DTYNDALL_TESTS=ON >"$scratch/cmake.log" 2>&1 || { cat "$scratch/cmake.log"; fail 'cmake'; finish; }
cmake --build build/windows --target tyndall core_tests app_tests >"$scratch/build.log" 2>&1 ||
  { tail -50 "$scratch/build.log"; fail 'building'; finish; }
cd "$scratch" || exit 1
export WINEPREFIX=$scratch/prefix WINEDEBUG=-all WINEARCH=win64
wine wineboot -i >boot.log 2>&1
windows_program=$source_root/build/windows/tyndall.exe
windows() { timeout -s KILL 300 wine "$windows_program" "$@"; }

echo '# hashes'
sets=$("$tyndall" version | sed -n 's/^kernels  *\(.*\); this CPU.*/\1/p')
pictures=0
for isa in $sets; do
  for scene in $("$tyndall" scenes | awk '{ print $1 }'); do
    small=("$scene" --size 32x24 --spp 2 --isa "$isa")
    same "$scene, $isa" "$(renderer=(windows) && image_hash "${small[@]}")" "$(image_hash "${small[@]}")"
    pictures=$((pictures + 1))
  done
done
echo "$pictures pictures compared ($sets)"
[ "$pictures" -gt 50 ] || fail 'too few scenes'

echo '# threads'
for threads in 2 4; do
  for ((k = 0; k < ${TYNDALL_TRIALS:-2000}; ++k)); do
    timeout -s KILL 60 wine "$windows_program" render cornell-box --size 16x16 --spp 1 -t "$threads" -q -o hang.pfm </dev/null ||
      fail "render $k with $threads threads did not end"
  done
done

echo '# names'
folder='Ördner mit 水'
mkdir "$folder"
for name in "$folder/Bild ü 😀.png" "$folder\\zwei.exr" "Z:$(echo "$PWD" | tr / '\\')\\drei.png"; do
  expect 0 windows render cornell-box --size 16x16 --spp 1 -o "$name"
  [ ! -s err ] || fail "standard error: $(cat err)"
done
ls "$folder/Bild ü 😀.png" "$folder/zwei.exr" drei.png >listed || fail 'a file has another name'
expect 0 windows convert "$folder/Bild ü 😀.png" -o scene.json
[ ! -s err ] || fail "standard error: $(cat err)"
grep -q $'\r' scene.json && fail 'a scene was written with CR LF'
sed 's/$/\r/' scene.json >crlf.json
expect 0 windows render '.\crlf.json' --size 16x16 --spp 1 -o crlf.png
[ ! -s err ] || fail "standard error: $(cat err)"
cmp -s crlf.png "$folder/Bild ü 😀.png" || echo 'the scene with CR LF has its own name inside'
expect 3 windows render cornell-box --size 8x8 --spp 1 -o NUL.png
complains 'NUL.png: cannot write: "NUL.png" is a device of Windows'
expect 3 windows render cornell-box --size 8x8 --spp 1 -o a.exr:b.exr
complains "found ':' in its name"
if [ "$(id -u)" != 0 ]; then # root may write into everything
  echo old >kept.png
  chmod 444 kept.png
  expect 3 windows render cornell-box --size 8x8 --spp 1 -o kept.png
  complains 'kept.png: cannot write: it may only be read'
  [ "$(cat kept.png)" = old ] || fail 'a read-only file was replaced'
fi
expect 2 windows render nope -o nope.png
complains nope

echo '# ends'
wine "$windows_program" render cornell-box --size 64x64 --spp 1000000 -t 2 -q -o ended.png >out 2>err </dev/null &
sleep 8
kill -INT $! || fail 'nothing to interrupt'
wait $!
[ -s ended.png ] || fail "Ctrl-C left no picture: $(cat err)"
sleep 7200 | wine cmd >cmd.out 2>&1 & # else each program begins with wine's own start, which must not be killed
waits=$!
for ending in png exr; do
  torn=0 lost=0 killed=0
  render=(render cornell-box --size 256x192 --spp 1 -q -o "whole.$ending")
  windows "${render[@]}" </dev/null
  for ((k = 0; k < ${TYNDALL_KILLS:-200}; ++k)); do # a render takes a quarter of a second
    { timeout -s KILL "$(awk "BEGIN { print 0.06 + $k * 0.0009 }")" wine "$windows_program" "${render[@]}" </dev/null; } 2>killed.err
    [ $? = 137 ] && killed=$((killed + 1))
    [ -s "whole.$ending" ] || lost=$((lost + 1))
    "$tyndall" inspect "whole.$ending" >out 2>err || torn=$((torn + 1))
  done
  echo "$ending: of $killed killed $torn torn, $lost lost"
  [ "$torn$lost" = 00 ] || fail 'an output was torn or lost'
done
kill $waits

echo '# window'
display=99
if command -v Xvfb >probe; then
  Xvfb :$display -screen 0 1280x800x24 >xvfb.log 2>&1 &
  server=$!
  sleep 2
  mkdir -p data
  env DISPLAY=:$display XDG_STATE_HOME="Z:$PWD/data" wine "$windows_program" view showroom --ui-log ui.txt >out 2>err </dev/null &
  viewer=$!
  for ((k = 0; k < 60; ++k)); do grep -q '^frame' ui.txt 2>/dev/null && break; sleep 1; done
  grep -q '^frame' ui.txt || fail "the window shows nothing: $(cat err)"
  kill -KILL $viewer
  wait $viewer 2>/dev/null
  kill $server
fi

echo '# tests'
# Without those of symbolic links, of names and messages with ':' and '/', of bytes that are no letters, of the clipboard,
# of lines that end with LF alone (main() sees to that), of processor time (which clock() does not count there), and of long
# double functions, which the other C library has not to all of their bits.
elsewhere='*links*,picture names: a*,idle:*,elementary*right*,bad scenes*,sky: what is no*,numbered names*,titles are*'
elsewhere+=',random keys*,the log says*'
for tests in core_tests app_tests; do
  timeout 3600 wine "$source_root/build/windows/tests/$tests.exe" -tce="$elsewhere" \
    >"$tests.log" 2>&1 || { tail -40 "$tests.log"; fail "$tests"; }
done
timeout 14400 wine "$windows_program" verify -t 2 -q >verify.log 2>&1 || { tail -20 verify.log; fail 'verify'; }
tail -1 verify.log
finish
