# SPDX-License-Identifier: BSD-3-Clause
# One list of warnings for library, command line, tests and benchmarks.
add_library(dem4grm_warnings INTERFACE)
target_compile_options(dem4grm_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual -Wold-style-cast -Wcast-align
  -Wunused -Wdouble-promotion -Wformat=2 -Wmissing-declarations)
# g++ 12 at -O3 sees overlapping copies inside std::string that cannot happen (its bug 105651).
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  target_compile_options(dem4grm_warnings INTERFACE -Wno-restrict)
endif()
# Registers by value (core/registers.hpp) would be passed in another way on other processors; all such functions are
# always inlined, so nothing is passed.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  target_compile_options(dem4grm_warnings INTERFACE -Wno-psabi)
endif()
if(DEM4GRM_WERROR)
  target_compile_options(dem4grm_warnings INTERFACE -Werror)
endif()
