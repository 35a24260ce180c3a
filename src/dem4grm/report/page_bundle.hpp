// SPDX-License-Identifier: BSD-3-Clause
// The program and the style of the page, made from web/ before the library is built (tools/build_page.sh), and other files that
// the library carries inside it.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace dem {

struct PageBundle {
  std::string script, style;

  [[nodiscard]] bool is_there() const { return !script.empty(); }
};

/// What this build carries; empty when node and npm were not there when it was built.
PageBundle built_in_page();

/// page.js and page.css of a folder. Throws MissingFileError when one is not there.
PageBundle page_in(const std::filesystem::path& folder);

/// cases/paper/published.csv.
std::string_view built_in_published_values();

}  // namespace dem
