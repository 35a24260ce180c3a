// SPDX-License-Identifier: BSD-3-Clause
// The stand-in for a specimen: all grains, about as many contacts as under load, and nothing moves.
#include <gtest/gtest.h>

#include "dem4grm/engine/observe.hpp"
#include "dem4grm/lab/dense_assembly.hpp"
#include "dem4grm/lab/direct_shear.hpp"
#include "dem4grm/specimen/draw_grains.hpp"

namespace {

using namespace dem;

struct Stand {
  GrainList grains;
  DenseAssembly assembly;
};

Stand stand(double rubber_content) {
  DirectShearCase test;
  test.specimen.rubber_content = rubber_content;
  test.specimen.gravel_grading = {{4.0e-3, 0.0}, {6.0e-3, 1.0}};
  test.specimen.rubber_grading = {{3.65e-3, 0.0}, {3.75e-3, 1.0}};
  test.box.length = test.box.width = 0.040;
  test.box.height = 0.030;
  const SpecimenOrder o = specimen_order(test);
  Stand out;
  out.grains = draw_grains(o.specimen, o.box, o.materials.rubber.density, o.solid_density, o.seed);
  out.assembly = make_dense_assembly(out.grains, o.materials, o.box.length, o.box.width, o.seed);
  return out;
}

TEST(DenseAssembly, HoldsAllGrainsInTheBox) {
  const Stand s = stand(0.4);
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
  const Stand s = stand(1.0);
  Simulation simulation(s.assembly.scene);
  simulation.set_time_step(k_frozen_time_step);
  simulation.step();
  // 90,000 to 105,000 in a full box of 5,769 to 5,872 grains: 16 to 18 a grain.
  const double each = static_cast<double>(balance(simulation).active_contacts) / s.grains.rubber_count;
  EXPECT_GT(each, 12.0);
  EXPECT_LT(each, 24.0);
}

TEST(DenseAssembly, StandsStillWhileItIsStepped) {
  const Stand s = stand(0.4);
  Simulation simulation(s.assembly.scene);
  simulation.set_time_step(k_frozen_time_step);
  const Vec3 rubber = body_position(simulation, 0), clump = simulation.clumps.clumps.front().position;
  for (int k = 0; k < 200; ++k) simulation.step();
  EXPECT_LT(norm(body_position(simulation, 0) - rubber), 1e-12);
  EXPECT_LT(norm(simulation.clumps.clumps.front().position - clump), 1e-12);
  EXPECT_EQ(simulation.rebuilds, 1);
}

}  // namespace
