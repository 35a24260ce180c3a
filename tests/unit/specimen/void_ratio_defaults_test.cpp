// SPDX-License-Identifier: BSD-3-Clause
// Default void ratios against the published tables.
#include "dem4grm/specimen/void_ratio_defaults.hpp"

#include <gtest/gtest.h>

#include <array>
#include <limits>

#include "dem4grm/core/error.hpp"

namespace {

using namespace dem;

TEST(VoidRatioDefaults, LaboratoryTableAndTheLinesBetween) {
  for (const auto& [content, loosest, densest] :
       {std::array{0.0, 0.725, 0.545}, std::array{0.10, 0.778, 0.561}, std::array{0.25, 0.818, 0.577},
        std::array{0.40, 0.912, 0.590}, std::array{1.0, 1.272, 0.787}}) {
    EXPECT_DOUBLE_EQ(laboratory_void_ratio(content, 0.0), loosest);
    EXPECT_DOUBLE_EQ(laboratory_void_ratio(content, 1.0), densest);
  }
  EXPECT_DOUBLE_EQ(laboratory_void_ratio(0.0, 0.5), 0.635);
  EXPECT_DOUBLE_EQ(laboratory_void_ratio(1.0, 0.2), 1.175);
  EXPECT_DOUBLE_EQ(laboratory_void_ratio(0.70, 0.0), 1.092);
  EXPECT_DOUBLE_EQ(laboratory_void_ratio(0.05, 1.0), 0.553);
  EXPECT_DOUBLE_EQ(laboratory_void_ratio(0.0, -0.5), 0.815);  // looser than the laboratory's loosest
}

TEST(VoidRatioDefaults, FillTakesTheCasesOwnNumberFirst) {
  SpecimenSettings settings;
  settings.rubber_content = 0.4;
  settings.generation_relative_density = 0.5;
  EXPECT_DOUBLE_EQ(generation_void_ratio(settings), 0.751);
  settings.generation_void_ratio = 0.9;
  EXPECT_DOUBLE_EQ(generation_void_ratio(settings), 0.9);
}

TEST(VoidRatioDefaults, ExpectedIsLinear) {
  EXPECT_DOUBLE_EQ(expected_void_ratio(0.0), 0.534);
  EXPECT_DOUBLE_EQ(expected_void_ratio(0.5), 0.658);
  EXPECT_DOUBLE_EQ(expected_void_ratio(1.0), 0.782);
}

TEST(VoidRatioDefaults, ContentsOutsideAreRefused) {
  for (const double content : {-0.01, 1.01, 25.0, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THROW(laboratory_void_ratio(content, 0.5), InputError);
    EXPECT_THROW(expected_void_ratio(content), InputError);
  }
}

}  // namespace
