# SPDX-License-Identifier: BSD-3-Clause
# The commit that a result names is read at every build, so that a rebuilt program never names an older one.
set(DEM4GRM_VERSION_HEADER ${CMAKE_BINARY_DIR}/generated/dem4grm/version.hpp)
add_custom_target(dem4grm_version
  COMMAND ${CMAKE_COMMAND} -DSOURCE_DIR=${CMAKE_SOURCE_DIR} -DOUTPUT=${DEM4GRM_VERSION_HEADER}
          -DVERSION=${PROJECT_VERSION} "-DCOMPILER=${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION}"
          -DBUILD_TYPE=${CMAKE_BUILD_TYPE}
          -P ${CMAKE_SOURCE_DIR}/cmake/WriteVersion.cmake
  BYPRODUCTS ${DEM4GRM_VERSION_HEADER}
  COMMENT "reading the commit")
