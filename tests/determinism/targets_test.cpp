// SPDX-License-Identifier: BSD-3-Clause
// The bits do not depend on the kind of processor for which the hot loops were compiled.
//
// Every target that this processor can run is tried. Not tested: targets that it cannot run, and how the program chooses
// (tests/lab/command_line_test.cpp).
#include <gtest/gtest.h>

#include <string>

#include "dem4grm/core/error.hpp"
#include "dem4grm/engine/kernel_target.hpp"
#include "support/mixture_scene.hpp"

namespace {

using namespace dem;

/// Puts the target back that was in force.
class KernelTarget : public ::testing::Test {
 protected:
  ~KernelTarget() override { choose_kernel_target(before_); }

 private:
  std::string before_{kernel_target()};
};

TEST_F(KernelTarget, EveryTargetGivesTheSameBits) {
  const std::vector<std::string_view> targets = usable_kernel_targets();
  ASSERT_FALSE(targets.empty());
  choose_kernel_target(targets.front());
  const std::string expected = test::all_mixture_hashes(400);
  for (const std::string_view name : targets) {
    choose_kernel_target(name);
    EXPECT_EQ(kernel_target(), name);
    EXPECT_EQ(test::all_mixture_hashes(400), expected) << name;
  }
}

TEST_F(KernelTarget, TheBestOneIsInForceAtTheStart) { EXPECT_EQ(kernel_target(), usable_kernel_targets().front()); }

TEST_F(KernelTarget, AnUnknownOneIsRefusedWithTheNamesToChooseFrom) {
  try {
    choose_kernel_target("v9");
    FAIL() << "no error";
  } catch (const InputError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("'v9'"), std::string::npos);
    for (const std::string_view name : usable_kernel_targets()) EXPECT_NE(text.find(name), std::string::npos);
  }
  EXPECT_EQ(kernel_target(), usable_kernel_targets().front());
}

}  // namespace
