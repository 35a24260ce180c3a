// SPDX-License-Identifier: BSD-3-Clause
// The energy ledger closes: what the walls put in is stored or dissipated.
//
// A closed box of rough clumps and rubber grains is squeezed by its lid. Rule 0 of the Mindlin spring is not
// conservative (shear energy grows when the normal force falls), so the balance holds to about a per cent, not to
// rounding; without friction it holds far better, which is tested apart.
#include <gtest/gtest.h>

#include "dem4grm/core/random.hpp"
#include "support/scene_builder.hpp"

namespace {

using namespace dem;
using namespace dem::test;

struct Closing {
  double work = 0.0, stored = 0.0, lost = 0.0;
  int broken_bonds = 0;
  EnergyReport report;
};

/// Squeezes a box of 27 clumps and 8 rubber grains by 2 mm at 0.2 m/s.
/// strength: of the bonds, Pa.
Closing squeeze_box(double friction, double local_damping, int hz_mode, double dashpot, BondForm form,
                    double strength = 3e201) {
  Scene scene = model_scene();
  scene.gravel.friction = scene.rubber.friction = friction;
  scene.integration.local_damping = local_damping;
  scene.contact.hz_mode = hz_mode;
  scene.contact.normal_damping_ratio = dashpot;
  scene.bond.form = form;
  scene.bond.tensile_strength = scene.bond.shear_strength = strength;
  scene.shapes = {*find_clump_template("T1"), *find_clump_template("T5")};
  const double a = 5.5e-3;
  RandomSequence random(21, RandomStream::test, 0);
  for (int z = 0; z < 3; ++z) {
    for (int y = 0; y < 3; ++y) {
      for (int x = 0; x < 3; ++x) {
        const Vec3 at{(x + 0.5) * a, (y + 0.5) * a, (z + 0.5) * a};
        const Quaternion q = random.orientation();
        if ((x + y + z) % 3 == 0) {
          scene.grains.push_back({at, {}});  // square to the box: fits its cell whatever happens
        } else {
          scene.clumps.push_back({(x + y) % 2, 3.9e-3, {at, q}, k_gravel});
        }
      }
    }
  }
  scene.rubber_ball_radius = 0.75e-3;
  scene.wall_list = closed_box({3 * a, 3 * a, 3 * a}, friction);
  Simulation s(scene);
  s.set_time_step(1e-6);
  s.walls[5].velocity = {0, 0, -0.5};
  run_steps(s, 9000);
  s.walls[5].velocity = {};
  run_steps(s, 2000);
  Closing c;
  for (int g = 0; g < s.balls.n_grains; ++g) {
    for (int k = 0; k < k_grain_bonds; ++k) c.broken_bonds += read_bond(s, g, k).is_broken ? 1 : 0;
  }
  c.report = s.energy();
  c.work = c.report.boundary_work;
  c.stored = c.report.kinetic + c.report.contact_strain + c.report.bond_strain;
  c.lost = c.report.slip + c.report.dashpot + c.report.local_damping + c.report.breakage;
  return c;
}

TEST(EnergyLedger, ClosesWithoutFriction) {
  const Closing c = squeeze_box(0.0, 0.0, 0, 0.0, BondForm::history_free);
  EXPECT_GT(c.work, 0.0);
  EXPECT_NEAR((c.stored + c.lost) / c.work, 1.0, 0.002);
  EXPECT_EQ(c.report.slip, 0.0);
  EXPECT_EQ(c.report.local_damping, 0.0);
  EXPECT_GT(c.report.dashpot, 0.0);  // the bonds'
}

TEST(EnergyLedger, ClosesWithFrictionAndEveryKindOfLoss) {
  for (const BondForm form : {BondForm::history_free, BondForm::incremental}) {
    const Closing c = squeeze_box(0.4, 0.2, 0, 0.1, form);
    EXPECT_NEAR((c.stored + c.lost) / c.work, 1.0, 0.01);
    for (const double part : {c.report.slip, c.report.dashpot, c.report.local_damping, c.stored}) {
      EXPECT_GT(part, 0.01 * c.work);
    }
  }
}

TEST(EnergyLedger, ClosesWhileBondsBreak) {
  const Closing c = squeeze_box(0.0, 0.0, 0, 0.1, BondForm::incremental, 0.2e6);
  EXPECT_GT(c.broken_bonds, 100);
  EXPECT_GT(c.report.breakage, 0.05 * c.work) << "without it the balance would be open by this";
  EXPECT_NEAR((c.stored + c.lost) / c.work, 1.0, 0.01);
}

TEST(EnergyLedger, WholeBondsLoseNothing) {
  EXPECT_EQ(squeeze_box(0.4, 0.2, 0, 0.1, BondForm::incremental).report.breakage, 0.0);
}

TEST(EnergyLedger, UnloadingRuleOneLosesAFewPerCentOnly) {
  const Closing c = squeeze_box(0.4, 0.2, 1, 0.0, BondForm::history_free);
  EXPECT_NEAR((c.stored + c.lost) / c.work, 1.0, 0.03);
}

}  // namespace
