#!/usr/bin/env bash
# third_party/web_libraries.sh FOLDER: compiles Debian's sources of zlib, libpng and libjpeg-turbo by Debian's emscripten
# into FOLDER, and copies there the headers of the libraries that are headers alone and Dear ImGui's sources, as the preset
# "web" needs them. Changes nothing in the system, and needs no root: apt works with lists of its own. Wants the packages
# that web_packages of third_party/packages.sh names.
set -euo pipefail
folder=$(mkdir -p "${1:?usage: web_libraries.sh FOLDER}" && cd "$1" && pwd -P)
here=$(cd "$(dirname "$0")" && pwd -P)
[ -e "$folder/complete" ] && exit 0
export NODE_PATH=/usr/share/nodejs # Debian's acorn, also where node is not Debian's
flags=(-O2 -pthread -msimd128 -mnontrapping-fptoint -fwasm-exceptions -sSUPPORT_LONGJMP=wasm)
apt=$folder/apt log=$folder/log
mkdir -p "$folder"/{include,lib,sources,objects}
# shellcheck source=third_party/sources.sh
. "$here/sources.sh"
cd "$folder/sources"
get_sources "$apt" zlib libpng1.6 libjpeg-turbo imgui || {
  echo "web_libraries: apt-get cannot get the sources of zlib, libpng, libjpeg-turbo and Dear ImGui (see $apt/log); try again where Debian's servers can be reached" >&2
  exit 1
}

# compile LIBRARY OPTION... -- FILE...
compile() {
  local library=$1 options=() objects=() file
  shift
  while [ "$1" != -- ]; do options+=("$1") && shift; done
  shift
  for file in "$@"; do
    objects+=("$folder/objects/$library-$(basename "${file%.*}").o")
    emcc "${flags[@]}" "${options[@]}" -c "$file" -o "${objects[-1]}"
  done
  emar rcs "$folder/lib/lib$library.a" "${objects[@]}"
}
zlib=$(echo zlib-*/) png=$(echo libpng1.6-*/) jpeg=$(echo libjpeg-turbo-*/) imgui=$(echo imgui-*/)
cp "$zlib"/{zlib,zconf}.h "$png"/{png,pngconf}.h "$folder/include"
cp "$png/scripts/pnglibconf.h.prebuilt" "$folder/include/pnglibconf.h"
compile z -DHAVE_UNISTD_H -- "$zlib"/{adler32,compress,crc32,deflate,infback,inffast,inflate,inftrees,trees,uncompr,zutil}.c
compile png -I"$folder/include" -- "$png"/png{,error,get,mem,pread,read,rio,rtran,rutil,set,trans,wio,write,wtran,wutil}.c
{ emcmake cmake -G Ninja -S "$jpeg" -B jpeg -DCMAKE_BUILD_TYPE=Release -DENABLE_SHARED=OFF -DWITH_SIMD=OFF \
  -DWITH_TURBOJPEG=OFF -DHAVE_SIZE_T=1 -DSIZE_T=4 -DHAVE_UNSIGNED_LONG=1 -DUNSIGNED_LONG=4 \
  -DCMAKE_C_FLAGS="${flags[*]}" && ninja -C jpeg -j "$(nproc)" jpeg-static; } >>"$log" 2>&1 || { tail -30 "$log" >&2 && exit 1; }
cp jpeg/libjpeg.a "$folder/lib" && cp jpeg/jconfig.h "$jpeg"/{jpeglib,jmorecfg,jerror}.h "$folder/include"
# For exceptions Debian's LLVM 14 takes a variable of emscripten's library for one of all threads, and the library has one
# for each: nothing would be caught. Here it is one of all threads for both.
unwind=/usr/share/emscripten/system/lib/libunwind
sed 's/^thread_local //; s/_LIBUNWIND_EXPORT//' $unwind/src/Unwind-wasm.c >unwind.c
compile unwind -D__USING_WASM_EXCEPTIONS__ -DNDEBUG -I$unwind/include -I$unwind/src -- unwind.c
cp -r "$imgui" "$folder/imgui"
for headers in nlohmann CLI fmt stb hwy; do cp -r "/usr/include/$headers" "$folder/include"; done
mkdir -p "$folder/include/GLFW" && cp /usr/include/GLFW/glfw3.h "$folder/include/GLFW" # emscripten's is of an older version
rm -rf "$apt" "$folder"/{sources,objects}
touch "$folder/complete"
