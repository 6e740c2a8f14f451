# The build for browsers: the page, and a program for node that tests compare with others. Included by CMakeLists.txt.

# Where node is not Debian's it finds Debian's acorn, which emscripten's linker needs, by this.
set_property(GLOBAL PROPERTY RULE_LAUNCH_LINK "${CMAKE_COMMAND} -E env NODE_PATH=/usr/share/nodejs")
set(initial_memory 268435456)
set(maximum_memory 2147483648)
set(web_link -pthread -fwasm-exceptions -sSUPPORT_LONGJMP=wasm -sALLOW_MEMORY_GROWTH=1 -sINITIAL_MEMORY=${initial_memory}
    -sMAXIMUM_MEMORY=${maximum_memory} -sTOTAL_STACK=4MB -sDEFAULT_PTHREAD_STACK_SIZE=2MB -Wno-pthreads-mem-growth)

add_executable(tyndall_headless EXCLUDE_FROM_ALL tests/web/headless.cpp)
target_link_libraries(tyndall_headless PRIVATE tyndall_options tyndall_core web_unwind)
target_link_options(tyndall_headless PRIVATE ${web_link} -sENVIRONMENT=node,worker -sPTHREAD_POOL_SIZE=4 -sEXIT_RUNTIME=1
                    -sNODERAWFS=1)

# ---- the page: the window, without what only a program on a desk has ------------------------------------------------
file(GLOB_RECURSE window_sources CONFIGURE_DEPENDS app/window/*.cpp)
file(GLOB page_sources CONFIGURE_DEPENDS app/web/*.cpp app/text/*.cpp app/curves/*.cpp app/report/*.cpp
     app/comparison/comparison.cpp app/files/arriving_picture.cpp app/files/memory.cpp
     app/files/outputs.cpp app/files/watched_function.cpp)
list(APPEND page_sources ${window_sources})
list(FILTER page_sources EXCLUDE REGEX "app/window/page_commands.cpp$")
add_executable(tyndall_page ${page_sources})
tyndall_join_rooms(tyndall_page ${page_sources})
tyndall_precompile(tyndall_page <algorithm> <filesystem> <fmt/core.h> <functional> <optional> <string> <variant> <vector>
                   core/base/text.h core/render/renderer.h core/scene/place.h)
target_compile_options(tyndall_page PRIVATE $<$<CONFIG:Release>:-Os>)
target_compile_definitions(tyndall_page PRIVATE TYNDALL_WINDOW=1)
target_link_libraries(tyndall_page PRIVATE tyndall_options tyndall_core nlohmann_json::nlohmann_json tyndall_stb
                      ${fmt_library} tyndall_window_libraries tyndall_shaders web_z web_unwind)

# Scenes, templates and fonts come with the page; textures when they are read, see page.js. Of the fonts it has the characters that
# app/window/system/style.cpp always loads.
set(characters U+20-17F,U+370-45F,U+2010-2026,U+2070-209C,U+2190-2193,U+2212,U+221E,U+2248,U+2264,U+2265)
set(fonts /usr/share/fonts/truetype)
set(preloaded "SHELL:--preload-file ${PROJECT_SOURCE_DIR}/assets/scenes@/assets/scenes"
              "SHELL:--preload-file ${PROJECT_SOURCE_DIR}/assets/templates@/assets/templates")
foreach(font IN ITEMS roboto/unhinted/RobotoTTF/Roboto-Regular.ttf roboto/unhinted/RobotoTTF/Roboto-Medium.ttf
                      jetbrains-mono/JetBrainsMono-Regular.ttf)
  get_filename_component(name ${font} NAME)
  execute_process(COMMAND /usr/bin/pyftsubset ${fonts}/${font} --unicodes=${characters} --layout-features=
                          --no-hinting --output-file=${PROJECT_BINARY_DIR}/${name} COMMAND_ERROR_IS_FATAL ANY)
  list(APPEND preloaded "SHELL:--preload-file ${PROJECT_BINARY_DIR}/${name}@${fonts}/${font}")
endforeach()
target_link_options(tyndall_page PRIVATE ${web_link} ${preloaded} -sENVIRONMENT=web,worker -sUSE_GLFW=3
                    -sMAX_WEBGL_VERSION=2 -sMIN_WEBGL_VERSION=2 -sFORCE_FILESYSTEM=1
                    "-sPTHREAD_POOL_SIZE=Math.min(navigator.hardwareConcurrency, 16) + 6"
                    "-sEXPORTED_FUNCTIONS=[_main,_malloc,_free]"
                    "-sEXPORTED_RUNTIME_METHODS=[ENV,stringToNewUTF8,setValue]")
add_custom_command(TARGET tyndall_page POST_BUILD COMMAND ${PROJECT_SOURCE_DIR}/app/web/sizes.sh)
set(TEXTURES "")
file(GLOB textures CONFIGURE_DEPENDS assets/textures/*)
foreach(texture IN LISTS textures)
  get_filename_component(name ${texture} NAME)
  file(SIZE ${texture} size)
  string(APPEND TEXTURES "['${name}', ${size}], ")
  configure_file(${texture} ${PROJECT_BINARY_DIR}/textures/${name} COPYONLY)
endforeach()
math(EXPR INITIAL_PAGES "${initial_memory} / 65536")
math(EXPR MAXIMUM_PAGES "${maximum_memory} / 65536")
configure_file(app/web/page.js ${PROJECT_BINARY_DIR}/page.js @ONLY)
configure_file(app/web/page.html ${PROJECT_BINARY_DIR}/index.html COPYONLY)
configure_file(app/web/isolate.js ${PROJECT_BINARY_DIR}/isolate.js COPYONLY)
