# A weak function compiled for a wide instruction set may be the copy that the linker keeps for every caller, and then
# faults on an older processor. So the objects of such sets may define only weak symbols whose names carry the set's own
# tag. Weak read-only data is allowed: every copy is the same. They may not have static initialisers either: those run
# before any check of the processor.
# Run with -DLIBRARY=libtyndall_core.a -DNM=nm [-DOBJDUMP=objdump].
cmake_minimum_required(VERSION 3.22)

# Mangled, with lengths: tyndall's own namespace of the set, and Highway's.
set(tag_sse4 "4sse4|6N_SSE4")
set(tag_avx2 "4avx2|6N_AVX2")
set(tag_avx512 "6avx512|[0-9]N_AVX3")
set(problems "")

# Which set an archive member belongs to; empty for all other members.
macro(set_of member result)
  if("${member}" MATCHES "^(sse4|avx2|avx512)[a-z0-9_]*\\.cpp\\.o")
    set(${result} ${CMAKE_MATCH_1})
  else()
    set(${result} "")
  endif()
endmacro()

function(read_lines result)
  execute_process(COMMAND ${ARGN} OUTPUT_VARIABLE text COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX REPLACE "[][;]" " " text "${text}") # they would confuse a list
  string(REPLACE "\n" ";" text "${text}")
  set(${result} "${text}" PARENT_SCOPE)
endfunction()

# name | value | class | type | size | line | section
read_lines(lines ${NM} --format=sysv --defined-only ${LIBRARY})
set(set "")
foreach(line IN LISTS lines)
  if(line MATCHES "([^ /]+\\.o)[ :]*$")
    set(member "${CMAKE_MATCH_1}")
    set_of("${member}" set)
  elseif(set AND line MATCHES "^([^ |]+) *\\|[^|]*\\| *([a-zA-Z]) *\\|.*\\| *([^| ]*) *$")
    set(name "${CMAKE_MATCH_1}")
    set(class "${CMAKE_MATCH_2}")
    set(section "${CMAKE_MATCH_3}")
    if(name MATCHES "^_GLOBAL__sub_I|__static_initialization|^__cxx_global_var_init")
      list(APPEND problems "${member}: static initialiser ${name}")
    elseif(class MATCHES "[WVu]" AND NOT section MATCHES "^\\.rodata" AND NOT name MATCHES "^DW\\.ref\\."
           AND NOT name MATCHES "${tag_${set}}")
      list(APPEND problems "${member}: weak symbol ${name}")
    endif()
  endif()
endforeach()

if(OBJDUMP)
  read_lines(lines ${OBJDUMP} -h ${LIBRARY})
  foreach(line IN LISTS lines)
    if(line MATCHES "^([^ /]+\\.o):")
      set(member "${CMAKE_MATCH_1}")
      set_of("${member}" set)
    elseif(set AND line MATCHES " \\.(init_array|ctors)")
      list(APPEND problems "${member}: static initialiser, section .${CMAKE_MATCH_1}")
    endif()
  endforeach()
endif()

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
