# SPDX-License-Identifier: BSD-3-Clause
# Writes version.hpp; leaves the file untouched when nothing changed, so that nothing is rebuilt.
set(commit "unknown")
execute_process(COMMAND git -C ${SOURCE_DIR} rev-parse --short=12 HEAD
  OUTPUT_VARIABLE commit_read OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
if(NOT failed AND commit_read)
  set(commit ${commit_read})
  execute_process(COMMAND git -C ${SOURCE_DIR} status --porcelain --untracked-files=no
    OUTPUT_VARIABLE changed OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  if(changed)
    string(APPEND commit "-modified")
  endif()
endif()
set(text "// SPDX-License-Identifier: BSD-3-Clause
// Written by the build: what this program calls itself.
#pragma once
namespace dem {
inline constexpr const char* k_version = \"${VERSION}\";
inline constexpr const char* k_commit = \"${commit}\";
inline constexpr const char* k_compiler = \"${COMPILER}\";
inline constexpr const char* k_build_type = \"${BUILD_TYPE}\";
}  // namespace dem
")
set(old "")
if(EXISTS ${OUTPUT})
  file(READ ${OUTPUT} old)
endif()
if(NOT old STREQUAL text)
  file(WRITE ${OUTPUT} "${text}")
endif()
