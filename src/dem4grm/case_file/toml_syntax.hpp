// SPDX-License-Identifier: BSD-3-Clause
// Words for people about a line that the TOML parser refused, with what they probably meant.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "dem4grm/case_file/toml_scan.hpp"

namespace dem {

/// What to tell about a refused line, and a line that parses in its place when the line stands on its own.
struct SyntaxAdvice {
  TomlProblem problem;
  std::optional<std::string> harmless_line;
};

/// `line` is the refused line, `place` where the parser stopped, `description` its own words.
SyntaxAdvice advise_on_syntax(std::string_view line, const Place& place, std::string_view description);

}  // namespace dem
