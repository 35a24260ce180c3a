// SPDX-License-Identifier: BSD-3-Clause
// The largest stable time step: of the rubber grain against an earlier eigenvalue study, of clumps against closed
// forms, and against what the engine really does on both sides of the limit.
//
// Numbers in microseconds for r = 0.65 mm, 1610 kg/m3, E = 20 MPa: spectral radius of the amplification matrix of all
// 210 degrees of freedom, calculated by a separate program. Parts are switched off through the scene: Hertz contacts by
// a shear modulus of 1 Pa, dashpots by a ratio of 0, the linear spring by its own switch.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "dem4grm/core/random.hpp"
#include "dem4grm/engine/time_step.hpp"
#include "dem4grm/laws/local_damping.hpp"
#include "support/grain_statics.hpp"
#include "support/pressed_sphere.hpp"

namespace {

using namespace dem;
using namespace dem::test;

Scene rubber_scene(double radius = 0.65e-3) {
  Scene s = model_scene();
  s.rubber_ball_radius = radius;
  s.grains = {{{0, 0, 0}, {}}};
  return s;
}

Scene bonds_only(double damping, bool linear_spring, double kappa = 4.0) {
  Scene s = rubber_scene();
  s.rubber.shear_modulus = 1.0;
  s.bond.damping_ratio = damping;
  s.bond.linear_spring = linear_spring;
  s.bond.stiffness_ratio = kappa;
  return s;
}

double microseconds(const TimeStepLimit& t) { return t.seconds * 1e6; }

TEST(GrainTimeStep, AgreesWithTheEigenvalueStudy) {
  EXPECT_NEAR(microseconds(loaded_grain_limit(bonds_only(0.0, false))), 6.62, 0.005);
  EXPECT_NEAR(microseconds(loaded_grain_limit(bonds_only(0.25, false))), 5.53, 0.005);
  EXPECT_NEAR(microseconds(loaded_grain_limit(bonds_only(0.0, true))), 5.76, 0.005);
  EXPECT_NEAR(microseconds(loaded_grain_limit(bonds_only(0.25, true))), 4.55, 0.005);
  EXPECT_NEAR(microseconds(loaded_grain_limit(bonds_only(0.0, false, 1.0))), 3.75, 0.005);
  EXPECT_NEAR(microseconds(loaded_grain_limit(bonds_only(0.0, false, 2.0))), 5.12, 0.005);
  EXPECT_NEAR(microseconds(loaded_grain_limit(bonds_only(0.0, false, 8.0))), 7.52, 0.005);
  // All loads, with dashpots of 0.25 in the bonds and in the contacts.
  for (const auto& [radius, expected] : {std::pair{0.65e-3, 3.92}, {0.627e-3, 3.78}, {0.40e-3, 2.41}}) {
    Scene s = rubber_scene(radius);
    s.contact.normal_damping_ratio = 0.25;
    EXPECT_NEAR(microseconds(loaded_grain_limit(s)), expected, 0.01) << "radius " << radius;
  }
}

/// The loaded grain assembled here: strain vectors of every spring and dashpot, summed as outer products.
double own_limit(double radius, double bond_ratio, double normal_ratio, double shear_ratio) {
  const double mass = 4.0 / 3.0 * k_pi * radius * radius * radius * 1610, inertia = 0.4 * mass * radius * radius;
  Eigen::MatrixXd k = beam_grain_stiffness(radius, beam_stiffness(radius, 20e6, 4.0));
  Eigen::MatrixXd c = Eigen::MatrixXd::Zero(k_grain_dofs, k_grain_dofs);
  // Strain of a pair (j < 0: rigid partner) along `axis` at the contact point, a distance `radius` along n from i.
  const auto add = [&](int i, int j, const Eigen::Vector3d& n, const Eigen::Vector3d& axis, double spring,
                       double dashpot) {
    Eigen::VectorXd e = Eigen::VectorXd::Zero(k_grain_dofs);
    e.segment<3>(6 * i) = -axis;
    e.segment<3>(6 * i + 3) = -radius * n.cross(axis);
    if (j >= 0) {
      e.segment<3>(6 * j) = axis;
      e.segment<3>(6 * j + 3) = -radius * n.cross(axis);
    }
    k += spring * e * e.transpose();
    c += dashpot * e * e.transpose();
  };
  // Hertz tangents 2 E* sqrt(R d) and Mindlin ratio; rubber-rubber 24 MPa with R = r/2, rubber-wall 47.9892 MPa with r.
  const auto contact = [&](int i, int j, const Eigen::Vector3d& n, double spring, double ratio, double reduced_mass) {
    const Eigen::Vector3d t = n.unitOrthogonal(), s = n.cross(t);
    add(i, j, n, n, spring, 2 * normal_ratio * std::sqrt(reduced_mass * spring));
    for (const Eigen::Vector3d& axis : {t, s}) {
      add(i, j, n, axis, ratio * spring, 2 * shear_ratio * std::sqrt(reduced_mass * ratio * spring));
    }
  };
  const double axial = k_pi * radius * 20e6 / 2;
  for (const SlotPair& p : k_bonds_of_grain) {
    const Eigen::Vector3d n = eigen_vector(grain_site(p.j) - grain_site(p.i)).normalized();
    add(p.i, p.j, n, n, axial, 2 * bond_ratio * std::sqrt(0.5 * mass * axial));
  }
  for (const SlotPair& p : k_second_neighbours_of_grain) {
    contact(p.i, p.j, eigen_vector(grain_site(p.j) - grain_site(p.i)).normalized(),
            2 * 24e6 * std::sqrt(0.5 * radius * 0.15 * radius), 2.0 / 3.0, 0.5 * mass);
  }
  for (int slot = 0; slot < k_grain_corners; ++slot) {
    const Eigen::Vector3d site = eigen_vector(grain_site(slot));
    for (int axis = 0; axis < 3; ++axis) {
      if (site[axis] == 0.0) continue;
      for (int twice = 0; twice < 2; ++twice) {
        contact(slot, -1, Eigen::Vector3d::Unit(axis) * site[axis], 2 * 47.9892e6 * std::sqrt(radius * 0.2 * radius),
                0.66669, mass);
      }
    }
  }
  Eigen::VectorXd scale(k_grain_dofs);
  for (Eigen::Index d = 0; d < k_grain_dofs; ++d) scale[d] = 1.0 / std::sqrt(d % 6 < 3 ? mass : inertia);
  k = scale.asDiagonal() * k * scale.asDiagonal();
  c = scale.asDiagonal() * c * scale.asDiagonal();
  // Marginal at an eigenvalue -1 of the step matrix: det(dt^2 K + 2 dt C - 4) = 0 for the first time.
  double dt = 1e-6;
  for (int round = 0; round < 12; ++round) {  // the eigenvalue grows with a power of dt between 1 and 2
    const Eigen::MatrixXd m = dt * dt * k + 2 * dt * c;
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(m, Eigen::EigenvaluesOnly);
    dt *= std::pow(4.0 / solver.eigenvalues().maxCoeff(), 0.65);
  }
  return dt;
}

TEST(GrainTimeStep, KnowsTheDashpotsOfTheContacts) {
  for (const auto& [bond, normal, shear] : {std::tuple{0.0, 0.0, 0.0}, {0.25, 0.0, 0.0}, {0.1, 0.25, 0.4}}) {
    Scene s = rubber_scene();
    s.bond.damping_ratio = bond;
    s.contact.normal_damping_ratio = normal;
    s.contact.shear_damping_ratio = shear;
    const double expected = own_limit(0.65e-3, bond, normal, shear);
    EXPECT_NEAR(loaded_grain_limit(s).seconds, expected, 1e-4 * expected) << bond << ' ' << normal << ' ' << shear;
  }
}

TEST(GrainTimeStep, DiagonalEstimateIsAboutHalf) {
  // Rotation of a cell centre with eight bonds: I = 0.4 m r^2 against 8 (2/3 k_s r^2 + 2/3 k_b + 1/3 k_t), by hand.
  const double r = 0.65e-3, mass = 4.0 / 3.0 * k_pi * r * r * r * 1610;
  const double shear = k_pi * r * 20e6 / 8, bending = k_pi * r * r * r * 20e6 / 8, twist = bending / 2;
  const double expected = std::sqrt(0.4 * mass * r * r / (8 * (2 * shear * r * r / 3 + 2 * bending / 3 + twist / 3)));
  EXPECT_NEAR(diagonal_grain_limit(bonds_only(0.0, false)).seconds, expected, 1e-5 * expected);
  EXPECT_NEAR(0.8 * expected * 1e6, 2.78, 0.005);  // the study's number
}

TEST(GrainTimeStep, ScalesWithRadiusTimesSquareRootOfDensityOverModulus) {
  const double reference = loaded_grain_limit(rubber_scene()).seconds;
  Scene s = rubber_scene(0.325e-3);
  EXPECT_NEAR(loaded_grain_limit(s).seconds / reference, 0.5, 1e-4);
  s = rubber_scene();
  s.rubber.density *= 4.0;
  EXPECT_NEAR(loaded_grain_limit(s).seconds / reference, 2.0, 1e-4);
  s = rubber_scene();
  s.bond.modulus *= 4.0;
  s.rubber.shear_modulus *= 4.0;
  s.walls.shear_modulus *= 4.0;
  EXPECT_NEAR(loaded_grain_limit(s).seconds / reference, 0.5, 1e-4);
}

/// Kinetic energy over the start's after 4000 steps of a free grain with small random motion.
double growth(BondForm form, double damping, double fraction_of_limit) {
  Scene scene = bonds_only(damping, false);
  scene.bond.form = form;
  Simulation s(scene);
  RandomSequence random(3, RandomStream::test, 0);
  for (int slot = 0; slot < k_grain_balls; ++slot) {
    const int i = BallStore::rubber_index(0, slot);
    const auto draw = [&](double size) {
      return Vec3{random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)};
    };
    s.balls.set_velocity(i, draw(1e-6));
    s.balls.set_spin(i, draw(1e-3));
  }
  const double start = s.energy().kinetic;
  s.set_time_step(fraction_of_limit * loaded_grain_limit(scene).seconds);
  double largest = 0.0;
  for (int k = 0; k < 4000 && std::isfinite(largest) && largest < 1e6 * start; ++k) {
    s.step();
    largest = std::max(largest, s.energy().kinetic);
  }
  return largest / start;
}

