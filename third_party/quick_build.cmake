# Most of the time of a first build goes into the headers that nearly every file includes. Here they are read once a
# room, or once a target, instead of once a file.
include(${CMAKE_CURRENT_LIST_DIR}/ccache.cmake)
option(TYNDALL_QUICK_BUILD "compile the files of a room together; OFF: each alone, for quick rebuilds after edits" ON)

# Small rooms that are compiled as one: their headers take longer than they do.
set(small_rooms "^core_(base|system|film|accuracy)$" "^app_window_(timeline|handles|tools|gallery)$"
    "^app_window_(accuracy|edit|variations)$")

# Compiles the files that lie in one folder as one. Files with compiler options of their own stay alone (the kernels).
# Two files of a folder may therefore not give one name to two things, not even in unnamed namespaces.
function(tyndall_join_rooms target)
  if(NOT TYNDALL_QUICK_BUILD)
    return()
  endif()
  foreach(source IN LISTS ARGN)
    file(RELATIVE_PATH path ${PROJECT_SOURCE_DIR} ${source})
    get_filename_component(room ${path} DIRECTORY)
    string(REPLACE "/" "_" room ${room})
    foreach(rooms IN LISTS small_rooms)
      if(room MATCHES "${rooms}")
        list(FIND small_rooms "${rooms}" number)
        set(room small_rooms_${number})
      endif()
    endforeach()
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${room})
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
endfunction()

# Translates these headers once for all files of a target; "<string>", or a path from the root. Only where no cache of
# compiled files is at work: it would find nothing again after one of them changed. Every file still includes all that
# it uses: builds with a cache, and those with TYNDALL_QUICK_BUILD=OFF, show where it does not.
function(tyndall_precompile target)
  if(TYNDALL_QUICK_BUILD AND NOT CMAKE_CXX_COMPILER_LAUNCHER MATCHES "ccache")
    target_precompile_headers(${target} PRIVATE ${ARGN})
  endif()
endfunction()
