#!/usr/bin/env bash
# The library and the Python module, installed: found by CMake and by pkg-config, used from C++17 and C++20 and from
# Python. tests/library and tests/python hold what they do.
. "$(dirname "$0")/_common.sh"
build=$(dirname "$tyndall")
[ -f "$build/cmake_install.cmake" ] || { echo "skipped: $build is no build folder"; exit 77; }
cmake --install "$build" --prefix "$PWD/there" --strip >log 2>&1 || { cat log; fail 'cmake --install failed'; }
mv there moved # the tree works wherever it is
library=$(find "$PWD/moved" -name libtyndall.so.0)
[ -n "$library" ] || fail 'no library was installed'
folder=$(dirname "$library")
flags=$(PKG_CONFIG_PATH=$folder/pkgconfig pkg-config --cflags --libs tyndall) || fail 'pkg-config'
export LD_LIBRARY_PATH=$folder

# Nothing but what the header declares is seen by programs, and what the library is called is its name.
nm -DC --defined-only "$library" | grep -vE ' tyndall::v0::(Scene|Film|Picture|Error|render|compare|version|detail::)' |
  grep -vE '(typeinfo|typeinfo name|vtable) for tyndall::v0::Error$' >names
[ ! -s names ] || fail "the library shows more than its header: $(head -3 names)"
readelf -d "$library" | grep -q 'SONAME.*\[libtyndall.so.0\]' || fail 'the soname'
! readelf -d "$library" | grep -qE 'RPATH|RUNPATH|TEXTREL' || fail 'the library looks elsewhere, or is changed when loaded'
! readelf -d "$library" | grep -qE 'NEEDED.*(glfw|GL|X11|imgui)' || fail 'the library needs a window'

# It is used with all warnings, from C++17 and C++20.
cat >user.cpp <<'CPP'
#include <tyndall/tyndall.h>
#include <cstdio>
int main() {
  tyndall::Scene scene = tyndall::Scene::load("cornell-box");
  scene.set("/image/width", 16);
  scene.set("/image/height", 9);
#if __cplusplus >= 202002L
  const tyndall::Picture picture = tyndall::render(scene, {.spp = 2});
#else
  tyndall::RenderOptions options;
  options.spp = 2;
  const tyndall::Picture picture = tyndall::render(scene, options);
#endif
  std::puts(picture.hash().c_str());
}
CPP
expected=$("$tyndall" render cornell-box --size 16x9 --spp 2 -q --stats - -o x.pfm | sed -n 's/.*"image_hash": "\(.*\)".*/\1/p')
for standard in 17 20; do
  # shellcheck disable=SC2086
  ${CXX:-c++} -std=c++$standard -O1 -Wall -Wextra -Wpedantic -Werror -Wconversion -Wshadow user.cpp -o user$standard $flags ||
    fail "C++$standard"
  same "C++$standard" "$expected" "$(env -u TYNDALL_ASSETS ./user$standard)"
done
if cmake -S "$source_root/assets/examples/cmake" -B example -DCMAKE_PREFIX_PATH="$PWD/moved" >log 2>&1 &&
  cmake --build example >>log 2>&1; then
  expect 0 env -u TYNDALL_ASSETS example/sweep
  same 'lines of the example' 3 "$(grep -c '^/camera/vfov .*: mean 0\.[0-9]*, error 0\.' out)"
  expect 2 env -u TYNDALL_ASSETS example/sweep nothing
else
  cat log
  fail 'find_package(tyndall)'
fi

# So is the Python module, where there is one.
module=$(find "$PWD/moved" -name '_tyndall*.so')
if [ -n "$module" ]; then
  packages=$(dirname "$(dirname "$module")")
  same 'Python' "$expected" "$(env -u TYNDALL_ASSETS -u LD_LIBRARY_PATH PYTHONPATH="$packages" /usr/bin/python3 -B -c '
import tyndall
scene = tyndall.scene("cornell-box")
scene["/image/width"], scene["/image/height"] = 16, 9
print(scene.render(spp=2).hash)')"
else
  echo 'the Python module was not built: its test is skipped'
fi
finish
