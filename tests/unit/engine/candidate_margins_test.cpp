// SPDX-License-Identifier: BSD-3-Clause
// Margins of the candidate list: wide for fast grains only, and a list lasts as long as nobody leaves his.
#include <gtest/gtest.h>

#include <algorithm>

#include "dem4grm/engine/simulation.hpp"
#include "support/scene_builder.hpp"

namespace {

using namespace dem;
using namespace dem::test;

constexpr double k_radius = 2e-3;

/// Five blocks of spheres in a row, 6 mm from centre to centre: nothing touches.
Simulation row_of_spheres() {
  Scene scene = model_scene();
  for (std::size_t k = 0; k < 5 * k_clump_block; ++k)
    add_sphere(scene, {6e-3 * static_cast<double>(k), 0, 0}, k_radius);
  Simulation s(scene);
  s.set_time_step(1e-6);
  return s;
}

void push(Simulation& s, std::size_t clump, double speed) { s.clumps.clumps[clump].velocity = {0, speed, 0}; }

TEST(CandidateMargins, AFastGrainWidensItsOwnBlockOnly) {
  Simulation s = row_of_spheres();
  push(s, k_clump_block, 2.0);
  s.step();
  s.margins.horizon = 100;
  s.invalidate_candidates();
  s.margins.tunes = false;
  refresh_candidates(s);
  const CandidateMargins& m = s.margins;
  ASSERT_EQ(m.margin.size(), 5U);
  // Mean of the five blocks: a fifth of the fast one.
  EXPECT_NEAR(m.margin[0], m.least + 2.0 / 5 * 1e-6 * 100, 1e-9);
  EXPECT_NEAR(m.margin[1], m.least + 2.0 * 6 / 5 * 1e-6 * 100, 1e-9);
  EXPECT_EQ(m.margin[2], m.margin[0]);
}

TEST(CandidateMargins, NoMarginIsWiderThanTheLargest) {
  Simulation s = row_of_spheres();
  push(s, 0, 1e3);
  s.step();
  s.margins.horizon = 1e4;
  s.invalidate_candidates();
  s.margins.tunes = false;
  refresh_candidates(s);
  EXPECT_EQ(s.margins.largest, 2.0 * k_radius);
  EXPECT_EQ(*std::max_element(s.margins.margin.begin(), s.margins.margin.end()), s.margins.largest);
}

TEST(CandidateMargins, NothingMovesNothingIsSearched) {
  Simulation s = row_of_spheres();
  for (int k = 0; k < 500; ++k) s.step();
  EXPECT_EQ(s.rebuilds, 1);
}

TEST(CandidateMargins, AListIsGivenUpWhenItsMarginIsUsed) {
  Simulation s = row_of_spheres();
  s.margins.tunes = false;
  push(s, 0, 1.0);
  s.step();
  s.invalidate_candidates();
  s.step();
  const std::int64_t before = s.rebuilds;
  const double margin = s.margins.margin[0];
  const int lasts = static_cast<int>(0.65 * margin / 1e-6), is_over = static_cast<int>(1.05 * margin / 1e-6);
  for (int k = 0; k < lasts; ++k) s.step();
  EXPECT_EQ(s.rebuilds, before);
  for (int k = lasts; k < is_over; ++k) s.step();
  EXPECT_EQ(s.rebuilds, before + 1);
}

TEST(NearPairs, AreSearchedAnewWhenABlockHasUsedItsReserve) {
  Simulation s = row_of_spheres();
  s.margins.tunes = false;
  s.near.reserve = 5.0;
  push(s, 0, 1.0);
  s.step();
  s.invalidate_candidates();
  s.step();
  ASSERT_EQ(s.near.margin[0], 5.0 * s.margins.margin[0]);
  const std::int64_t before = s.near.searches;
  // The next list needs its own margin free of the five: four may be used up.
  const double reach = 4.0 * s.margins.margin[0];
  while (s.clumps.clumps[0].position.y - s.near.found_at[1][0] < 0.7 * reach) s.step();
  EXPECT_EQ(s.near.searches, before);
  EXPECT_GE(s.rebuilds, 4);
  const double found = s.near.found_at[1][0];
  while (s.clumps.clumps[0].position.y - found < 1.3 * reach) s.step();
  EXPECT_EQ(s.near.searches, before + 1);
}

TEST(NearPairs, MovingWallsUseThemUpToo) {
  Simulation s = row_of_spheres();
  s.walls.push_back(make_wall("far", {-1, 0.5, -1}, {0, 0, 2}, {2, 0, 0}));
  s.reactions.resize(1);
  s.last_wall_velocity.resize(1);
  s.margins.tunes = false;
  s.walls[0].velocity = {0, 1, 0};
  s.step();
  const std::int64_t before = s.near.searches, lists = s.rebuilds;
  const double reach = s.near.wall_margin - s.margins.wall_margin, start = s.walls[0].corner.y;
  while (s.walls[0].corner.y - start < 0.8 * reach) s.step();
  EXPECT_EQ(s.near.searches, before);
  EXPECT_GT(s.rebuilds, lists + 3);
  // A list lasts for one margin, so there is one in the next margin of the path.
  while (s.walls[0].corner.y - start < reach + s.margins.wall_margin + 3e-6) s.step();
  EXPECT_EQ(s.near.searches, before + 1);
}

TEST(CandidateMargins, TheHorizonFollowsWhatPays) {
  // Grains that only fly apart list nobody: searches are all that costs, so lists are made for longer and longer.
  Simulation s = row_of_spheres();
  for (std::size_t k = 0; k < s.clumps.clumps.size(); ++k) push(s, k, 1.0);
  const double first = s.margins.horizon;
  for (int k = 0; k < 2000; ++k) s.step();
  EXPECT_GT(s.margins.horizon, 2.0 * first);
}

}  // namespace