TEST(GrainTimeStep, EngineIsStableBelowTheLimitAndNotAboveIt) {
  for (const BondForm form : {BondForm::history_free, BondForm::incremental}) {
    for (const double damping : {0.0, 0.25}) {
      EXPECT_LT(growth(form, damping, 0.95), 20.0) << "damping " << damping;
      EXPECT_FALSE(growth(form, damping, 1.1) < 1e6) << "damping " << damping;
      EXPECT_FALSE(growth(form, damping, 1.02) < 1e6) << "damping " << damping;
    }
  }
}

TEST(ClumpTimeStep, OfASpherePressedBetweenPlates) {
  // Stiffest of its modes is the turning one, 2 k_s l^2 / (0.4 m r^2); the bound allows for partners as light as
  // itself, twice that.
  const Simulation s = pressed_sphere();
  const double r = 2.5e-3, lever = r - 10e-6, mass = 4.0 / 3.0 * k_pi * r * r * r * 2710;
  const double omega2 = 2 * 9.459451e4 * lever * lever / (0.4 * mass * r * r);
  EXPECT_NEAR(clump_limit(s).seconds, 2.0 / std::sqrt(2.0 * omega2), 1e-4 * clump_limit(s).seconds);
}

TEST(ClumpTimeStep, IsABoundForTheEngine) {
  for (const double fraction : {0.95, 1.5}) {
    Simulation s = pressed_sphere();
    set_motion(s, 0, {1e-6, 0, 1e-6}, {1e-3, 1e-3, 0});
    const double start = s.energy().kinetic;
    s.set_time_step(fraction * clump_limit(s).seconds);
    run_steps(s, 3000);
    if (fraction < 1.0) {
      EXPECT_LT(s.energy().kinetic, 10 * start);
    } else {
      EXPECT_GT(s.energy().kinetic, 1e3 * start);  // beyond sqrt(2) of it the lone sphere diverges
    }
  }
}

