# The libraries of a build for browsers, from TYNDALL_WEB_LIBRARIES; their headers are found by the toolchain file's flags.
# Included by libraries.cmake.
set(web ${TYNDALL_WEB_LIBRARIES})
add_library(Threads::Threads INTERFACE IMPORTED)
add_library(nlohmann_json::nlohmann_json INTERFACE IMPORTED)
add_library(fmt::fmt-header-only INTERFACE IMPORTED)
set_target_properties(fmt::fmt-header-only PROPERTIES INTERFACE_COMPILE_DEFINITIONS FMT_HEADER_ONLY=1)
set(fmt_library fmt::fmt-header-only)
foreach(library IN ITEMS z png jpeg unwind)
  add_library(web_${library} STATIC IMPORTED)
  set_target_properties(web_${library} PROPERTIES IMPORTED_LOCATION ${web}/lib/lib${library}.a)
endforeach()
add_library(JPEG::JPEG ALIAS web_jpeg)
add_library(PNG::PNG ALIAS web_png)
target_link_libraries(web_png INTERFACE web_z)
add_library(tyndall_stb INTERFACE)
target_include_directories(tyndall_stb SYSTEM INTERFACE ${web}/include/stb)
add_library(tyndall_simd INTERFACE)
set(TYNDALL_OPENEXR_STATE off)

# The window's libraries. GLFW and OpenGL are emscripten's; app/web/glfw.cpp has what its GLFW lacks.
add_library(tyndall_imgui STATIC
  ${web}/imgui/imgui.cpp ${web}/imgui/imgui_draw.cpp ${web}/imgui/imgui_tables.cpp ${web}/imgui/imgui_widgets.cpp
  ${web}/imgui/backends/imgui_impl_glfw.cpp ${web}/imgui/backends/imgui_impl_opengl3.cpp)
target_include_directories(tyndall_imgui SYSTEM PUBLIC ${web}/imgui ${web}/imgui/backends)
target_compile_definitions(tyndall_imgui PUBLIC IMGUI_IMPL_OPENGL_ES3)
add_library(tyndall_window_libraries INTERFACE)
target_include_directories(tyndall_window_libraries INTERFACE ${CMAKE_CURRENT_LIST_DIR}/web)
target_compile_definitions(tyndall_window_libraries INTERFACE GLFW_INCLUDE_NONE)
target_link_libraries(tyndall_window_libraries INTERFACE tyndall_imgui)
set(TYNDALL_WINDOW_STATE on)
