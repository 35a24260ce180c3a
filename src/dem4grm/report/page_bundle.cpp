// SPDX-License-Identifier: BSD-3-Clause
// The files are taken in by the assembler: as text in a source they would take the compiler a minute.
#include "dem4grm/report/page_bundle.hpp"

#include <fstream>
#include <iterator>

#include <fmt/format.h>

#include "dem4grm/core/error.hpp"

#ifndef DEM_PAGE_SCRIPT
#error \
    "DEM_PAGE_SCRIPT, DEM_PAGE_STYLE and DEM_PUBLISHED_VALUES must name the files to carry (src/dem4grm/CMakeLists.txt)"
#endif

// A file between two names. NOLINTBEGIN(cppcoreguidelines-macro-usage): the assembler needs the name as text.
#define DEM_CARRY(name, path)                 \
  asm(".pushsection .rodata\n"                \
      ".global dem_" #name                    \
      "_begin\n"                              \
      ".global dem_" #name                    \
      "_end\n"                                \
      "dem_" #name                            \
      "_begin:\n"                             \
      ".incbin \"" path                       \
      "\"\n"                                  \
      "dem_" #name                            \
      "_end:\n"                               \
      ".byte 0\n"                             \
      ".popsection\n");                       \
  extern "C" const char dem_##name##_begin[]; \
  extern "C" const char dem_##name##_end[];
// NOLINTEND(cppcoreguidelines-macro-usage)

DEM_CARRY(page_script, DEM_PAGE_SCRIPT)
DEM_CARRY(page_style, DEM_PAGE_STYLE)
DEM_CARRY(published_values, DEM_PUBLISHED_VALUES)

namespace dem {
namespace {

std::string_view between(const char* begin, const char* end) { return {begin, static_cast<std::size_t>(end - begin)}; }

std::string whole_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw MissingFileError(fmt::format("{}: cannot be opened; tools/build_page.sh makes it", path.string()));
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

}  // namespace

PageBundle built_in_page() {
  return {std::string(between(dem_page_script_begin, dem_page_script_end)),
          std::string(between(dem_page_style_begin, dem_page_style_end))};
}

PageBundle page_in(const std::filesystem::path& folder) {
  return {whole_file(folder / "page.js"), whole_file(folder / "page.css")};
}

std::string_view built_in_published_values() { return between(dem_published_values_begin, dem_published_values_end); }

}  // namespace dem
