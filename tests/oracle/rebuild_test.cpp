// SPDX-License-Identifier: BSD-3-Clause
// The candidate list is a means to speed only: its margins and the moments of its renewal leave no trace in the bits.
#include <gtest/gtest.h>

#include <algorithm>

#include "support/mixture_scene.hpp"

namespace {

using namespace dem;
using namespace dem::test;

constexpr int k_steps = 500;

TEST(Rebuild, MarginsDoNotMatter) {
  for (const BondForm form : {BondForm::history_free, BondForm::incremental}) {
    MixtureOptions o;
    o.form = form;
    const Simulation reference = run_mixture(o, k_steps);
    for (const double factor : {0.5, 3.0}) {
      o.margin_factor = factor;
      const Simulation other = run_mixture(o, k_steps);
      EXPECT_NE(other.rebuilds, reference.rebuilds);  // the list was really kept for another time
      EXPECT_EQ(other.state_hash(), reference.state_hash()) << "margins times " << factor;
    }
  }
}

TEST(Rebuild, MomentDoesNotMatter) {
  MixtureOptions o;
  o.contact = {1, 0.1, 0.1, 0};
  const std::string expected = run_mixture(o, k_steps).state_hash();
  for (const int every : {1, 7, 100}) {
    o.rebuild_every = every;
    EXPECT_EQ(run_mixture(o, k_steps).state_hash(), expected) << "every " << every << " steps";
  }
}

TEST(Rebuild, PickedListsAreThoseOfASearch) {
  // Works are summed over blocks of the list: their bits agree only when every list had the same rows.
  MixtureOptions o;
  o.contact = {1, 0.1, 0.1, 0};
  o.tunes = false;
  o.margin_factor = 0.1;  // grains are fast here: the margins of 50 steps would leave no room for wider ones
  o.reserve = 1.0;        // a search for every list
  const Simulation reference = run_mixture(o, k_steps);
  ASSERT_EQ(reference.near.searches, reference.rebuilds);
  for (const double reserve : {3.0, 30.0}) {
    o.reserve = reserve;
    const Simulation other = run_mixture(o, k_steps);
    EXPECT_LT(3 * other.near.searches, 2 * other.rebuilds) << reserve;
    EXPECT_EQ(other.rebuilds, reference.rebuilds) << reserve;
    EXPECT_EQ(other.contacts.pairs, reference.contacts.pairs) << reserve;
    EXPECT_EQ(other.contacts.wall_pairs, reference.contacts.wall_pairs) << reserve;
    EXPECT_EQ(other.state_hash(), reference.state_hash()) << reserve;
    EXPECT_EQ(other.energy().slip, reference.energy().slip) << reserve;
    EXPECT_EQ(other.energy().dashpot, reference.energy().dashpot) << reserve;
  }
}

TEST(Rebuild, NoContactIsEverMissed) {
  // After every step, every pair that overlaps has been a candidate: brute force over all balls.
  MixtureOptions o;
  o.margin_factor = 0.3;
  Simulation s(mixture_scene(o));
  const BoxSettings box = mixture_box(o);
  s.margins.least *= o.margin_factor;
  s.margins.horizon *= o.margin_factor;
  s.set_time_step(1e-6);
  s.servo = {ShearBox::k_top_plate, 100e3 * box.length * box.width, 0.5, 1.0};
  const int n = s.balls.n_balls();
  for (int k = 0; k < 400; ++k) {
    ShearBox::set_velocities(s.walls, MovingHalf::lower, 0.5, s.walls[ShearBox::k_top_plate].velocity.z);
    refresh_candidates(s);
    if (k % 40 == 39) {
      for (int i = 0; i < n; ++i) {
        const int a = s.balls.index_of_id(i);
        const Vec3 at = s.balls.position(a);
        const double r = s.balls.radius_of_id(i);
        for (int j = i + 1; j < n; ++j) {
          if (s.body_of_ball(i) == s.body_of_ball(j)) continue;
          const int b = s.balls.index_of_id(j);
          if (norm(s.balls.position(b) - at) < r + s.balls.radius_of_id(j)) {
            ASSERT_TRUE(std::count(s.contacts.pairs.begin(), s.contacts.pairs.end(), pair_key(i, j)) == 1);
          }
        }
        for (std::size_t w = 0; w < s.walls.size(); ++w) {
          if (look_at(s.walls[w], at).distance < r && look_at(s.walls[w], at).distance > -r) {
            ASSERT_GE(wall_row(s, i, static_cast<int>(w)), 0) << "ball " << i << " wall " << w;
          }
        }
      }
    }
    s.step();
  }
}

}  // namespace