TEST(ClumpTimeStep, KnowsTheDashpotsOfTheContacts) {
  // The turning mode with shear dashpots of 0.25: dt^2 2 K + 2 dt 2 C = 4 with K = 2 k_s l^2 / I and
  // C = 2 * 0.5 sqrt(m k_s) l^2 / I.
  Simulation s = pressed_sphere({0, 0.0, 0.25, 0});
  const double r = 2.5e-3, lever = r - 10e-6, mass = 4.0 / 3.0 * k_pi * r * r * r * 2710, shear = 9.459451e4;
  const double per_inertia = lever * lever / (0.4 * mass * r * r);
  const double k = 2 * shear * per_inertia, c = 2 * 0.5 * std::sqrt(mass * shear) * per_inertia;
  const double expected = (-c + std::sqrt(c * c + 2 * k)) / k;
  EXPECT_NEAR(clump_limit(s).seconds, expected, 1e-4 * expected);
  EXPECT_LT(expected, 0.8 * clump_limit(pressed_sphere()).seconds);
  // And the engine is stable there: the partner is a wall, so even a little beyond.
  set_motion(s, 0, {}, {1e-3, 1e-3, 0});
  const double start = s.energy().kinetic;
  s.set_time_step(0.95 * expected);
  run_steps(s, 3000);
  EXPECT_LT(s.energy().kinetic, start);
  // The estimate for the load to come has both dashpots, too.
  Scene scene = model_scene();
  add_sphere(scene, {0, 0, 0}, 2.5e-3);
  const double without = expected_clump_limit(Simulation(scene), 100e3).seconds;
  scene.contact.normal_damping_ratio = 0.25;
  const double normal = expected_clump_limit(Simulation(scene), 100e3).seconds;
  scene.contact.shear_damping_ratio = 0.25;
  EXPECT_LT(normal, 0.95 * without);
  EXPECT_LT(expected_clump_limit(Simulation(scene), 100e3).seconds, 0.9 * normal);
}

