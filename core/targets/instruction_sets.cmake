# Which instruction sets the kernels are compiled for, with which flags. Included by CMakeLists.txt.
#
# all_instruction_sets:  those of processors of the target's kind, beside the scalar code, which runs on all of them
# instruction_sets:      those of them that this build has
# tyndall_instruction_set_library(NAME SET SOURCE...): an object library with the flags of the set
set(TYNDALL_INSTRUCTION_SETS all CACHE STRING
    "kernels beside the scalar one: all; native (the best of this processor); or a list of sse4, avx2, avx512, neon, wasm")

# Highway falls back silently to fewer lanes when one of these flags is missing; core/base/lanes_target.h sees to it.
set(flags_sse4 -msse4.2 -maes -mpclmul)
set(flags_avx2 -mavx2 -mfma -mbmi -mbmi2 -maes -mpclmul -mf16c)
set(flags_avx512 -march=skylake-avx512 -mprefer-vector-width=512)
# Structures of lanes are copied in whole groups. In smaller pieces, which are what GCC takes otherwise, a processor cannot
# forward what it has just stored to the next load.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  list(APPEND flags_avx2 -mmove-max=256 -mstore-max=256)
  list(APPEND flags_avx512 -mmove-max=512 -mstore-max=512)
endif()
# What 64-bit ARM always has. Without this definition Highway would also ask for cryptographic instructions, which not all
# of those processors have. Lanes that a mask leaves out may hold anything; here GCC takes that for a mistake.
set(flags_neon -DTOOLCHAIN_MISS_SYS_AUXV_H $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
function(tyndall_instruction_set_library name set)
  add_library(${name} OBJECT EXCLUDE_FROM_ALL ${ARGN})
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR})
  target_compile_definitions(${name} PRIVATE TYNDALL_TARGET=${set})
  target_compile_options(${name} PRIVATE ${flags_${set}})
  target_link_libraries(${name} PRIVATE tyndall_options tyndall_arithmetic tyndall_simd)
endfunction()

set(all_instruction_sets "")
if(EMSCRIPTEN)
  set(all_instruction_sets wasm)
elseif(TARGET tyndall_simd AND CMAKE_SYSTEM_PROCESSOR MATCHES "${x86_64}")
  set(all_instruction_sets sse4 avx2 avx512)
elseif(TARGET tyndall_simd)
  set(all_instruction_sets neon)
endif()

# What core/base/target.h knows of the build: targets of the sets given, and of all sets.
function(write_targets folder)
  foreach(list IN ITEMS ARGN all_instruction_sets)
    set(${list}_targets Target::scalar)
    foreach(set IN LISTS ${list})
      string(APPEND ${list}_targets ", Target::${set}")
    endforeach()
  endforeach()
  file(CONFIGURE OUTPUT ${folder}/tyndall_targets.h CONTENT "#define TYNDALL_BUILT_TARGETS ${ARGN_targets}
#define TYNDALL_ALL_TARGETS ${all_instruction_sets_targets}
")
endfunction()

# The best set that this processor runs, by the question that the program asks.
function(find_native_set result)
  set(folder ${PROJECT_BINARY_DIR}/native_set)
  write_targets(${folder}) # nothing is built yet, so that all that the processor runs is missing
  file(CONFIGURE OUTPUT ${folder}/native_set.cpp @ONLY CONTENT [[
#include "core/base/target.cpp"
#include <cstdio>
int main() {
  const auto missing = tyndall::missing_targets();
  std::puts(missing.empty() ? "scalar" : tyndall::name_of(missing.back()));
}
]])
  try_run(status compiled ${folder} ${folder}/native_set.cpp
          CMAKE_FLAGS "-DINCLUDE_DIRECTORIES=${PROJECT_SOURCE_DIR}\;${folder}" CXX_STANDARD 20
          COMPILE_OUTPUT_VARIABLE messages RUN_OUTPUT_VARIABLE name)
  unset(status CACHE) # the next configuration may be on another processor
  unset(compiled CACHE)
  string(STRIP "${name}" name)
  if(NOT name IN_LIST all_instruction_sets AND NOT name STREQUAL "scalar")
    message(FATAL_ERROR "the instruction sets of this processor were not found; -DTYNDALL_INSTRUCTION_SETS=all builds "
                        "those of all\n${messages}${name}")
  endif()
  set(${result} ${name} PARENT_SCOPE)
endfunction()

# "native" in a folder that has the best set already, and others, keeps them: they were asked for before.
set(instruction_sets ${TYNDALL_INSTRUCTION_SETS})
if(instruction_sets STREQUAL "all" OR (CMAKE_CROSSCOMPILING AND instruction_sets STREQUAL "native"))
  set(instruction_sets ${all_instruction_sets})
elseif(instruction_sets STREQUAL "native" AND all_instruction_sets)
  find_native_set(instruction_sets)
  if(instruction_sets IN_LIST TYNDALL_BUILT_SETS)
    set(instruction_sets ${TYNDALL_BUILT_SETS})
  endif()
elseif(instruction_sets STREQUAL "native")
  set(instruction_sets "")
endif()
list(REMOVE_ITEM instruction_sets scalar)
foreach(set IN LISTS instruction_sets)
  if(NOT set IN_LIST all_instruction_sets)
    list(JOIN all_instruction_sets ", " expected)
    message(FATAL_ERROR "TYNDALL_INSTRUCTION_SETS: found ${set}, expected native, all, or a list of scalar, ${expected}")
  endif()
endforeach()
set(sorted ${all_instruction_sets}) # the table of targets is in this order
foreach(set IN LISTS all_instruction_sets)
  if(NOT set IN_LIST instruction_sets)
    list(REMOVE_ITEM sorted ${set})
  endif()
endforeach()
set(instruction_sets ${sorted})
set(TYNDALL_BUILT_SETS "${instruction_sets}" CACHE INTERNAL "the sets of the last configuration")

# By what ./run and ./test see that the folder was configured on a processor like this one.
if(EXISTS /proc/cpuinfo)
  file(STRINGS /proc/cpuinfo features REGEX "^(flags|Features)" LIMIT_COUNT 1)
  file(WRITE ${PROJECT_BINARY_DIR}/processor.txt "${features}\n")
endif()

write_targets(${PROJECT_BINARY_DIR}/generated ${instruction_sets})
