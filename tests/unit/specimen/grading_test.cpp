// SPDX-License-Identifier: BSD-3-Clause
// Reading grading curves: interpolation, key figures and bad tables.
#include "dem4grm/specimen/grading.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace {

using namespace dem;

const Grading k_curve{{2e-3, 0.0}, {4e-3, 0.2}, {5e-3, 0.2}, {8e-3, 0.8}, {16e-3, 1.0}};

TEST(Grading, SizesAreInterpolatedLinearly) {
  EXPECT_DOUBLE_EQ(size_at_passing(k_curve, 0.1), 3e-3);
  EXPECT_DOUBLE_EQ(size_at_passing(k_curve, 0.5), 6.5e-3);
  EXPECT_DOUBLE_EQ(size_at_passing(k_curve, 0.9), 12e-3);
  EXPECT_DOUBLE_EQ(size_at_passing(k_curve, 0.2), 4e-3);  // smallest size of the flat part
}

TEST(Grading, FractionsOutsideTheTableGiveItsEnds) {
  EXPECT_DOUBLE_EQ(size_at_passing(k_curve, 0.0), 2e-3);
  EXPECT_DOUBLE_EQ(size_at_passing(k_curve, -1.0), 2e-3);
  EXPECT_DOUBLE_EQ(size_at_passing(k_curve, 1.0), 16e-3);
  EXPECT_DOUBLE_EQ(size_at_passing(k_curve, 2.0), 16e-3);
}

TEST(Grading, PassingIsTheInverse) {
  for (const double fraction : {0.05, 0.15, 0.3, 0.55, 0.8, 0.99}) {
    EXPECT_NEAR(passing_at_size(k_curve, size_at_passing(k_curve, fraction)), fraction, 1e-14);
  }
  EXPECT_DOUBLE_EQ(passing_at_size(k_curve, 4.5e-3), 0.2);
  EXPECT_DOUBLE_EQ(passing_at_size(k_curve, 1e-3), 0.0);
  EXPECT_DOUBLE_EQ(passing_at_size(k_curve, 16e-3), 1.0);
  EXPECT_DOUBLE_EQ(passing_at_size(k_curve, 1.0), 1.0);
}

TEST(Grading, KeyFigures) {
  EXPECT_DOUBLE_EQ(d10(k_curve), 3e-3);
  EXPECT_DOUBLE_EQ(d50(k_curve), 6.5e-3);
  EXPECT_DOUBLE_EQ(d60(k_curve), 7e-3);
  EXPECT_DOUBLE_EQ(uniformity_coefficient(k_curve), 7.0 / 3.0);
}

TEST(Grading, SmallestAndLargestSkipEmptyRows) {
  const Grading padded{{1e-3, 0.0}, {2e-3, 0.0}, {4e-3, 1.0}, {8e-3, 1.0}};
  EXPECT_DOUBLE_EQ(smallest_size(padded), 2e-3);
  EXPECT_DOUBLE_EQ(largest_size(padded), 4e-3);
  EXPECT_DOUBLE_EQ(size_at_passing(padded, 0.0), 2e-3);
}

TEST(Grading, GoodTablesHaveNoProblems) { EXPECT_TRUE(grading_problems(k_curve).empty()); }

TEST(Grading, EveryProblemIsListed) {
  EXPECT_EQ(grading_problems({}).size(), 1U);
  EXPECT_EQ(grading_problems({{1e-3, 1.0}}).size(), 1U);
  EXPECT_EQ(grading_problems({{1e-3, 0.1}, {2e-3, 0.9}}).size(), 2U);               // ends
  EXPECT_EQ(grading_problems({{2e-3, 0.0}, {1e-3, 1.0}}).size(), 1U);               // sizes fall
  EXPECT_EQ(grading_problems({{1e-3, 0.0}, {1e-3, 1.0}}).size(), 1U);               // sizes stay
  EXPECT_EQ(grading_problems({{1e-3, 0.0}, {2e-3, 1.0}, {3e-3, 0.5}}).size(), 2U);  // share falls, and ends below 1
  EXPECT_EQ(grading_problems({{-1e-3, 0.0}, {2e-3, 1.0}}).size(), 1U);
  EXPECT_EQ(grading_problems({{1e-3, 0.0}, {2e-3, 1.5}}).size(), 1U);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(grading_problems({{1e-3, 0.0}, {nan, 1.0}}).empty());
  EXPECT_FALSE(grading_problems({{1e-3, nan}, {2e-3, 1.0}}).empty());
}

}  // namespace
