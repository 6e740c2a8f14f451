#!/usr/bin/env bash
# third_party/arm64_libraries.sh FOLDER: puts Debian's libraries for aarch64 into FOLDER, as the preset "arm64" needs them
# for cross compiling and qemu-user for running what was compiled. Changes nothing in the system, and needs no root: apt
# works with lists and a state of its own. The compiler and the emulator are Debian's g++-aarch64-linux-gnu and
# qemu-user-static.
set -euo pipefail
folder=$(mkdir -p "${1:?usage: arm64_libraries.sh FOLDER}" && cd "$1" && pwd -P)
[ -e "$folder/complete" ] && exit 0

wanted=(libc6 libstdc++6 libhwy-dev libfmt-dev libjpeg62-turbo-dev libpng-dev libopenexr-dev nlohmann-json3-dev libcli11-dev
  libstb-dev doctest-dev)
# What these need in turn, without the C library's headers: the cross compiler has its own.
needed='^(libgcc-s1|libc6|libstdc\+\+6|libhwy.*|libfmt.*|libjpeg.*|libpng.*|libopenexr.*|libimath.*|libdeflate.*|zlib1g.*|nlohmann.*|libcli11.*|libstb.*|doctest.*)$'

apt=$folder/apt
mkdir -p "$apt/state/lists/partial" "$apt/cache/archives/partial" "$folder/usr/lib"
[ -e "$folder/lib" ] || ln -s usr/lib "$folder/lib"
: >"$apt/status"
cat >"$apt/conf" <<CONF
APT::Architecture "arm64";
APT::Architectures { "arm64"; };
APT::Sandbox::User "";
Dir::State "$apt/state";
Dir::State::status "$apt/status";
Dir::Cache "$apt/cache";
Acquire::Retries "3";
Acquire::Languages "none";
CONF
export APT_CONFIG=$apt/conf
apt-get -q update >"$apt/log" 2>&1 || { cat "$apt/log" >&2 && exit 1; }
mapfile -t packages < <(apt-get -q -s install --no-install-recommends "${wanted[@]}" |
  awk -v needed="$needed" '$1 == "Inst" && $2 ~ needed { print $2 }')
[ ${#packages[@]} -gt ${#wanted[@]} ] || { echo "arm64_libraries: Debian's list has no packages for arm64" >&2 && exit 1; }
cd "$apt/cache"
apt-get -q download "${packages[@]}" >"$apt/log" 2>&1 || { cat "$apt/log" >&2 && exit 1; }
for package in *.deb; do dpkg -x "$package" "$folder/unpacked"; done
# Packages of Debian 12 still name /lib; here it is the same as /usr/lib.
for part in "$folder"/unpacked/lib "$folder"/unpacked/usr; do
  [ ! -d "$part" ] || cp -a "$part/." "$folder/$(case $part in */lib) echo usr/lib ;; *) echo usr ;; esac)/"
done
rm -rf "$folder/unpacked" "$apt"
touch "$folder/complete"
