// SPDX-License-Identifier: BSD-3-Clause
// A study: one base case, or some cases, and the keys that its tests differ in.
//
//     name = "published"
//     base = "direct-shear.toml"                        # relative to the study
//     [set]                                             # values for all tests, in place of those of the base
//     shear.velocity = "quasi-static"
//     [axes]                                            # every combination is a test
//     rubber_content = [0, 0.1, 0.25]                   # a key by its name, or with its section: gravel.friction
//     normal_stress  = { from = "30 kPa", to = "90 kPa", step = "30 kPa" }
//     [[paired]]                                        # lists of one length that go together: one axis
//     box.length = ["50 mm", "100 mm"]
//     box.width  = ["50 mm", "100 mm"]
//     [[tests]]                                         # one more test, beside the combinations
//     rubber_content = 0.5
//
// In place of `base`, `cases` names a list of case files; the axes, if there are any, are for each of them.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "dem4grm/case_file/case_file.hpp"
#include "dem4grm/core/quantity.hpp"

namespace dem {

/// A key of the case with the value that it has in a test.
struct StudyValue {
  std::string key;               ///< with its section: "shear.normal_stress"
  std::string text;              ///< as a case file has it, always in the same form: "\"60 kPa\""
  std::string column;            ///< name in tables, with its unit: "normal_stress_kPa"
  std::optional<double> number;  ///< in the unit of the column; nothing for text and lists

  friend bool operator==(const StudyValue&, const StudyValue&) = default;
};

struct StudyTest {
  std::string name;                ///< from the case and the values alone, so it stays when tests are added
  std::vector<StudyValue> values;  ///< of the keys that tests differ in, in the order of the study
  LoadedCase loaded;               ///< its `name` is that of the test
};

struct Study {
  std::string name;
  std::string source_text;            ///< the file as it was read
  std::vector<StudyTest> tests;       ///< in the order of the study
  std::vector<std::string> warnings;  ///< legal but unusual, rendered; each once, whatever number of tests it is about
};

/// The most tests that a study may have.
inline constexpr std::size_t k_most_tests = 20'000;

/// Reads a study, its cases and what they name. Throws MissingFileError when a case file is not there, InputError with every
/// problem that the study has, at its line and column, or with those of the first tests that break a rule of the case.
Study load_study(const std::filesystem::path& path);

}  // namespace dem
