// SPDX-License-Identifier: BSD-3-Clause
// A simulation that was saved and loaded goes on with the bits of the one that was never interrupted.
//
// The scenes together use every branch of the kernels. Not tested here: files (tests/unit/runs) and the stages of a test
// (tests/lab).
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <omp.h>

#include <tuple>

#include "dem4grm/core/error.hpp"
#include "dem4grm/engine/simulation_state.hpp"
#include "support/mixture_scene.hpp"

namespace {

using namespace dem;
using namespace dem::test;

std::vector<StateEntry> saved(Simulation& s) {
  StateArchive archive;
  exchange(archive, s);
  return archive.entries();
}

/// Everything that a record or a later step could read.
std::string fingerprint(const Simulation& s) {
  const EnergyReport e = s.energy();
  std::string text = s.state_hash();
  for (const double v : {e.kinetic, e.contact_strain, e.bond_strain, e.boundary_work, e.slip, e.dashpot,
                         e.local_damping, s.reactions[ShearBox::k_top_plate].force.z,
                         s.reactions[ShearBox::k_top_plate].stiffness, s.walls[ShearBox::k_top_plate].corner.z}) {
    text += fmt::format(" {:a}", v);
  }
  return text;
}

class SavedState : public ::testing::TestWithParam<std::tuple<int, BondForm>> {
 protected:
  static MixtureOptions options() {
    MixtureOptions o;
    const auto [mode, form] = GetParam();
    o.form = form;
    o.contact.hz_mode = mode;
    o.contact.normal_damping_ratio = 0.1 * mode;
    o.contact.shear_damping_ratio = 0.05 * mode;
    o.contact.dashpot_mode = 3 * mode;
    o.spring_friction = 0.2 * mode;
    return o;
  }
  static void advance(Simulation& s, int steps) {
    for (int k = 0; k < steps; ++k) {
      ShearBox::set_velocities(s.walls, MovingHalf::lower, 0.5, s.walls[ShearBox::k_top_plate].velocity.z);
      s.step();
    }
  }
};

TEST_P(SavedState, GoesOnWithTheSameBits) {
  Simulation straight = run_mixture(options(), 700);
  const std::vector<StateEntry> state = saved(straight);

  Simulation loaded(mixture_scene(options()));
  StateArchive archive(state);
  exchange(archive, loaded);
  EXPECT_EQ(fingerprint(loaded), fingerprint(straight));
  for (int k = 0; k < 5; ++k) {
    advance(straight, 60);
    advance(loaded, 60);
    ASSERT_EQ(fingerprint(loaded), fingerprint(straight)) << "after " << 60 * (k + 1) << " steps";
  }
}

TEST_P(SavedState, GoesOnWithAnotherNumberOfThreads) {
  Simulation straight = run_mixture(options(), 300);
  StateArchive archive(saved(straight));
  advance(straight, 100);
  const int before = omp_get_max_threads();
  omp_set_num_threads(3);
  Simulation loaded(mixture_scene(options()));
  exchange(archive, loaded);
  advance(loaded, 100);
  omp_set_num_threads(before);
  EXPECT_EQ(fingerprint(loaded), fingerprint(straight));
}

TEST_P(SavedState, ReplacesThatOfASimulationWithGrainsOfAnotherSize) {
  Simulation straight = run_mixture(options(), 300);
  Simulation other = straight;
  for (int p = 0; p < other.balls.n_pebbles; ++p) {
    other.balls.set_pebble_radius(p, 0.2 * other.balls.pebble_radius(p));
  }
  other.invalidate_candidates();
  other.step();  // hardly any pairs are near each other now
  StateArchive archive(saved(straight));
  exchange(archive, other);
  advance(straight, 100);
  advance(other, 100);
  EXPECT_EQ(fingerprint(other), fingerprint(straight));
}

INSTANTIATE_TEST_SUITE_P(Branches, SavedState,
                         ::testing::Combine(::testing::Values(0, 1),
                                            ::testing::Values(BondForm::history_free, BondForm::incremental)));

TEST(SavedStateThatDoesNotFit, IsRefused) {
  Simulation s = run_mixture({}, 10);
  const std::vector<StateEntry> state = saved(s);
  {
    MixtureOptions smaller;
    smaller.cells = {6, 5, 4};
    Simulation other(mixture_scene(smaller));
    StateArchive archive(state);
    EXPECT_THROW(exchange(archive, other), IoError);
  }
  for (const std::size_t missing : {std::size_t{0}, state.size() / 2, state.size() - 1}) {
    std::vector<StateEntry> part = state;
    part.erase(part.begin() + static_cast<std::ptrdiff_t>(missing));
    StateArchive archive(part);
    EXPECT_THROW(exchange(archive, s), IoError) << state[missing].name;
  }
}

}  // namespace
