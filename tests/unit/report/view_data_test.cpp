// SPDX-License-Identifier: BSD-3-Clause
// The prediction of the balls of a rubber grain, and which states a view takes. The packed view as a whole is held against
// results.h5 by tests/report/view_test.py.
#include "dem4grm/report/view_data.hpp"
#include "dem4grm/report/grain_prediction.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace dem {
namespace {

TEST(GrainPrediction, FollowsTheLatticeAndNamesEarlierBallsOnly) {
  const GrainPrediction prediction = grain_prediction();
  int from_the_first = 0;
  for (int k = 0; k < k_grain_balls; ++k) {
    const auto [a, b, c] = prediction[static_cast<std::size_t>(k)];
    ASSERT_LT(a, std::max(k, 1));
    if (b < 0) {
      EXPECT_EQ(a, k == 0 ? -1 : 0) << k;
      ++from_the_first;
      continue;
    }
    ASSERT_LT(b, k);
    ASSERT_LT(c, k);
    const Vec3 gap = grain_site(a) + grain_site(b) - grain_site(c) - grain_site(k);
    EXPECT_EQ(dot(gap, gap), 0.0) << k;
  }
  // The first ball, one for each axis, and the first of the centres, which no corners reach.
  EXPECT_EQ(from_the_first, 5);
}

TEST(GrainPrediction, LeavesNothingOfAnEvenDeformation) {
  // x = 1000 + 300 i + 20 j - 40 k of the sites in half lattice constants: whole numbers, turned, squeezed and moved.
  std::vector<std::int32_t> places;
  for (int grain = 0; grain < 2; ++grain) {
    for (int slot = 0; slot < k_grain_balls; ++slot) {
      const Vec3 site = grain_site(slot);
      places.push_back(static_cast<std::int32_t>(1000 + 5000 * grain + 2 * (300 * site.x + 20 * site.y - 40 * site.z)));
    }
  }
  const GrainPrediction prediction = grain_prediction();
  const std::vector<std::int32_t> residuals = prediction_residuals(places, prediction);
  for (std::size_t k = 0; k < residuals.size(); ++k) {
    const auto& row = prediction[k % k_grain_balls];
    if (row[1] < 0) continue;
    EXPECT_EQ(residuals[k], 0) << k;
  }
  EXPECT_EQ(residuals[0], places[0]);
  EXPECT_EQ(residuals[k_grain_balls], 5000);  // from the first ball of the grain before
}

TEST(GrainPrediction, ResidualsGiveThePlacesBack) {
  std::vector<std::int32_t> places;
  for (int k = 0; k < 3 * k_grain_balls; ++k) places.push_back((k * 7919) % 16384);
  const GrainPrediction prediction = grain_prediction();
  const std::vector<std::int32_t> residuals = prediction_residuals(places, prediction);
  std::vector<std::int32_t> back(places.size());
  for (std::size_t k = 0; k < back.size(); ++k) {
    const std::size_t first = k - k % k_grain_balls;
    const auto at = [&](int slot) { return back[first + static_cast<std::size_t>(slot)]; };
    const auto [a, b, c] = prediction[k % k_grain_balls];
    const std::int32_t before = first == 0 ? 0 : back[first - k_grain_balls];
    back[k] = residuals[k] + (a < 0 ? before : b < 0 ? at(0) : at(a) + at(b) - at(c));
  }
  EXPECT_EQ(back, places);
}

TEST(ChosenStates, AreAllOrEvenlySpreadWithBothEnds) {
  EXPECT_EQ(chosen_states(3, 12), (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_EQ(chosen_states(0, 12), (std::vector<std::size_t>{}));
  EXPECT_EQ(chosen_states(1, 12), (std::vector<std::size_t>{0}));
  EXPECT_EQ(chosen_states(100, 2), (std::vector<std::size_t>{0, 99}));
  EXPECT_EQ(chosen_states(11, 3), (std::vector<std::size_t>{0, 5, 10}));
  const std::vector<std::size_t> many = chosen_states(57, 12);
  ASSERT_EQ(many.size(), 12U);
  EXPECT_EQ(many.front(), 0U);
  EXPECT_EQ(many.back(), 56U);
  for (std::size_t k = 1; k < many.size(); ++k)
    EXPECT_NEAR(static_cast<double>(many[k] - many[k - 1]), 56.0 / 11.0, 1.0);
}

}  // namespace
}  // namespace dem
