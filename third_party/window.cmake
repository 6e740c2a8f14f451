# What the window needs: GLFW, Dear ImGui with its two backends, glad. Defines the target tyndall_window_libraries when
# all are there and TYNDALL_WINDOW allows it.
set(IMGUI_DIR "" CACHE PATH "Dear ImGui source tree to compile; empty: the system's library, found by pkg-config")

if(TARGET tyndall_window_libraries) # those of browsers
  return()
endif()
set(TYNDALL_WINDOW_STATE off)
if(TYNDALL_WINDOW) # AUTO or ON
  set(missing "")
  find_package(glfw3 3.3 CONFIG QUIET)
  if(NOT TARGET glfw)
    list(APPEND missing "GLFW (libglfw3-dev)")
  endif()
  if(NOT IMGUI_DIR AND PkgConfig_FOUND)
    pkg_check_modules(IMGUI QUIET IMPORTED_TARGET GLOBAL imgui>=1.86)
  endif()
  if(NOT IMGUI_DIR AND NOT TARGET PkgConfig::IMGUI)
    list(APPEND missing "Dear ImGui (libimgui-dev, or -DIMGUI_DIR=...)")
  endif()
  find_program(GLAD_EXECUTABLE NAMES glad PATHS /usr/bin NO_DEFAULT_PATH) # not a shim earlier in PATH
  find_program(GLAD_EXECUTABLE NAMES glad)
  if(NOT GLAD_EXECUTABLE)
    list(APPEND missing "glad 2 (python3-glad)")
  endif()
  list(JOIN missing ", " missing)
  if(missing AND TYNDALL_WINDOW STREQUAL "AUTO")
    message(STATUS "no window, headless commands only; missing: ${missing}")
  elseif(missing)
    message(FATAL_ERROR "TYNDALL_WINDOW=${TYNDALL_WINDOW}, but missing: ${missing}")
  else()
    set(TYNDALL_WINDOW_STATE on)
  endif()
endif()
if(NOT TYNDALL_WINDOW_STATE)
  return()
endif()

if(IMGUI_DIR)
  add_library(tyndall_imgui STATIC
    ${IMGUI_DIR}/imgui.cpp ${IMGUI_DIR}/imgui_draw.cpp ${IMGUI_DIR}/imgui_tables.cpp ${IMGUI_DIR}/imgui_widgets.cpp
    ${IMGUI_DIR}/backends/imgui_impl_glfw.cpp ${IMGUI_DIR}/backends/imgui_impl_opengl3.cpp)
  target_include_directories(tyndall_imgui SYSTEM PUBLIC ${IMGUI_DIR} ${IMGUI_DIR}/backends)
  target_link_libraries(tyndall_imgui PUBLIC glfw ${CMAKE_DL_LIBS})
  set_target_properties(tyndall_imgui PROPERTIES POSITION_INDEPENDENT_CODE ON CXX_VISIBILITY_PRESET hidden)
else()
  add_library(tyndall_imgui INTERFACE)
  target_link_libraries(tyndall_imgui INTERFACE PkgConfig::IMGUI)
endif()

# glad is generated here. Without --reproducible it would download the specification; without --extensions it would
# write all of them.
set(glad_dir ${PROJECT_BINARY_DIR}/glad)
add_custom_command(
  OUTPUT ${glad_dir}/include/glad/gl.h ${glad_dir}/include/KHR/khrplatform.h ${glad_dir}/src/gl.c
  COMMAND ${CMAKE_COMMAND} -E env PYTHONNOUSERSITE=1 ${GLAD_EXECUTABLE} --quiet --reproducible --api gl:core=3.3
          --extensions GL_KHR_debug --out-path ${glad_dir} c
  COMMENT "Generating glad for OpenGL 3.3 core" VERBATIM)
add_library(tyndall_glad STATIC ${glad_dir}/src/gl.c)
target_include_directories(tyndall_glad SYSTEM PUBLIC ${glad_dir}/include)
set_target_properties(tyndall_glad PROPERTIES C_STANDARD 99 POSITION_INDEPENDENT_CODE ON C_VISIBILITY_PRESET hidden)

add_library(tyndall_window_libraries INTERFACE)
target_compile_definitions(tyndall_window_libraries INTERFACE GLFW_INCLUDE_NONE)
target_link_libraries(tyndall_window_libraries INTERFACE tyndall_glad tyndall_imgui glfw ${CMAKE_DL_LIBS})
