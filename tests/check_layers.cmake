# Fails when a file includes what its layer may not see. Run with -DROOT=<source folder>.
#   base <- shapes, materials, media, textures, film <- scene <- compile <- kernel <- render <- app
# Rooms on one level do not see each other. Long files are printed, but are no failure.
cmake_minimum_required(VERSION 3.22)

set(level_core/base 0)
foreach(room IN ITEMS shapes materials media textures film)
  set(level_core/${room} 1)
endforeach()
set(level_core/scene 2)
set(level_core/compile 3)
set(level_core/kernel 4)
set(level_core/render 5)
set(level_app 6)

# Third-party headers, and which files may include them: pairs of regular expressions.
set(reserved
  "^(GLFW|glad|GL|EGL|X11|CLI)/|^(backends/)?imgui"  "^app/"
  "^hwy/"                                            "^core/base/lanes_simd_arithmetic\\.h$"
  "^nlohmann/"                                       "^app/|^core/scene/json[a-z_]*\\.cpp$"
  "^(OpenEXR|Imath)/|^(Imf|Imath)|^(stb/)?stb_"      "^core/film/image_io[a-z_]*\\.cpp$"
  "^iostream$"                                       "^app/")

set(problems "")

# The room of a path: core/<room>, or app for all of app.
function(room_of path result)
  string(REGEX MATCH "^(core/[a-z_]+|app)/" _ "${path}")
  set(${result} "${CMAKE_MATCH_1}" PARENT_SCOPE)
endfunction()

function(check_own file header)
  room_of("${file}" from)
  room_of("${header}" to)
  if(from STREQUAL "app" AND header STREQUAL "shaders.h") # generated
    return()
  endif()
  if(NOT DEFINED level_${to})
    set(problem "${file}: \"${header}\" is not a path from the root (core/<room>/... or app/...)")
  elseif(NOT from STREQUAL to AND NOT level_${to} LESS level_${from})
    set(problem "${file}: ${from} may not include ${header}")
  elseif(NOT EXISTS "${ROOT}/${header}")
    set(problem "${file}: ${header} does not exist")
  else()
    return()
  endif()
  set(problems ${problems} "${problem}" PARENT_SCOPE)
endfunction()

function(check_third_party file header)
  set(rules ${reserved})
  while(rules)
    list(POP_FRONT rules headers files)
    if(header MATCHES "${headers}" AND NOT file MATCHES "${files}")
      set(problems ${problems} "${file}: may not include <${header}> (only files that match ${files} may)")
    endif()
  endwhile()
  set(problems ${problems} PARENT_SCOPE)
endfunction()

file(GLOB_RECURSE files RELATIVE ${ROOT} ${ROOT}/core/*.h ${ROOT}/core/*.cpp ${ROOT}/app/*.h ${ROOT}/app/*.cpp)
foreach(file IN LISTS files)
  room_of("${file}" room)
  if(NOT DEFINED level_${room})
    list(APPEND problems "${file}: ${room} is no room of the house")
    continue()
  endif()
  file(STRINGS ${ROOT}/${file} lines REGEX "^[ \t]*#[ \t]*include")
  foreach(line IN LISTS lines)
    if(line MATCHES "include[ \t]*\"([^\"]+)\"")
      check_own("${file}" "${CMAKE_MATCH_1}")
    elseif(line MATCHES "include[ \t]*<([^>]+)>")
      check_third_party("${file}" "${CMAKE_MATCH_1}")
    endif()
  endforeach()
  file(READ ${ROOT}/${file} text)
  string(REGEX MATCHALL "\n" newlines "${text}")
  list(LENGTH newlines length)
  if(length GREATER 300)
    message("long file: ${file} has ${length} lines")
  endif()
endforeach()

if(problems)
  list(JOIN problems "\n  " text)
  message(FATAL_ERROR "layering broken:\n  ${text}")
endif()
