# SPDX-License-Identifier: BSD-3-Clause
# Joined compilation: sources of one folder are compiled some at a time, as one translation unit, so that what they include
# is read once. From scratch it takes less than half the processor time; after a change of one source more than that one is
# compiled again. Hence off by default, and on in test.sh and run.sh (docs/decisions/0020-build-and-test-time.md).
option(DEM4GRM_UNITY "compile several sources of a folder at a time: faster from scratch" OFF)

# Never joined: the kernels, whose code depends on flags of their own, and the verification cases, which call different
# things by the same short names; these begin with a header that is read once (src/dem4grm/CMakeLists.txt).
set(DEM4GRM_NEVER_JOINED "/engine/(.*_kernel|grain_bonds|second_neighbours|kernels/.*)\\.cpp$|/verify/")

# Joins the sources of a target, at most `most` at a time. Within one folder, names in unnamed namespaces must differ.
function(dem4grm_join target most)
  if(NOT DEM4GRM_UNITY)
    return()
  endif()
  get_target_property(sources ${target} SOURCES)
  list(FILTER sources EXCLUDE REGEX "${DEM4GRM_NEVER_JOINED}")
  foreach(source IN LISTS sources)
    cmake_path(GET source PARENT_PATH folder)
    cmake_path(GET folder FILENAME folder)
    math(EXPR batch "0${n_of_${folder}} / ${most}")
    math(EXPR n_of_${folder} "0${n_of_${folder}} + 1")
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${folder}_${batch})
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
endfunction()
