// SPDX-License-Identifier: BSD-3-Clause
// What two complete cases differ in, in words.
#pragma once

#include <string>
#include <vector>

#include "dem4grm/lab/case.hpp"

namespace dem {

/// A key of which two cases have other values; "not set" for an optional key without one.
struct KeyChange {
  std::string key;  ///< "shear.normal_stress"
  std::string before, after;
};

/// In the order of the keys of a case. Long values, such as gradings, are shortened.
std::vector<KeyChange> case_changes(DirectShearCase before, DirectShearCase after);

/// One sentence for each setting that only one of two texts of resolved_toml() has: "made with  seed = 1",
/// "the case has  seed = 2".
std::vector<std::string> case_differences(const std::string& stored, const std::string& wanted);

}  // namespace dem
