// SPDX-License-Identifier: BSD-3-Clause
// A value that is no number, put into each kind of state, is seen within a hundred steps, and named.
#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "dem4grm/engine/observe.hpp"
#include "support/mixture_scene.hpp"

namespace dem {
namespace {

using test::MixtureOptions;

TEST(NoNumber, OfAnyStateIsFoundWithinAHundredSteps) {
  MixtureOptions options;
  options.form = BondForm::incremental;
  const Simulation healthy = test::run_mixture(options, 300);
  ASSERT_TRUE(has_only_numbers(healthy));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const int rubber = BallStore::rubber_index(2, 13);
  const std::vector<std::pair<std::string, std::function<void(Simulation&)>>> places{
      {"position of a ball", [=](Simulation& s) { s.balls.at(BallComponent::y, rubber) = nan; }},
      {"velocity of a ball", [=](Simulation& s) { s.balls.at(BallComponent::vx, rubber) = nan; }},
      {"spin of a ball", [=](Simulation& s) { s.balls.at(BallComponent::wz, rubber) = nan; }},
      {"orientation of a ball", [=](Simulation& s) { s.balls.at(BallComponent::qx, rubber) = nan; }},
      {"infinite velocity", [=](Simulation& s) { s.balls.at(BallComponent::vx, rubber) = 1.0 / 0.0; }},
      {"position of a clump", [=](Simulation& s) { s.clumps.clumps[1].position.z = nan; }},
      {"velocity of a clump", [=](Simulation& s) { s.clumps.clumps[1].velocity.z = nan; }},
      {"angular momentum of a clump", [=](Simulation& s) { s.clumps.clumps[1].angular_momentum.x = nan; }},
      {"orientation of a clump", [=](Simulation& s) { s.clumps.clumps[1].orientation.w = nan; }},
      {"place of a wall", [=](Simulation& s) { s.walls[ShearBox::k_top_plate].corner.z = nan; }},
      {"velocity of a wall", [=](Simulation& s) { s.walls[ShearBox::k_top_plate].velocity.z = nan; }},
      {"history of a bond", [=](Simulation& s) { s.grain_history.bond[0] = nan; }},
      {"shear of contacts",
       [=](Simulation& s) {
         for (auto& c : s.contacts.state) c.shear.x = nan;
       }},
      {"load of the plate", [=](Simulation& s) { s.servo.target_force = nan; }},
      {"work of the walls", [=](Simulation& s) { s.ledger.boundary = nan; }}};
  const std::array everywhere{Bounds{{-1, -1, -1}, {1, 1, 1}}};
  for (const auto& [place, spoil] : places) {
    Simulation s = healthy;
    spoil(s);
    int steps = 0;
    while (steps < 100 && has_only_numbers(s)) {
      s.step();
      ++steps;
    }
    EXPECT_FALSE(has_only_numbers(s)) << place;
    const Trouble trouble = find_trouble(s, everywhere, 10.0);
    EXPECT_EQ(trouble.kind, TroubleKind::no_number) << place;
    EXPECT_FALSE(trouble.text.empty()) << place;
  }
}

}  // namespace
}  // namespace dem
