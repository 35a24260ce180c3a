# SPDX-License-Identifier: BSD-3-Clause
# Floating-point rules of the whole project, in one place because the bits of every result hang on them.
#
# -ffp-contract=off        a*b+c must round twice on every processor, else a build with fused multiply-add gives other bits.
# -fno-tree-slp-vectorize  g++ 12 contracts a*b-c, a*b+c in neighbouring lanes (vfmsubadd) in spite of the former when it
#                          joins straight code to vectors; its vectors of loops are in order. tools/instructions.py looks.
# no -ffast-math           sums keep the order in which they are written.
# -fno-math-errno, -fno-trapping-math
#                          change no value; they let the compiler use the vector square root and vector selects.
add_library(dem4grm_floating_point INTERFACE)
target_compile_options(dem4grm_floating_point INTERFACE
  -ffp-contract=off -fno-tree-slp-vectorize -fno-math-errno -fno-trapping-math)
# Every x86-64 processor since 2009; the hot loops are compiled for newer ones too (cmake/KernelTargets.cmake).
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|amd64|AMD64")
  target_compile_options(dem4grm_floating_point INTERFACE
    $<$<NOT:$<BOOL:$<TARGET_PROPERTY:DEM4GRM_KERNEL_TARGET>>>:-march=x86-64-v2>)
endif()
if(DEM4GRM_SANITIZE)
  # docs/decisions/0009-sanitizer-checks.md says which checks are left to the address sanitizer.
  target_compile_options(dem4grm_floating_point INTERFACE -fsanitize=${DEM4GRM_SANITIZE} -fno-omit-frame-pointer
    -fno-sanitize=null,alignment,vptr,object-size)
  target_link_options(dem4grm_floating_point INTERFACE -fsanitize=${DEM4GRM_SANITIZE})
endif()
