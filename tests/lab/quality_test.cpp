// SPDX-License-Identifier: BSD-3-Clause
// A test that was not what it was meant to be says so in its warnings, and a good one says nothing.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "dem4grm/lab/direct_shear.hpp"
#include "support/tiny_shear_case.hpp"

namespace dem {
namespace {

struct WarningListener : LabObserver {
  std::vector<std::string> texts;
  void warning(const std::string& text) override { texts.push_back(text); }
  [[nodiscard]] bool has(const std::string& part) const {
    return std::any_of(texts.begin(), texts.end(), [&](const auto& t) { return t.find(part) != std::string::npos; });
  }
};

constexpr const char* k_servo = "the plate did not hold its stress";
constexpr const char* k_speed = "the inertial number reached";

DirectShearCase good_case() {
  DirectShearCase test = test::tiny_shear_case(0.3, 0.025, 0.024);
  test.shear.velocity = 0.02;
  test.shear.displacement = 0.3e-3;
  return test;
}

TEST(Quality, AGoodTestSaysNothing) {
  WarningListener heard;
  (void)run_direct_shear(good_case(), heard);
  EXPECT_FALSE(heard.has(k_servo));
  EXPECT_FALSE(heard.has(k_speed));
}

TEST(Quality, APlateThatDoesNotFollowIsTold) {
  DirectShearCase test = good_case();
  test.shear.velocity = 1.0;  // m/s: the plate is as slow as grains let it
  test.shear.displacement = 1.5e-3;
  WarningListener heard;
  const DirectShearResult r = run_direct_shear(test, heard);
  EXPECT_GT(r.normal_stress_max_error, 0.10);
  EXPECT_TRUE(heard.has(k_servo));
  EXPECT_TRUE(heard.has("where 60 kPa were asked for"));
}

TEST(Quality, ATestThatIsNotQuasiStaticIsTold) {
  DirectShearCase test = good_case();
  test.shear.velocity = 0.3;
  WarningListener heard;
  (void)run_direct_shear(test, heard);
  EXPECT_TRUE(heard.has(k_speed));
}

}  // namespace
}  // namespace dem
