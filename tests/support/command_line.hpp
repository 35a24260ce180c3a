// SPDX-License-Identifier: BSD-3-Clause
// A folder with a tiny case, in which the program runs as a user would run it.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "dem4grm/results/json_text.hpp"
#include "support/run_program.hpp"

namespace dem::test {

/// 137 clumps and 23 rubber grains, sheared in about a second.
inline constexpr const char* k_tiny_case = R"(name = "tiny"
seed = 3
[specimen]
rubber_content = 0.2
preparation_friction = 0.3
generation_void_ratio = 0.85
gravel_grading = [["3.6 mm", 0.0], ["4.0 mm", 1.0]]
rubber_grading = [["3.6 mm", 0.0], ["3.8 mm", 1.0]]
[box]
length = "21 mm"
width  = "21 mm"
height = "21 mm"
upper_height = "40 mm"
[equilibrium]
force_ratio = 0.02
plate_speed = "5 mm/s"
stress_tolerance = 0.05
hold_steps = 200
[shear]
normal_stress = "100 kPa"
velocity      = "200 mm/s"
displacement  = "1 mm"
[recording]
frame_interval = "0.5 mm"
)";

class CommandLine : public ::testing::Test {
 protected:
  CommandLine() { write_all(folder_ / "tiny.toml", k_tiny_case); }

  [[nodiscard]] static std::vector<std::string> words(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), DEM_PROGRAM);
    return arguments;
  }
  [[nodiscard]] ProgramResult run(std::vector<std::string> arguments) const {
    return run_program(words(std::move(arguments)), folder_.path());
  }
  /// Runs, expects the code and that stderr says the text.
  ProgramResult expect(int code, const std::string& text, std::vector<std::string> arguments) const {
    ProgramResult result = run(std::move(arguments));
    EXPECT_EQ(result.exit_code, code) << result.err;
    EXPECT_NE(result.err.find(text), std::string::npos) << result.err;
    return result;
  }
  [[nodiscard]] JsonObject json(const std::string& name) const { return read_json_file(folder_ / name); }

  TemporaryFolder folder_;
};

}  // namespace dem::test
