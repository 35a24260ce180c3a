// SPDX-License-Identifier: BSD-3-Clause
// Head-on impacts through the engine: peak overlap, peak force, duration, restitution.
//
// Cases and parameters: Chung & Ooi (2011), Granular Matter 13, benchmarks 1 to 3. Expected numbers: Hertz,
//   d_max = (15 m* v^2 / (16 E* sqrt R*))^(2/5),  F = (4/3) E* sqrt(R*) d_max^1.5,  t_c = 2.943 d_max / v,
// worked out beforehand (the 7.1082 kN of limestone also stands in the benchmark files of Kratos Multiphysics).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "support/independent_integrator.hpp"
#include "support/scene_builder.hpp"

namespace {

using namespace dem;
using namespace dem::test;

struct Impact {
  double overlap = 0.0, force = 0.0, duration = 0.0, rebound = 0.0;  // m, N, s, m/s (relative, positive apart)
};

/// Runs until the two bodies (or body and wall) are apart again; `speed` is the closing speed.
Impact strike(Simulation& s, double reach, double speed, double expected_duration, int steps_per_contact = 4000) {
  const bool at_wall = !s.walls.empty();
  s.set_time_step(expected_duration / steps_per_contact);
  Impact out;
  int touching = 0;
  for (int k = 0; k < 3 * steps_per_contact; ++k) {
    const double distance = at_wall ? clump(s, 0).position.z : norm(clump(s, 1).position - clump(s, 0).position);
    out.overlap = std::max(out.overlap, reach - distance);
    s.step();
    const std::ptrdiff_t row = at_wall ? wall_row(s, 0, 0) : pair_row(s, 0, 1);
    const double force = row < 0 ? 0.0 : norm(s.contacts.force(static_cast<std::size_t>(row)));
    out.force = std::max(out.force, force);
    if (force > 0.0) ++touching;
    if (touching > 0 && force == 0.0 && distance > reach) break;
  }
  out.duration = touching * s.time_step();
  out.rebound = at_wall ? clump(s, 0).velocity.z : dot(clump(s, 1).velocity - clump(s, 0).velocity, {1, 0, 0});
  EXPECT_GT(out.rebound, 0.0);
  EXPECT_LE(out.rebound, speed * (1 + 1e-6));
  return out;
}

Simulation two_spheres(const MaterialSettings& m, double radius, double speed, const ContactSettings& contact = {}) {
  Scene scene = model_scene();
  scene.gravel = m;
  scene.contact = contact;
  add_sphere(scene, {0, 0, 0}, radius);
  add_sphere(scene, {2.0 * radius * (1 + 1e-9), 0, 0}, radius);
  Simulation s(scene);
  set_motion(s, 0, {0.5 * speed, 0, 0});
  set_motion(s, 1, {-0.5 * speed, 0, 0});
  return s;
}

Simulation sphere_on_wall(const MaterialSettings& m, double radius, double speed, const ContactSettings& contact = {}) {
  Scene scene = model_scene();
  scene.gravel = m;
  scene.contact = contact;
  scene.walls.shear_modulus = 1e9 * m.shear_modulus;  // a rigid plane
  scene.wall_list = {make_wall("plane", {-1, -1, 0}, {2, 0, 0}, {0, 2, 0})};
  add_sphere(scene, {0, 0, radius * (1 + 1e-9)}, radius);
  Simulation s(scene);
  set_motion(s, 0, {0, 0, -speed});
  return s;
}

struct Benchmark {
  std::string name;
  double young, poisson, density, radius, speed;  // Pa, -, kg/m3, m, m/s closing
  bool at_wall;
  double overlap, force, duration;
};

void PrintTo(const Benchmark& b, std::ostream* out) { *out << b.name; }

class HertzImpact : public ::testing::TestWithParam<Benchmark> {};

TEST_P(HertzImpact, PeakOverlapForceAndDuration) {
  const Benchmark& b = GetParam();
  const MaterialSettings m{b.density, 0.0, shear_modulus(b.young, b.poisson), b.poisson};
  Simulation s = b.at_wall ? sphere_on_wall(m, b.radius, b.speed) : two_spheres(m, b.radius, b.speed);
  const Impact i = strike(s, b.at_wall ? b.radius : 2 * b.radius, b.speed, b.duration);
  EXPECT_NEAR(i.overlap, b.overlap, 1e-4 * b.overlap);
  EXPECT_NEAR(i.force, b.force, 1e-4 * b.force);
  EXPECT_NEAR(i.duration, b.duration, 1e-3 * b.duration);
  EXPECT_NEAR(i.rebound, b.speed, 1e-5 * b.speed);
}

INSTANTIATE_TEST_SUITE_P(
    ChungOoi, HertzImpact,
    ::testing::Values(Benchmark{"glass", 48e9, 0.20, 2800, 0.01, 20.0, false, 274.11e-6, 10696.9, 40.336e-6},
                      Benchmark{"limestone", 20e9, 0.25, 2500, 0.01, 20.0, false, 368.30e-6, 7108.2, 54.196e-6},
                      Benchmark{"aluminium", 70e9, 0.30, 2699, 0.1, 0.2, true, 49.717e-6, 11370.0, 731.59e-6},
                      Benchmark{"magnesium", 40e9, 0.35, 1800, 0.1, 0.2, true, 52.123e-6, 7232.7, 766.99e-6},
                      Benchmark{"oxide", 380e9, 0.23, 4000, 2.5e-3, 3.9, true, 8.0888e-6, 615.4, 6.1039e-6},
                      Benchmark{"iron", 100e9, 0.25, 7000, 2.5e-3, 3.9, true, 17.189e-6, 506.8, 12.971e-6}),
    [](const auto& tested) { return tested.param.name; });

TEST(UnlikeImpact, UnequalSpheresOfUnlikeMaterial) {
  // Gravel 3 mm against rubber ball 1 mm at 1 m/s; E* and nu from the mixing table (40.4494 MPa), masses by hand.
  Scene scene = model_scene();
  add_sphere(scene, {0, 0, 0}, 3e-3, k_gravel);
  add_sphere(scene, {4e-3 * (1 + 1e-9), 0, 0}, 1e-3, k_rubber);
  Simulation s(scene);
  set_motion(s, 1, {-1.0, 0, 0});
  const double m1 = 4.0 / 3.0 * k_pi * 27e-9 * 2710, m2 = 4.0 / 3.0 * k_pi * 1e-9 * 1610;
  const double mass = m1 * m2 / (m1 + m2), radius = 0.75e-3, modulus = 40.4494e6;
  const double overlap = std::pow(15.0 * mass / (16.0 * modulus * std::sqrt(radius)), 0.4);
  const Impact i = strike(s, 4e-3, 1.0, 2.943 * overlap);
  EXPECT_NEAR(i.overlap, overlap, 2e-4 * overlap);
  EXPECT_NEAR(i.duration, 2.943 * overlap, 1e-3 * 2.943 * overlap);
  EXPECT_NEAR(i.force, 4.0 / 3.0 * modulus * std::sqrt(radius) * std::pow(overlap, 1.5), 2e-4 * i.force);
}

// Restitution of the tangent-stiffness dashpot, independent of speed: e = exp(-pi b / sqrt(5/6 - b^2)), the inverse of
// b = sqrt(5/6) (-ln e) / sqrt(pi^2 + ln^2 e) (Tsuji, Tanaka & Ishida, 1992; Antypov & Elliott, 2011).
const MaterialSettings k_iron{7000, 0.0, 40e9, 0.25};

TEST(Restitution, FollowsTheDampingRatioAtAnySpeed) {
  const double table[][2] = {{0.05, 0.842}, {0.10, 0.707}, {0.20, 0.494}, {0.25, 0.409}, {0.50, 0.128}};
  for (const auto& [b, e] : table) {
    EXPECT_NEAR(std::exp(-k_pi * b / std::sqrt(5.0 / 6.0 - b * b)), e, 6e-4);  // the table itself
    for (const double speed : {0.39, 3.9}) {
      ContactSettings contact;
      contact.normal_damping_ratio = b;
      const double duration = 12.971e-6 * std::pow(3.9 / speed, 0.2);
      Simulation wall = sphere_on_wall(k_iron, 2.5e-3, speed, contact);
      EXPECT_NEAR(strike(wall, 2.5e-3, speed, duration).rebound / speed, e, 2e-3) << "b " << b << " speed " << speed;
      Simulation pair = two_spheres(k_iron, 2.5e-3, speed, contact);
      EXPECT_NEAR(strike(pair, 5e-3, speed, duration).rebound / speed, e, 2e-3) << "b " << b << " speed " << speed;
    }
  }
}

TEST(Restitution, WithoutTensionTheReboundIsFaster) {
  // Mode 1 against our own integration of d'' = -max(0, h d^1.5 + c d^(1/4) d') / m, c = 2 b sqrt(1.5 m h).
  for (const double b : {0.25, 0.5}) {
    ContactSettings contact;
    contact.normal_damping_ratio = b;
    contact.dashpot_mode = 1;
    Simulation s = sphere_on_wall(k_iron, 2.5e-3, 3.9, contact);
    const double rebound = strike(s, 2.5e-3, 3.9, 12.971e-6).rebound / 3.9;

    const double mass = 7000 * 4.0 / 3.0 * k_pi * std::pow(2.5e-3, 3), modulus = 100e9 / (1 - 0.0625);
    const double h = 4.0 / 3.0 * modulus * std::sqrt(2.5e-3), c = 2 * b * std::sqrt(1.5 * mass * h);
    StateVector<2> y{0.0, 3.9};
    const auto motion = [&](double, const StateVector<2>& q) {
      const double d = std::max(0.0, q[0]);
      const double f = d > 0.0 ? std::max(0.0, h * std::pow(d, 1.5) + c * std::pow(d, 0.25) * q[1]) : 0.0;
      return StateVector<2>{q[1], -f / mass};
    };
    for (int k = 0; k < 60000 && (k < 10 || y[0] > 0.0); ++k) y = runge_kutta_step(motion, 0.0, y, 1e-9);
    EXPECT_NEAR(rebound, -y[1] / 3.9, 2e-3);
    EXPECT_GT(rebound, std::exp(-k_pi * b / std::sqrt(5.0 / 6.0 - b * b)));
  }
}

TEST(Restitution, DashpotLossIsTheEnergyThatIsMissing) {
  ContactSettings contact;
  contact.normal_damping_ratio = 0.2;
  Simulation s = two_spheres(k_iron, 2.5e-3, 3.9, contact);
  const double before = s.energy().kinetic;
  strike(s, 5e-3, 3.9, 12e-6, 20000);
  const EnergyReport e = s.energy();
  EXPECT_NEAR(e.dashpot, before - e.kinetic, 1e-3 * e.dashpot);
  EXPECT_EQ(e.slip, 0.0);
}

}  // namespace
