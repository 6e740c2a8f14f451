#!/usr/bin/env bash
# What ./run builds, and says while it builds without a terminal, when the window ends for want of a display, on sources that cannot
# be written to, and without a network. CMake, dpkg-query, apt-get and the program that is built are stand-ins here.
. "$(dirname "$0")/_common.sh"
mkdir -p tree stand-ins
cp -r "$source_root/run" "$source_root/third_party" tree
cat >stand-ins/cmake <<'MSG'
#!/bin/sh
case $1 in
  --preset)
    mkdir -p "$4" && echo >"$4/build.ninja" && grep -m1 -E '^(flags|Features)' /proc/cpuinfo >"$4/processor.txt"
    echo "$5" >>configured
    echo "TYNDALL_INSTRUCTION_SETS:STRING=$(expr "${5:-=native}" : '.*=\(.*\)')" >"$4/CMakeCache.txt" ;;
  --build)
    case $* in *commands*) for step in 1 2 3; do echo "c++ -o $step.o -c $step.cpp"; done; exit ;; esac
    for step in 1 2 3; do
      sleep 0.7
      echo "[$step/3] Building CXX object $step.o"
      printf '%s\t%s\t0\t%s.o\t0\n' $((step * 700 - 700)) $((step * 700)) $step >>"$2/.ninja_log"
    done
    [ -z "$BROKEN" ] || { echo "a message of the compiler"; exit 1; }
    printf '#!/bin/sh\necho "ran $*"\n[ "$1" != view ] || exit "$VIEW_ENDS"\n' >"$2/tyndall" && chmod +x "$2/tyndall" ;;
esac
MSG
printf '#!/bin/sh\nexit 1\n' >stand-ins/dpkg-query
printf '#!/bin/sh\necho "Err: Could not resolve deb.debian.org"; echo "E: many lines"; exit 100\n' >stand-ins/apt-get
chmod +x stand-ins/* && chmod -R a+rX . && chmod a+rx "$PWD"
export PATH=$PWD/stand-ins:$PATH TYNDALL_TELL_SECONDS=1

expect 0 env TYNDALL_SKIP_PACKAGES=1 tree/run version
same 'standard output' 'ran version' "$(cat out)"
grep -qE '^building: about 0\.0 minutes in all, [0-9]+ % of them are over$' err || fail "progress is not told: $(cat err)"
expect 1 env TYNDALL_SKIP_PACKAGES=1 BROKEN=1 tree/run version
grep -q '^a message of the compiler$' err || fail "the compiler's message is not told: $(cat err)"

# A window that cannot be opened, or whose display goes away, ends with 3: the image takes its place. Other ends are kept.
expect 0 env TYNDALL_SKIP_PACKAGES=Yes DISPLAY=:9 VIEW_ENDS=3 tree/run my.json --seed 7
grep -q '^run: there is no window, so an image is rendered instead$' err || fail "the image is not told: $(cat err)"
grep -q '^ran render my.json --spp 64 -o my.png --seed 7$' err || fail "no image is rendered: $(cat err)"
same 'standard output' my.png "$(tail -n 1 out)"
expect 130 env TYNDALL_SKIP_PACKAGES=1 DISPLAY=:9 VIEW_ENDS=130 tree/run my.json
! grep -q 'image' err || fail "an image is rendered though the window was open: $(cat err)"

# It configures anew on another processor, and where other sets are asked for, and only then.
rm -r tree/build tree/configured
export TYNDALL_SKIP_PACKAGES=1
expect 0 tree/run version
expect 0 tree/run version
same 'configured once' 1 "$(wc -l <tree/configured)"
expect 0 env TYNDALL_INSTRUCTION_SETS=all tree/run version
expect 0 tree/run version
same 'configured for all, and kept' $'\n-DTYNDALL_INSTRUCTION_SETS=all' "$(cat tree/configured)"
echo 'flags : of another processor' >tree/build/release/processor.txt
expect 0 tree/run version
same 'configured on another processor, for all' 3 "$(grep -c '' tree/configured)"

# Another user: the sources cannot be written to.
rm -rf tree/build && mkdir -m 777 cache
if [ "$(id -u)" = 0 ] && setpriv --reuid 65534 --regid 65534 --clear-groups test -x "$PWD/tree/run"; then
  as_other=(setpriv --reuid 65534 --regid 65534 --clear-groups)
  expect 0 "${as_other[@]}" env XDG_CACHE_HOME="$PWD/cache" tree/run version
  grep -q "cannot be written to, so Tyndall is built in $PWD/cache/tyndall" err || fail "the other folder is not told: $(cat err)"
  expect 1 "${as_other[@]}" env XDG_CACHE_HOME=/nowhere tree/run version
  same 'lines' 1 "$(grep -c 'both cannot be written' err)"
  [ "$(wc -l <err)" = 1 ] || fail "expected one line: $(cat err)"
fi

if [ "$(id -u)" = 0 ]; then
  expect 1 env TYNDALL_SKIP_PACKAGES=off tree/run version
  grep -v '^installing packages' err >rest
  [ "$(wc -l <rest)" = 1 ] || fail "expected one line without a network: $(cat rest)"
  grep -q 'no server.*apt-get install .*g++' rest || fail "no network: $(cat rest)"
fi
finish
