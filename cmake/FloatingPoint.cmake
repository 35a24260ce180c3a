# SPDX-License-Identifier: BSD-3-Clause
# Floating-point rules of the whole project, in one place because the bits of every result hang on them.
#
# -ffp-contract=off        a*b+c must round twice on every processor, else a build with fused multiply-add gives other bits.
# -fno-tree-slp-vectorize  g++ 12 contracts a*b-c, a*b+c in neighbouring lanes (vfmsubadd) in spite of the former when it
#                          joins straight code to vectors; its vectors of loops are in order. tools/instructions.py looks.
# no -ffast-math           sums keep the order in which they are written.
# -fno-math-errno, -fno-trapping-math
#                          change no value; they let the compiler use the vector square root and vector selects.
# -mprefer-vector-width=512  full-width vectors for the lane loops over 8 grains or 8 contacts.
add_library(dem4grm_floating_point INTERFACE)
target_compile_options(dem4grm_floating_point INTERFACE
  -ffp-contract=off -fno-tree-slp-vectorize -fno-math-errno -fno-trapping-math)
if(DEM4GRM_NATIVE AND NOT DEM4GRM_SANITIZE)
  target_compile_options(dem4grm_floating_point INTERFACE -march=native)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|amd64|AMD64")
    target_compile_options(dem4grm_floating_point INTERFACE -mprefer-vector-width=512)
  endif()
endif()
if(DEM4GRM_SANITIZE)
  # docs/decisions/0009-sanitizer-checks.md says which checks are left to the address sanitizer.
  target_compile_options(dem4grm_floating_point INTERFACE -fsanitize=${DEM4GRM_SANITIZE} -fno-omit-frame-pointer
    -fno-sanitize=null,alignment,vptr,object-size)
  target_link_options(dem4grm_floating_point INTERFACE -fsanitize=${DEM4GRM_SANITIZE})
endif()
