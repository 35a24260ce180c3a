// SPDX-License-Identifier: BSD-3-Clause
// The bits do not depend on how many grains lie side by side in a vector register.
//
// CMakeLists.txt of this folder builds the engine again with 1 and 4 lanes; each of those programs prints the hashes of
// the same four runs, and so does one for 64-bit Arm in an emulator. Not tested: Arm with wide vectors (SVE), and real
// processors of that kind.
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <sstream>
#include <string>

#include "support/mixture_scene.hpp"

namespace {

#ifdef DEM_LANE_PROGRAMS

std::string output_of(const std::string& program) {
  std::string text;
  FILE* pipe = popen(program.c_str(), "r");
  if (pipe == nullptr) return text;
  std::array<char, 256> line{};
  while (std::fgets(line.data(), static_cast<int>(line.size()), pipe) != nullptr) text += line.data();
  return pclose(pipe) == 0 ? text : std::string();
}

TEST(Lanes, ScalarAndNarrowBuildsGiveTheSameBits) {
  const std::string expected = dem::test::all_mixture_hashes(400);
  ASSERT_EQ(expected.size(), 4U * 33U);
  std::istringstream programs(DEM_LANE_PROGRAMS);
  int compared = 0;
  for (std::string program; std::getline(programs, program, ','); ++compared) {
    EXPECT_EQ(output_of(program), expected) << program;
  }
  EXPECT_EQ(compared, 2);
}

#else

TEST(Lanes, ScalarAndNarrowBuildsGiveTheSameBits) { GTEST_SKIP() << "built without the programs of the other widths"; }

#endif

#ifdef DEM_ARM_PROGRAM

TEST(Lanes, ABuildFor64BitArmGivesTheSameBits) {
  EXPECT_EQ(output_of(DEM_ARM_PROGRAM), dem::test::all_mixture_hashes(dem::test::k_few_steps));
}

#else

// Who builds by hand need not have a cross-compiler; test.sh installs it, so there the test above runs. Sanitizer builds
// leave out all programs of other widths.
TEST(Lanes, ABuildFor64BitArmGivesTheSameBits) { GTEST_SKIP() << "no cross-compiler or no emulator"; }

#endif

}  // namespace
