# Where the libraries of the core and of the command line come from: the system's packages.
# Required: threads, nlohmann_json, CLI11, {fmt}, stb, libjpeg-turbo, libpng. Optional: Highway (SIMD kernels), OpenEXR,
# doctest (tests).
if(EMSCRIPTEN)
  include(${CMAKE_CURRENT_LIST_DIR}/web_libraries.cmake)
  return()
endif()
find_package(Threads REQUIRED)
find_package(PkgConfig)
find_package(nlohmann_json 3.9 CONFIG REQUIRED)
find_package(CLI11 2 CONFIG REQUIRED)
find_package(fmt 8 CONFIG REQUIRED)
find_package(JPEG REQUIRED)
find_package(PNG 1.6 REQUIRED)
find_package(doctest 2.4 CONFIG QUIET)

# Debian's {fmt} and OpenEXR are compiled with GNU's standard library. With libc++ {fmt} is taken from its headers, and
# OpenEXR is left out unless -DTYNDALL_OPENEXR=ON says that there is one for libc++.
include(CheckCXXSymbolExists)
check_cxx_symbol_exists(_LIBCPP_VERSION ciso646 TYNDALL_LIBCXX)
set(fmt_library fmt::fmt)
if(TYNDALL_LIBCXX)
  set(fmt_library fmt::fmt-header-only)
  if(TYNDALL_OPENEXR STREQUAL "AUTO")
    set(TYNDALL_OPENEXR OFF)
  endif()
endif()

# stb: two headers, included as <stb_image.h>.
find_path(STB_INCLUDE_DIR stb_image_write.h PATH_SUFFIXES stb REQUIRED)
add_library(tyndall_stb INTERFACE)
target_include_directories(tyndall_stb SYSTEM INTERFACE ${STB_INCLUDE_DIR})

# Highway: used through its headers; its small library is linked for its assertions in Debug builds.
option(TYNDALL_SIMD "kernels for wide instruction sets; OFF: the scalar ones alone, which compile quickly" ON)
set(x86_64 "^(x86_64|AMD64|amd64)$")
if(TYNDALL_SIMD AND CMAKE_SYSTEM_PROCESSOR MATCHES "${x86_64}|^(aarch64|arm64)$" AND PkgConfig_FOUND)
  pkg_check_modules(HIGHWAY QUIET IMPORTED_TARGET GLOBAL libhwy>=1.0)
endif()
if(TARGET PkgConfig::HIGHWAY)
  add_library(tyndall_simd INTERFACE)
  target_link_libraries(tyndall_simd INTERFACE PkgConfig::HIGHWAY)
elseif(TYNDALL_SIMD)
  message(STATUS "Highway >= 1.0 (libhwy-dev) not found, or neither x86-64 nor 64-bit ARM: only the scalar kernel is built")
endif()

# OpenEXR.
set(TYNDALL_OPENEXR_STATE off)
if(TYNDALL_OPENEXR AND PkgConfig_FOUND) # AUTO or ON
  pkg_check_modules(OPENEXR QUIET IMPORTED_TARGET GLOBAL OpenEXR>=2.5)
endif()
if(TYNDALL_OPENEXR AND TARGET PkgConfig::OPENEXR)
  add_library(tyndall_openexr INTERFACE)
  target_link_libraries(tyndall_openexr INTERFACE PkgConfig::OPENEXR)
  set(TYNDALL_OPENEXR_STATE on)
elseif(TYNDALL_OPENEXR STREQUAL "AUTO")
  message(STATUS "OpenEXR (libopenexr-dev) not found: no EXR images")
elseif(TYNDALL_OPENEXR)
  message(FATAL_ERROR "TYNDALL_OPENEXR=${TYNDALL_OPENEXR} but OpenEXR (libopenexr-dev) was not found")
endif()
