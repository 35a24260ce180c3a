// SPDX-License-Identifier: BSD-3-Clause
// The stand-in for a specimen: all grains, about as many contacts as under load, and nothing moves.
#include <gtest/gtest.h>

#include "dem4grm/engine/observe.hpp"
#include "support/mixture_case.hpp"

namespace {

using namespace dem;

using dem::test::mixture_stand, dem::test::MixtureStand;

TEST(DenseAssembly, HoldsAllGrainsInTheBox) {
  const MixtureStand s = mixture_stand(0.4);
  EXPECT_EQ(s.assembly.scene.clumps.size(), s.grains.gravel.size());
  EXPECT_EQ(s.assembly.scene.grains.size(), static_cast<std::size_t>(s.grains.rubber_count));
  for (const Pose& p : s.assembly.scene.grains) {
    EXPECT_GT(p.position.x, 0.0);
    EXPECT_LT(p.position.x, 0.040);
    EXPECT_GT(p.position.z, 0.0);
    EXPECT_LT(p.position.z, s.assembly.height);
  }
  EXPECT_EQ(s.assembly.scene.clumps.back().size, s.grains.gravel.back().sieve_size);
}

TEST(DenseAssembly, RubberHasAboutAsManyContactsAsUnderLoad) {
  const MixtureStand s = mixture_stand(1.0);
  Simulation simulation(s.assembly.scene);
  simulation.set_time_step(k_frozen_time_step);
  simulation.step();
  // 90,000 to 105,000 in a full box of 5,769 to 5,872 grains: 16 to 18 a grain.
  const double each = static_cast<double>(balance(simulation).active_contacts) / s.grains.rubber_count;
  EXPECT_GT(each, 12.0);
  EXPECT_LT(each, 24.0);
}

TEST(DenseAssembly, StandsStillWhileItIsStepped) {
  const MixtureStand s = mixture_stand(0.4);
  Simulation simulation(s.assembly.scene);
  simulation.set_time_step(k_frozen_time_step);
  const Vec3 rubber = body_position(simulation, 0), clump = simulation.clumps.clumps.front().position;
  for (int k = 0; k < 200; ++k) simulation.step();
  EXPECT_LT(norm(body_position(simulation, 0) - rubber), 1e-12);
  EXPECT_LT(norm(simulation.clumps.clumps.front().position - clump), 1e-12);
  EXPECT_EQ(simulation.rebuilds, 1);
}

}  // namespace
