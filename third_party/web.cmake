# Toolchain file: Debian's emscripten, with the libraries that third_party/web_libraries.sh put into TYNDALL_WEB_LIBRARIES
# (build/web-libraries), and node for running what was built.
set(EMSCRIPTEN_SYSTEM_PROCESSOR wasm32)
set(TYNDALL_WEB_LIBRARIES ${CMAKE_CURRENT_LIST_DIR}/../build/web-libraries CACHE PATH "libraries for WebAssembly")
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES TYNDALL_WEB_LIBRARIES)
get_filename_component(libraries ${TYNDALL_WEB_LIBRARIES} ABSOLUTE)
# Exceptions and longjmp are WebAssembly's own. Without the last option, conversions to integers are guarded by comparisons.
set(CMAKE_C_FLAGS_INIT
    "-pthread -fwasm-exceptions -sSUPPORT_LONGJMP=wasm -msimd128 -mnontrapping-fptoint -isystem ${libraries}/include")
set(CMAKE_CXX_FLAGS_INIT "${CMAKE_C_FLAGS_INIT} -include ${CMAKE_CURRENT_LIST_DIR}/web/std.h")
include(/usr/share/emscripten/cmake/Modules/Platform/Emscripten.cmake)
