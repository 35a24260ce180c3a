// SPDX-License-Identifier: BSD-3-Clause
// The bits of a run do not depend on the number of threads, on who looks, or on copying the state.
#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>

#include "dem4grm/engine/observe.hpp"
#include "support/mixture_scene.hpp"

namespace {

using namespace dem;
using namespace dem::test;

constexpr int k_steps = 500, k_large_steps = 200;

/// Enough for several blocks of every stage.
MixtureOptions large_box() {
  MixtureOptions o;
  o.cells = {15, 9, 6};
  o.margin_factor = 3.0;
  return o;
}

/// The smallest change a number can have.
void nudge(double& value) { value = std::nextafter(value, 1e300); }

class ThreadGuard {
 public:
  ThreadGuard() : before_(omp_get_max_threads()) {}
  ~ThreadGuard() { omp_set_num_threads(before_); }
  ThreadGuard(const ThreadGuard&) = delete;
  ThreadGuard& operator=(const ThreadGuard&) = delete;

 private:
  int before_;
};

void expect_same_for_all_thread_counts(const MixtureOptions& o, int steps) {
  const ThreadGuard guard;
  omp_set_num_threads(1);
  const Simulation one = run_mixture(o, steps);
  const std::string expected = one.state_hash();
  const EnergyReport energy = one.energy();
  for (const int threads : {2, 3, 8}) {
    omp_set_num_threads(threads);
    const Simulation many = run_mixture(o, steps);
    EXPECT_EQ(many.state_hash(), expected) << threads << " threads";
    const EnergyReport e = many.energy();
    EXPECT_EQ(e.slip, energy.slip) << threads << " threads";
    EXPECT_EQ(e.dashpot, energy.dashpot);
    EXPECT_EQ(e.local_damping, energy.local_damping);
    EXPECT_EQ(e.boundary_work, energy.boundary_work);
  }
}

TEST(Threads, SceneIsWorthTesting) {
  const Simulation big = run_mixture(large_box(), k_large_steps);
  // More than one block for every stage, else threads would have nothing to share.
  EXPECT_GT(big.clumps.clumps.size(), k_clump_block);
  EXPECT_GT(big.balls.n_blocks, 2);
  EXPECT_GT(big.contacts.n_pair_rows(), 1024U);
  EXPECT_GT(big.wall_block.size(), 2U);
  EXPECT_GT(balance(big).active_contacts, 100);
  const Simulation s = run_mixture({}, k_steps);
  EXPECT_GT(balance(s).active_contacts, 200);
  EXPECT_GT(s.energy().slip, 0.0);
  EXPECT_GT(s.rebuilds, 3);
  double inner = 0.0;  // intra-grain contacts carry shear
  for (std::size_t k = 0; k < s.grain_history.second_neighbour_shear.size(); ++k) {
    inner += std::abs(s.grain_history.second_neighbour_shear[k]);
  }
  EXPECT_GT(inner, 0.0);
  EXPECT_GT(s.reactions[ShearBox::k_top_plate].contacts, 0);
}

TEST(Threads, DefaultModel) { expect_same_for_all_thread_counts(large_box(), k_large_steps); }

TEST(Threads, IncrementalBonds) {
  MixtureOptions o;
  o.form = BondForm::incremental;
  expect_same_for_all_thread_counts(o, k_steps);
}

TEST(Threads, UnloadingRuleOneAndDashpots) {
  for (const int mode : {0, 3}) {  // the others in a small box, below
    MixtureOptions o;
    o.contact = {1, 0.2, 0.1, mode};
    expect_same_for_all_thread_counts(o, k_steps);
  }
}

/// Unloading rules times kinds of dashpots, with a Hertz contact beside each bond: few grains and short, so that the
/// address sanitizer, which leaves out the larger scenes, sees each of these kernels at work.
TEST(Threads, EveryRuleInASmallBox) {
  const ThreadGuard guard;
  MixtureOptions o;
  o.cells = {3, 3, 2};
  for (const int rule : {0, 1}) {
    for (int mode = 0; mode < 4; ++mode) {
      o.contact = {rule, 0.2, 0.1, mode};
      Scene scene = mixture_scene(o);
      scene.bond.hertz_contact = true;
      std::string expected;
      for (const int threads : {1, 2, 3, 8}) {
        omp_set_num_threads(threads);
        Simulation s(scene);
        s.set_time_step(1e-6);
        ShearBox::set_velocities(s.walls, MovingHalf::lower, 0.5, -1.0);
        run_steps(s, 250);
        if (threads == 1) {
          expected = s.state_hash();
          EXPECT_GT(s.energy().dashpot, 0.0) << "rule " << rule << ", dashpots " << mode;
        }
        EXPECT_EQ(s.state_hash(), expected) << threads << " threads, rule " << rule << ", dashpots " << mode;
      }
    }
  }
}

TEST(Observation, ChangesNothing) {
  const MixtureOptions o;
  Simulation watched(mixture_scene(o));
  const BoxSettings box = mixture_box(o);
  watched.set_time_step(1e-6);
  watched.servo = {ShearBox::k_top_plate, 100e3 * box.length * box.width, 0.5, 1.0};
  const std::array everywhere{Bounds{{-1, -1, -1}, {1, 1, 1}}};
  for (int k = 0; k < k_steps; ++k) {
    ShearBox::set_velocities(watched.walls, MovingHalf::lower, 0.5, watched.walls[ShearBox::k_top_plate].velocity.z);
    watched.step();
    if (k % 7 != 0) continue;
    (void)watched.energy();
    (void)watched.state_hash();
    (void)balance(watched);
    (void)worst_overlap(watched);
    (void)find_trouble(watched, everywhere, 10.0);
    (void)rubber_alignment(watched);
    (void)read_bond(watched, 3, 5);
    (void)watched.contact_parameters(0, 60, -1);
    const Simulation copy = watched;  // a copy shares nothing with the original
    EXPECT_EQ(copy.state_hash(), watched.state_hash());
  }
  EXPECT_EQ(watched.state_hash(), run_mixture(o, k_steps).state_hash());
}

TEST(Observation, HashSeesEveryPartOfTheState) {
  MixtureOptions o;
  o.form = BondForm::incremental;
  const Simulation s = run_mixture(o, 300);
  const std::string before = s.state_hash();
  const auto differs = [&](auto&& change) {
    Simulation t = s;
    change(t);
    return t.state_hash() != before;
  };
  const int ball = BallStore::rubber_index(34, 34);  // the last of the last grain, in a block with unused lanes
  for (const BallComponent c : {BallComponent::x, BallComponent::vz, BallComponent::wy, BallComponent::qw}) {
    EXPECT_TRUE(differs([=](Simulation& t) { nudge(t.balls.at(c, ball)); }));
  }
  EXPECT_TRUE(differs([](Simulation& t) { nudge(t.clumps.clumps.back().angular_momentum.y); }));
  EXPECT_TRUE(differs([](Simulation& t) { nudge(t.clumps.clumps.back().orientation.z); }));
  EXPECT_TRUE(differs([](Simulation& t) { nudge(t.clumps.clumps.front().velocity.x); }));
  EXPECT_TRUE(differs([](Simulation& t) { nudge(t.walls[3].corner.x); }));
  EXPECT_TRUE(differs([](Simulation& t) { nudge(t.grain_history.bond[0]); }));
  EXPECT_TRUE(differs([](Simulation& t) { t.grain_history.bond_is_broken[0] = 1; }));
  EXPECT_TRUE(differs([](Simulation& t) { nudge(t.grain_history.second_neighbour_shear[0]); }));
  EXPECT_TRUE(differs([](Simulation& t) {
    for (std::size_t row = 0; row < t.contacts.n_pairs(); ++row) {
      if (t.contacts.state[row].shear.x != 0.0) return nudge(t.contacts.state[row].shear.x);
    }
    FAIL() << "no contact with shear";
  }));
  // Unused lanes of the last block are no part of it.
  EXPECT_FALSE(differs([](Simulation& t) {
    if (k_lanes > 1) nudge(t.balls.at(BallComponent::x, BallStore::rubber_index(35, 0)));
  }));
}

}  // namespace
