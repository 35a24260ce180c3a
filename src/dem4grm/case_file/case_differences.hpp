// SPDX-License-Identifier: BSD-3-Clause
// What two complete cases differ in, in words.
#pragma once

#include <string>
#include <vector>

namespace dem {

/// One sentence for each setting that only one of two texts of resolved_toml() has: "made with  seed = 1",
/// "the case has  seed = 2".
std::vector<std::string> case_differences(const std::string& stored, const std::string& wanted);

}  // namespace dem
