# Most of the time of a first build goes into the headers that nearly every file includes. This reads them once a room
# instead of once a file.
include(${CMAKE_CURRENT_LIST_DIR}/ccache.cmake)
option(TYNDALL_QUICK_BUILD "compile the files of a room together; OFF: each alone, for quick rebuilds after edits" ON)

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
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${room})
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
endfunction()
