# Embeds shaders/*.vert and *.frag in the program: the generated header "shaders.h" holds one string per file, named
# after it (display.vert: tyndall::display_vert). Included by CMakeLists.txt, and run with -P as the generator.
if(CMAKE_SCRIPT_MODE_FILE STREQUAL CMAKE_CURRENT_LIST_FILE)
  # -DOUTPUT=shaders.h -DSHADERS="a.vert b.frag" -DFOLDER=shaders -DES=: OpenGL, ON: OpenGL ES 3, of browsers
  set(version "#version 330 core")
  if(ES)
    set(version "#version 300 es")
  endif()
  set(text "// Generated from the folder shaders.\n#pragma once\nnamespace tyndall {\n")
  string(APPEND text "inline constexpr char glsl_version[] = R\"GLSL(${version})GLSL\";\n")
  separate_arguments(names UNIX_COMMAND "${SHADERS}")
  foreach(name IN LISTS names)
    file(READ "${FOLDER}/${name}" source)
    if(ES)
      string(REPLACE "#version 330 core" "${version}\nprecision highp float;" source "${source}")
    endif()
    string(MAKE_C_IDENTIFIER "${name}" identifier)
    string(APPEND text "inline constexpr char ${identifier}[] = R\"GLSL(${source})GLSL\";\n")
  endforeach()
  file(WRITE "${OUTPUT}" "${text}}  // namespace tyndall\n")
  return()
endif()

set(shader_folder ${PROJECT_SOURCE_DIR}/shaders)
file(GLOB shader_files CONFIGURE_DEPENDS ${shader_folder}/*.vert ${shader_folder}/*.frag)
set(shader_names "")
foreach(file IN LISTS shader_files)
  get_filename_component(name ${file} NAME)
  string(APPEND shader_names " ${name}")
endforeach()
set(shader_header ${PROJECT_BINARY_DIR}/generated/shaders.h)
add_custom_command(
  OUTPUT ${shader_header}
  COMMAND ${CMAKE_COMMAND} "-DOUTPUT=${shader_header}" "-DSHADERS=${shader_names}" "-DFOLDER=${shader_folder}"
          "-DES=${EMSCRIPTEN}"
          -P ${CMAKE_CURRENT_LIST_DIR}/shaders.cmake
  DEPENDS ${shader_files} ${CMAKE_CURRENT_LIST_DIR}/shaders.cmake
  COMMENT "Embedding shaders" VERBATIM)
add_custom_target(tyndall_shader_header DEPENDS ${shader_header})
add_library(tyndall_shaders INTERFACE)
add_dependencies(tyndall_shaders tyndall_shader_header)
target_include_directories(tyndall_shaders INTERFACE ${PROJECT_BINARY_DIR}/generated)
