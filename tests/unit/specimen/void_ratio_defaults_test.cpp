// SPDX-License-Identifier: BSD-3-Clause
// Default void ratios against the published tables.
#include "dem4grm/specimen/void_ratio_defaults.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "dem4grm/core/error.hpp"

namespace {

using namespace dem;

TEST(VoidRatioDefaults, LaboratoryTableAndTheLinesBetween) {
  EXPECT_DOUBLE_EQ(laboratory_void_ratio(0.0), 0.63);
  EXPECT_DOUBLE_EQ(laboratory_void_ratio(0.10), 0.65);
  EXPECT_DOUBLE_EQ(laboratory_void_ratio(0.25), 0.70);
  EXPECT_DOUBLE_EQ(laboratory_void_ratio(0.40), 0.74);
  EXPECT_DOUBLE_EQ(laboratory_void_ratio(0.70), 0.875);
  EXPECT_DOUBLE_EQ(laboratory_void_ratio(1.0), 1.01);
  EXPECT_DOUBLE_EQ(laboratory_void_ratio(0.05), 0.64);
}

TEST(VoidRatioDefaults, ExpectedIsLinear) {
  EXPECT_DOUBLE_EQ(expected_void_ratio(0.0), 0.534);
  EXPECT_DOUBLE_EQ(expected_void_ratio(0.5), 0.658);
  EXPECT_DOUBLE_EQ(expected_void_ratio(1.0), 0.782);
}

TEST(VoidRatioDefaults, ContentsOutsideAreRefused) {
  for (const double content : {-0.01, 1.01, 25.0, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THROW(laboratory_void_ratio(content), InputError);
    EXPECT_THROW(expected_void_ratio(content), InputError);
  }
}

}  // namespace
