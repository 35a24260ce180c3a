// SPDX-License-Identifier: BSD-3-Clause
// The case file: TOML with units as text, every problem reported at once with line and column.
//
//     const dem::LoadedCase loaded = dem::load_case("quick.toml", {});
//     const auto& test = std::get<dem::DirectShearCase>(loaded.test);
//
// All keys are declared in one table (case_file/case_schema.cpp). A number with a dimension needs a unit ("60 kPa"), a bare
// number is only for what has none. An error of the file reads
//
//     case.toml:12:12: error: rubber.friction = -0.27 is outside [0, 5]
//        12 | friction = -0.27
//           |            ^^^^^ friction coefficient, no unit (published: 0.27)
//     1 error, nothing was run
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "dem4grm/case_file/case_override.hpp"
#include "dem4grm/lab/case.hpp"

namespace dem {

using TestCase = std::variant<DirectShearCase, GrainCompressionCase>;

/// The name that a case gave itself.
const std::string& case_name(const TestCase& test);

struct LoadedCase {
  TestCase test;
  std::string source_text;            ///< the file as it was read
  std::string resolved_toml;          ///< every key with its final value; reads as the identical case, without files
  std::vector<std::string> warnings;  ///< legal but unusual, in the form of the errors
};

/// Reads a case file and the gradings that it names, relative to its folder. `overrides` replace keys of the file.
/// Throws MissingFileError when the case file is not there, InputError with all problems otherwise.
LoadedCase load_case(const std::filesystem::path& path, std::span<const Override> overrides = {});

/// The same from text; `name` stands for the file in messages, its folder is where gradings are looked for.
LoadedCase parse_case(std::string_view text, const std::filesystem::path& name,
                      std::span<const Override> overrides = {});

/// True when the text is, or means to be, a case of a grain compression; it need not be a valid one.
bool is_grain_compression_text(std::string_view text);

/// The case as a file: every key with its value, its meaning as a comment. Reads as the identical case.
std::string resolved_toml(const TestCase& test);

/// What `dem4grm new` asks for.
struct NewCase {
  std::string test = "direct_shear";     ///< or "grain_compression"
  double rubber_content_percent = 25.0;  ///< VRC, 0 to 100
  std::string normal_stress = "60 kPa";  ///< with unit
};

/// A commented case to begin with, which stands alone: the gradings of the published materials are written into it.
/// Throws InputError for an unknown test or for values that no case may have.
std::string new_case_text(const NewCase& wanted);

/// The tables of all keys for the manual, as Markdown.
std::string key_table_markdown();

}  // namespace dem
