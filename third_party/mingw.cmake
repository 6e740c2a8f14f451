# Toolchain file: Debian's cross compiler for 64-bit Windows, with the libraries that third_party/mingw_libraries.sh put
# into TYNDALL_MINGW_LIBRARIES (build/mingw-libraries), and wine for running what was built.
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_SYSTEM_PROCESSOR x86_64)
set(CMAKE_C_COMPILER x86_64-w64-mingw32-gcc-posix)
set(CMAKE_CXX_COMPILER x86_64-w64-mingw32-g++-posix)
set(CMAKE_RC_COMPILER x86_64-w64-mingw32-windres)

set(TYNDALL_MINGW_LIBRARIES ${CMAKE_CURRENT_LIST_DIR}/../build/mingw-libraries CACHE PATH "libraries for Windows")
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES TYNDALL_MINGW_LIBRARIES)
get_filename_component(libraries ${TYNDALL_MINGW_LIBRARIES} ABSOLUTE)
set(CMAKE_FIND_ROOT_PATH ${libraries} /usr/x86_64-w64-mingw32)
set(CMAKE_PREFIX_PATH ${libraries})
foreach(kind IN ITEMS LIBRARY INCLUDE PACKAGE)
  set(CMAKE_FIND_ROOT_PATH_MODE_${kind} ONLY)
endforeach()
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(ENV{PKG_CONFIG_LIBDIR} ${libraries}/lib/pkgconfig)
set(ENV{PKG_CONFIG_SYSROOT_DIR} "")
# Nothing but Windows' own DLLs is needed beside the program.
set(CMAKE_EXE_LINKER_FLAGS_INIT "-static")

find_program(WINE NAMES wine64 wine)
if(WINE)
  set(CMAKE_CROSSCOMPILING_EMULATOR ${WINE})
endif()
