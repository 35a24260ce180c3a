# SPDX-License-Identifier: BSD-3-Clause
# The hot loops are compiled once for each level of x86-64, and the program chooses when it starts
# (docs/decisions/0017-processor-targets.md). Everything else is compiled for the lowest level. Other processors, other
# compilers and builds for checking have one target, "plain".
#
#   dem_add_kernels(NAME SOURCES...)   object libraries NAME_v2, NAME_v3, NAME_v4 or NAME_plain, their objects in the
#                                      variable NAME_objects
set(DEM4GRM_KERNEL_TARGETS "auto" CACHE STRING
  "processors that the hot loops are compiled for: auto, or plain for one build with the flags of the rest")
if(DEM4GRM_KERNEL_TARGETS STREQUAL "auto" AND CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|amd64|AMD64" AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU"
   AND CMAKE_BUILD_TYPE MATCHES "Release" AND NOT DEM4GRM_SANITIZE)
  set(dem4grm_kernel_targets v2 v3 v4)
  set(dem4grm_flags_of_v2 -march=x86-64-v2)
  set(dem4grm_flags_of_v3 -march=x86-64-v3)
  set(dem4grm_flags_of_v4 -march=x86-64-v4 -mprefer-vector-width=512)
else()
  set(dem4grm_kernel_targets plain)
endif()

function(dem_add_kernels name)
  set(objects)
  foreach(target IN LISTS dem4grm_kernel_targets)
    add_library(${name}_${target} OBJECT ${ARGN})
    target_compile_definitions(${name}_${target} PRIVATE DEM_TARGET=${target})
    if(dem4grm_flags_of_${target})
      set_target_properties(${name}_${target} PROPERTIES DEM4GRM_KERNEL_TARGET ${target})
      target_compile_options(${name}_${target} PRIVATE ${dem4grm_flags_of_${target}})
    endif()
    target_include_directories(${name}_${target} PRIVATE ${CMAKE_SOURCE_DIR}/src)
    target_link_libraries(${name}_${target} PRIVATE dem4grm_floating_point dem4grm_warnings OpenMP::OpenMP_CXX)
    list(APPEND objects $<TARGET_OBJECTS:${name}_${target}>)
  endforeach()
  set(${name}_objects ${objects} PARENT_SCOPE)
endfunction()