TEST(ClumpTimeStep, IsInfiniteWithoutContacts) {
  Scene scene = model_scene();
  add_sphere(scene, {0, 0, 0}, 2e-3);
  Simulation s(scene);
  EXPECT_EQ(clump_limit(s).seconds, std::numeric_limits<double>::infinity());
  s.set_time_step(1e-6);
  s.step();
  EXPECT_EQ(clump_limit(s).seconds, std::numeric_limits<double>::infinity());
}

TEST(ClumpTimeStep, OfTheLoadToCome) {
  // Twelve contacts at ten times stress * D^2, written out: F = h d^1.5, k = 1.5 h sqrt(d), k_s/k = 0.823529.
  Scene scene = model_scene();
  add_sphere(scene, {0, 0, 0}, 2.5e-3);
  const Simulation s(scene);
  const double force = 10 * 100e3 * 25e-6, h = 6.060915e6, d = std::pow(force / h, 2.0 / 3.0);
  const double stiffness = 12 * 1.5 * h * std::sqrt(d) * (1 + 2 * 0.823529) / 3;
  const double mass = 4.0 / 3.0 * k_pi * std::pow(2.5e-3, 3) * 2710;
  EXPECT_NEAR(expected_clump_limit(s, 100e3).seconds, 2 / std::sqrt(2 * stiffness / mass), 1e-9);
  // Stiffness goes with the cube root of the stress, the step with its sixth.
  EXPECT_NEAR(expected_clump_limit(s, 6.4e6).seconds / expected_clump_limit(s, 100e3).seconds, 0.5, 1e-9);
}

/// Largest excursion of m x'' = -k x with local damping after many leapfrog steps of `share` of 2 / sqrt(k/m).
double excursion_after(double share, double damping) {
  double x = 1.0, v = 0.1;
  const double dt = 2.0 * share;
  for (int k = 0; k < 3000 && std::fabs(x) < 1e6; ++k) {
    v += dt * locally_damped(-x, v, damping);
    x += dt * v;
  }
  return std::fabs(x);
}

TEST(SafeShare, LocalDampingLowersTheLimit) {
  for (const double damping : {0.0, 0.05, 0.2, 0.5, 0.7, 0.9}) {
    const double limit = 1.0 / std::sqrt(1.0 + damping);
    EXPECT_GT(excursion_after(1.02 * limit, damping), 1e5) << damping;
    EXPECT_LT(excursion_after(0.98 * limit, damping), damping > 0.0 ? 1e-6 : 10.0) << damping;
    EXPECT_LE(safe_share(1.0, damping), 0.881 * limit);
  }
  EXPECT_EQ(safe_share(0.8, 0.2), 0.8) << "the published damping";
  EXPECT_EQ(safe_share(0.5, 0.7), 0.5);
  EXPECT_NEAR(safe_share(0.8, 0.7), 0.6749, 1e-4);
}

TEST(ChosenTimeStep, IsTheSafeShareOfTheSmallestLimitInWholeNanoseconds) {
  Scene scene = rubber_scene();
  scene.integration.time_step_safety = 0.8;
  const Simulation grain(scene);
  const TimeStepLimit t = choose_time_step(grain, 100e3);
  EXPECT_NEAR(t.seconds, 0.8 * own_limit(0.65e-3, 0.25, 0.0, 0.0), 1.5e-9);
  EXPECT_LE(t.seconds, 0.8 * loaded_grain_limit(scene).seconds);
  EXPECT_NEAR(t.seconds * 1e9, std::round(t.seconds * 1e9), 1e-6);
  EXPECT_EQ(t.limited_by, "loaded rubber grain");
  scene.integration.time_step_rule = TimeStepRule::diagonal;
  EXPECT_NEAR(choose_time_step(Simulation(scene), 100e3).seconds, 0.8 * diagonal_grain_limit(scene).seconds, 1e-9);

  Simulation pressed = pressed_sphere();
  EXPECT_EQ(choose_time_step(pressed, 1.0).limited_by, "stiffest clump in its contacts");
  EXPECT_NEAR(rounded_down_to_nanosecond(4.5678e-6), 4.567e-6, 1e-15);
}

}  // namespace
