// SPDX-License-Identifier: BSD-3-Clause
// What a case may ask for between bonded balls beside the bond: the force of one ball of a grain that is pressed and
// slid against its partner, with the option less without it, against the closed form.
#include <gtest/gtest.h>

#include <cmath>

#include "dem4grm/core/error.hpp"
#include "dem4grm/verify/grain_statics.hpp"
#include "support/scene_builder.hpp"

namespace {

using namespace dem;
using namespace dem::test;

constexpr double k_radius = 0.65e-3;

/// Force on the vertex ball (slot 0), which has one bond, when it is moved by d (m) in one step from rest: of the scene
/// with its options, less that of the same scene without.
Vec3 companion_force(const Scene& with, const Vec3& d) {
  Scene without = with;
  without.bond.spring_friction = 0.0;
  without.bond.hertz_contact = false;
  Eigen::VectorXd u = Eigen::VectorXd::Zero(k_grain_dofs);
  u.segment<3>(0) = eigen_vector(d);
  const Eigen::VectorXd difference = engine_loads(with, u) - engine_loads(without, u);
  return {difference[0], difference[1], difference[2]};
}

/// Unit vector from ball 0 to its partner, and one across.
const Vec3 k_along = Vec3{1, 1, 1} * (1.0 / std::sqrt(3.0));
const Vec3 k_across = Vec3{1, -1, 0} * (1.0 / std::sqrt(2.0));

/// The same split along and across the line of the two centres; across, the way is longer by rest length over length,
/// since the step begins at the rest length.
struct Parts {
  double along = 0.0, across = 0.0, way = 0.0;
};

Parts companion_parts(const Scene& with, double overlap, double slide) {
  const Vec3 d = k_along * overlap + k_across * slide, branch = k_along * (2.0 * k_radius) - d;
  const Vec3 n = branch * (1.0 / norm(branch)), f = companion_force(with, d);
  return {dot(f, n), norm(perpendicular(f, n)), slide * 2.0 * k_radius / norm(branch)};
}

class BondCompanion : public ::testing::TestWithParam<BondForm> {
 protected:
  static Scene scene() {
    Scene s = lone_grain(k_radius);
    s.bond.form = GetParam();
    return s;
  }
};

TEST_P(BondCompanion, HertzContactPushesAndSlides) {
  // Rubber on rubber, G 12 MPa, nu 0.5: E* = 24 MPa, R* = r/2; k_s/k_n = 2/3.
  Scene s = scene();
  s.bond.hertz_contact = true;
  const double overlap = 20e-6, slide = 1e-6;
  const double h = 4.0 / 3.0 * 24e6 * std::sqrt(0.5 * k_radius), normal = h * std::pow(overlap, 1.5);
  const Parts pressed = companion_parts(s, overlap, 0.0);
  EXPECT_NEAR(pressed.along / normal, -1.0, 1e-6);
  EXPECT_NEAR(pressed.across / normal, 0.0, 1e-6);
  const Parts slid = companion_parts(s, overlap, slide);
  EXPECT_NEAR(slid.across / (1.5 * h * std::sqrt(overlap) * 2.0 / 3.0 * slid.way), 1.0, 1e-3);
  EXPECT_LT(dot(companion_force(s, k_along * overlap + k_across * slide), k_across), 0.0) << "against the motion";
  s.rubber.friction = 0.01;
  const Parts slipping = companion_parts(s, overlap, slide);
  EXPECT_NEAR(slipping.across / (0.01 * normal), 1.0, 1e-3);
  EXPECT_EQ(norm(companion_force(s, k_along * -overlap)), 0.0);
}

TEST_P(BondCompanion, FrictionGivesTheLinearSpringAShearForce) {
  // k_l = pi r E / 2, its shear stiffness k_l / kappa.
  Scene s = scene();
  s.bond.spring_friction = 0.5;
  const double overlap = 20e-6, slide = 1e-6, stiffness = 0.5 * k_pi * k_radius * 20e6;
  EXPECT_EQ(norm(companion_force(s, k_along * overlap)), 0.0);  // the push is there without the option
  const Parts slid = companion_parts(s, overlap, slide);
  EXPECT_NEAR(slid.across / (stiffness / 4.0 * slid.way), 1.0, 1e-3);
  EXPECT_LT(dot(companion_force(s, k_along * overlap + k_across * slide), k_across), 0.0) << "against the motion";
  s.bond.stiffness_ratio = 2.0;
  EXPECT_NEAR(companion_parts(s, overlap, slide).across / (stiffness / 2.0 * slid.way), 1.0, 1e-3);
  s.bond.spring_friction = 0.01;
  EXPECT_NEAR(companion_parts(s, overlap, slide).across / (0.01 * stiffness * overlap), 1.0, 1e-3);
  EXPECT_EQ(norm(companion_force(s, k_along * -overlap + k_across * slide)), 0.0);
  s.bond.linear_spring = false;
  EXPECT_EQ(norm(companion_force(s, k_along * overlap + k_across * slide)), 0.0);
}

TEST_P(BondCompanion, EnergyLedgerCloses) {
  for (const bool is_hertz : {false, true}) {
    Scene scene = lone_grain(k_radius);
    scene.bond.form = GetParam();
    (is_hertz ? scene.bond.hertz_contact : scene.bond.linear_spring) = true;
    scene.bond.spring_friction = is_hertz ? 0.0 : 0.1;
    const double height = (2.0 * k_grain_lattice + 2.0) * k_radius, side = 4.0 * height;
    scene.wall_list = {make_wall("lower", {-side, -side, -0.5 * height}, {2 * side, 0, 0}, {0, 2 * side, 0}),
                       make_wall("upper", {-side, -side, 0.5 * height}, {0, 2 * side, 0}, {2 * side, 0, 0})};
    for (Wall& w : scene.wall_list) w.friction = 0.27;
    scene.integration.local_damping = 0.2;
    Simulation s(scene);
    s.set_time_step(1e-6);
    s.walls[0].velocity = {0, 0, 0.02};
    s.walls[1].velocity = {0, 0, -0.02};
    run_steps(s, 20000);  // to 19 % strain
    const EnergyReport e = s.energy();
    const double sum = e.kinetic + e.contact_strain + e.bond_strain + e.slip + e.dashpot + e.local_damping;
    EXPECT_NEAR(sum / e.boundary_work, 1.0, 0.02) << "Hertz " << is_hertz;
  }
}

INSTANTIATE_TEST_SUITE_P(Forms, BondCompanion, ::testing::Values(BondForm::history_free, BondForm::incremental),
                         [](const auto& tested) {
                           return tested.param == BondForm::incremental ? "incremental" : "history_free";
                         });

TEST(BondCompanionInput, BothAtOnceAreRefused) {
  Scene s = lone_grain(k_radius);
  s.bond.hertz_contact = true;
  s.bond.spring_friction = 0.3;
  EXPECT_THROW(Simulation{s}, InputError);
}

}  // namespace
