#!/usr/bin/env bash
# third_party/mingw_libraries.sh FOLDER: puts the libraries for Windows into FOLDER, as the preset "windows" needs them.
# What is headers alone comes from Debian's packages for this machine, zlib from libz-mingw-w64-dev; libpng, libjpeg-turbo,
# OpenEXR, GLFW, Highway and Dear ImGui are compiled from the sources of Debian's packages, without a change. Changes
# nothing in the system, and needs no root: apt works with lists of its own. The compiler is g++-mingw-w64-x86-64-posix.
set -euo pipefail
folder=$(mkdir -p "${1:?usage: mingw_libraries.sh FOLDER}" && cd "$1" && pwd -P)
here=$(cd "$(dirname "$0")" && pwd -P)
[ -e "$folder/complete" ] && exit 0
log=$folder/log
# quietly COMMAND...: shows what it says only if it fails.
quietly() { "$@" >"$log" 2>&1 || { cat "$log" >&2 && exit 1; }; }

# ---- sources
mkdir -p "$folder"/{include,lib/pkgconfig,lib/cmake/fmt,licenses,sources} && cd "$folder/sources"
# shellcheck source=third_party/sources.sh
. "$here/sources.sh"
get_sources "$folder/apt" libpng1.6 libjpeg-turbo imath openexr glfw3 highway imgui || { cat "$folder/apt/log" >&2 && exit 1; }

# ---- headers alone, and zlib
cp -r /usr/include/{hwy,nlohmann,CLI,fmt,doctest,stb} "$folder/include/"
cp -r /usr/share/cmake/{nlohmann_json,CLI11} /usr/lib/cmake/doctest "$folder/lib/cmake/"
sed -i "s|\"/usr\"|\"$folder\"|" "$folder/lib/cmake/doctest/doctestTargets.cmake"
mkdir -p "$folder/share" && cp -r /usr/share/cmake "$folder/share/"
cp /usr/x86_64-w64-mingw32/include/z{lib,conf}.h "$folder/include/" && cp /usr/x86_64-w64-mingw32/lib/libz.a "$folder/lib/"
fmt=$(dpkg-query -W -f='${source:Upstream-Version}' libfmt-dev | sed 's/+.*//')
cat >"$folder/lib/cmake/fmt/fmt-config.cmake" <<'CMAKE'
add_library(fmt::fmt INTERFACE IMPORTED)
target_compile_definitions(fmt::fmt INTERFACE FMT_HEADER_ONLY=1)
target_include_directories(fmt::fmt INTERFACE ${CMAKE_CURRENT_LIST_DIR}/../../../include)
CMAKE
printf 'set(PACKAGE_VERSION %s)\nset(PACKAGE_VERSION_COMPATIBLE TRUE)\n' "$fmt" >"$folder/lib/cmake/fmt/fmt-config-version.cmake"

# ---- what is compiled
build() { # SOURCE OPTION...
  local source build
  source=$(echo "$folder/sources/$1"-*/)
  build=$folder/build/$1
  shift
  quietly cmake -S "$source" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_TOOLCHAIN_FILE="$here/mingw.cmake" \
    -DTYNDALL_MINGW_LIBRARIES="$folder" -DCMAKE_INSTALL_PREFIX="$folder" -DBUILD_SHARED_LIBS=OFF -DBUILD_TESTING=OFF "$@"
  quietly cmake --build "$build" --parallel "${TYNDALL_JOBS:-$(nproc)}" --target install
}
build libpng1.6 -DPNG_SHARED=OFF -DPNG_TESTS=OFF
build libjpeg-turbo -DENABLE_SHARED=OFF -DWITH_SIMD=OFF -DWITH_TURBOJPEG=OFF # its faster code needs nasm
build imath -DIMATH_INSTALL_SYM_LINK=OFF
build openexr -DOPENEXR_BUILD_TOOLS=OFF -DOPENEXR_INSTALL_EXAMPLES=OFF -DOPENEXR_INSTALL_TOOLS=OFF
build glfw3 -DGLFW_BUILD_DOCS=OFF -DGLFW_BUILD_TESTS=OFF -DGLFW_BUILD_EXAMPLES=OFF
mkdir -p "$folder/build/hwy"
highway=$(echo "$folder"/sources/highway-*/)
for file in aligned_allocator targets; do
  x86_64-w64-mingw32-g++-posix -O2 -std=c++17 -I"$highway" -c "$highway/hwy/$file.cc" -o "$folder/build/hwy/$file.o"
done
rm -f "$folder/lib/libhwy.a" && x86_64-w64-mingw32-ar rcs "$folder/lib/libhwy.a" "$folder"/build/hwy/*.o
pkg_config() { # NAME PACKAGE LIBRARIES INCLUDES
  printf 'Name: %s\nDescription: %s\nVersion: %s\nLibs: -L%s/lib %s\nCflags: %s\n' "$1" "$1" \
    "$(dpkg-query -W -f='${source:Upstream-Version}' "$2")" "$folder" "$3" "$4" >"$folder/lib/pkgconfig/$1.pc"
}
pkg_config libhwy libhwy-dev -lhwy "-I$folder/include"
cd "$folder/lib"
exr=$(for library in OpenEXR OpenEXRCore IlmThread Iex Imath; do printf -- '-l%s ' "$(basename lib$library-*.a .a | sed 's/^lib//')"; done)
pkg_config OpenEXR libopenexr-dev "$exr-lz" "-I$folder/include/OpenEXR -I$folder/include/Imath"
cp -r "$folder"/sources/imgui-*/ "$folder/imgui"

# ---- the notices that a copy of the program must have with it
for package in libpng1.6 libjpeg-turbo imath openexr glfw3 highway imgui; do
  cp "$folder/sources/$package"-*/debian/copyright "$folder/licenses/$package"
done
for package in libz-mingw-w64-dev libfmt-dev nlohmann-json3-dev libcli11-dev libstb-dev gcc-mingw-w64-x86-64-posix-runtime mingw-w64-common \
  fonts-roboto-unhinted fonts-jetbrains-mono; do
  [ ! -e "/usr/share/doc/$package/copyright" ] || cp -L "/usr/share/doc/$package/copyright" "$folder/licenses/$package"
done
rm -rf "$folder/build" "$folder/apt"
touch "$folder/complete"
