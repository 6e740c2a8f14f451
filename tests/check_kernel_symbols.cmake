# A weak function compiled for a wide instruction set may be the copy that the linker keeps for every caller, and then
# faults on an older processor. So the objects of such sets may define only weak symbols whose names carry the set's own
# tag. Weak read-only data is allowed: every copy is the same. They may not have static initialisers either: those run
# before any check of the processor.
# Run with -DSET=avx2 -DNM=nm [-DOBJDUMP=objdump] -P check_kernel_symbols.cmake OBJECT...
cmake_minimum_required(VERSION 3.22)

# Mangled, with lengths: tyndall's own namespace of the set, and Highway's.
set(tag_sse4 "4sse4|6N_SSE4")
set(tag_avx2 "4avx2|6N_AVX2")
set(tag_avx512 "6avx512|[0-9]N_AVX3")
set(problems "")

function(read_lines result)
  execute_process(COMMAND ${ARGN} OUTPUT_VARIABLE text COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX REPLACE "[][;]" " " text "${text}") # they would confuse a list
  string(REPLACE "\n" ";" text "${text}")
  set(${result} "${text}" PARENT_SCOPE)
endfunction()

set(objects "")
math(EXPR last "${CMAKE_ARGC} - 1")
foreach(i RANGE ${last})
  if("${CMAKE_ARGV${i}}" MATCHES "\\.o$")
    list(APPEND objects "${CMAKE_ARGV${i}}")
  endif()
endforeach()
if(NOT objects)
  message(FATAL_ERROR "no objects of ${SET} are given")
endif()
foreach(object IN LISTS objects)
  get_filename_component(file ${object} NAME)
  # name | value | class | type | size | line | section
  read_lines(lines ${NM} --format=sysv --defined-only ${object})
  foreach(line IN LISTS lines)
    if(NOT line MATCHES "^([^ |]+) *\\|[^|]*\\| *([a-zA-Z]) *\\|.*\\| *([^| ]*) *$")
      continue()
    endif()
    set(name "${CMAKE_MATCH_1}")
    set(class "${CMAKE_MATCH_2}")
    set(section "${CMAKE_MATCH_3}")
    if(name MATCHES "^_GLOBAL__sub_I|__static_initialization|^__cxx_global_var_init")
      list(APPEND problems "${file}: static initialiser ${name}")
    elseif(class MATCHES "[WVu]" AND NOT section MATCHES "^\\.rodata" AND NOT name MATCHES "^DW\\.ref\\."
           AND NOT name MATCHES "${tag_${SET}}")
      list(APPEND problems "${file}: weak symbol ${name}")
    endif()
  endforeach()
  if(OBJDUMP)
    read_lines(lines ${OBJDUMP} -h ${object})
    foreach(line IN LISTS lines)
      if(line MATCHES " \\.(init_array|ctors)")
        list(APPEND problems "${file}: static initialiser, section .${CMAKE_MATCH_1}")
      endif()
    endforeach()
  endif()
endforeach()

if(problems)
  list(REMOVE_DUPLICATES problems)
  list(JOIN problems "\n  " text)
  find_program(CXXFILT NAMES c++filt llvm-cxxfilt)
  if(CXXFILT)
    string(REPLACE "weak symbol " "" names "${text}")
    execute_process(COMMAND ${CMAKE_COMMAND} -E echo "${names}" COMMAND ${CXXFILT} OUTPUT_VARIABLE text)
  endif()
  message(FATAL_ERROR "in objects of wide instruction sets:\n  ${text}")
endif()
