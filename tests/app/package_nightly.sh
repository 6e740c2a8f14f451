#!/usr/bin/env bash
# The Debian package in a bare Debian 12: installed, used, removed. Takes minutes and a network; needs root and debootstrap.
# What it does and prints is kept in transcript.txt.
. "$(dirname "$0")/_common.sh"
build=$(dirname "$tyndall")
suite=bookworm mirror=${TYNDALL_DEBIAN_MIRROR:-http://deb.debian.org/debian}
skip() { echo "skipped: $*"; exit 77; }
[ "$(id -u)" = 0 ] || skip 'only root can change the root folder'
command -v debootstrap cpack dpkg-shlibdeps >probe || skip 'debootstrap, cpack or dpkg-shlibdeps is missing'
debootstrap --variant=minbase "$suite" root "$mirror" >debootstrap.log 2>&1 || skip "debootstrap: $(tail -1 debootstrap.log)"
(cd "$build" && cpack -B "$OLDPWD/packages") >cpack.log 2>&1 || { cat cpack.log; fail 'cpack'; finish; }
trap 'umount root/proc 2>/dev/null' EXIT
mount -t proc proc root/proc || skip 'proc cannot be mounted'
cp packages/tyndall_*.deb root/tmp
# Minimal systems leave the pages of the manual out.
rm -f root/etc/dpkg/dpkg.cfg.d/docker*
inside() { chroot root env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive "$@"; }
# try CODE COMMAND...: runs the command inside, writes it, what it prints and its seconds into the transcript.
try() {
  local code=$1 got=0 start=$EPOCHREALTIME
  shift
  inside "$@" >out 2>err </dev/null || got=$?
  {
    echo "# $*"
    cat out err | tail -n 12
    awk -v a="$start" -v b="$EPOCHREALTIME" 'BEGIN { printf "(%.1f s)\n\n", b - a }'
  } >>transcript.txt
  [ "$got" = "$code" ] || fail "exit code $got instead of $code: $*: $(tail -3 err)"
}
list_files() { inside find / -xdev \( -path /proc -o -path /tmp -o -path /var -o -path /run \) -prune -o -print | sort; }

ls -l packages/*.deb packages/*.tar.gz | awk '{ print $5, $9 }' >transcript.txt
try 0 apt-get update -q
try 0 apt-get install -q -y --no-install-recommends man-db bash-completion desktop-file-utils shared-mime-info
list_files >before
try 0 bash -c 'apt-get install -q -y --no-install-recommends /tmp/tyndall_*.deb && tyndall render showroom --size 640x360 --spp 16 -q -o /tmp/picture.png && ls -l /tmp/picture.png'
try 0 tyndall version
try 0 tyndall scenes
try 3 tyndall
try 0 tyndall verify plate
try 0 bash -c 'man tyndall | head -12'
try 0 bash -ic '. /usr/share/bash-completion/bash_completion; _completion_loader tyndall; COMP_WORDS=(tyndall render cover --integrator ""); COMP_CWORD=4; _tyndall; echo "${COMPREPLY[@]}"'
grep -q 'path nee mis' transcript.txt || fail 'completion does not work'
try 0 bash -c 'echo "{ \"tyndall\": 1 }" >/tmp/a.tyndall.json; grep tyndall /usr/share/mime/globs /usr/share/applications/mimeinfo.cache'
try 0 apt-get purge -q -y --auto-remove tyndall
list_files >after
left=$(comm -13 before after | grep -vE '^/etc/|__pycache__|/ld.so.cache')
same 'left after removal' '' "$left"
umount root/proc && rm -rf root
finish
