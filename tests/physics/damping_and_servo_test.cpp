// SPDX-License-Identifier: BSD-3-Clause
// Local damping and the plate servo through the engine.
//
// Expected: an oscillator under local damping a swings in against (1-a) of its spring and out against (1+a), so each
// half swing keeps sqrt((1-a)/(1+a)) of the amplitude (0.8165 at 0.2); a proportional servo leaves 1 - gain of the
// force error after each step, and none in the end.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "dem4grm/walls/servo.hpp"
#include "support/scene_builder.hpp"

namespace {

using namespace dem;
using namespace dem::test;

/// A sphere held between two smooth plates with overlap d0 on each: for small motions a linear oscillator of stiffness
/// 2 * 1.5 * h sqrt(d0).
struct Oscillator {
  static constexpr double k_radius = 2.5e-3, k_overlap = 20e-6;
  Simulation s;
  double frequency;  // rad/s

  explicit Oscillator(double damping, double safety = 400.0) : s(make_scene(damping)) {
    const double stiffness = 2.0 * 1.148593e5;  // k_n of gravel on wall at 20 um, twice
    frequency = std::sqrt(stiffness / clump(s, 0).mass);
    s.set_time_step(2 * k_pi / frequency / safety);
  }
  static Scene make_scene(double damping) {
    Scene scene = model_scene();
    scene.integration.local_damping = damping;
    const double gap = 2 * (k_radius - k_overlap);
    scene.wall_list = {make_wall("floor", {-1, -1, 0}, {2, 0, 0}, {0, 2, 0}),
                       make_wall("lid", {-1, -1, gap}, {0, 2, 0}, {2, 0, 0})};
    add_sphere(scene, {0, 0, 0.5 * gap}, k_radius);
    return scene;
  }
  [[nodiscard]] double height() const { return clump(s, 0).position.z - (k_radius - k_overlap); }
};

TEST(LocalDamping, HalfSwingsOfASpringLoseTheKnownShare) {
  for (const double alpha : {0.2, 0.5}) {
    Oscillator o(alpha);
    set_motion(o.s, 0, {0, 0, 1e-4});
    std::vector<double> peaks;
    double before = 0.0, rate = 1.0;
    while (peaks.size() < 5 && o.s.steps < 10000) {
      o.s.step();
      const double now = o.height();
      if ((now - before) * rate < 0.0) {
        peaks.push_back(std::abs(before));
        rate = -rate;
      }
      before = now;
    }
    ASSERT_EQ(peaks.size(), 5U);
    const double expected = std::sqrt((1 - alpha) / (1 + alpha));
    for (std::size_t k = 1; k < peaks.size(); ++k)
      EXPECT_NEAR(peaks[k] / peaks[k - 1], expected, 4e-3) << "alpha " << alpha;
  }
}

TEST(LocalDamping, LossIsTheEnergyThatIsMissing) {
  Oscillator o(0.2, 4000.0);
  set_motion(o.s, 0, {0, 0, 1e-4});
  o.s.step();
  const EnergyReport start = o.s.energy();
  run_steps(o.s, 40000);
  const EnergyReport end = o.s.energy();
  const double swing = start.kinetic;  // the strain energy of the squeeze is far larger and stays
  EXPECT_NEAR(end.local_damping - start.local_damping,
              start.kinetic + start.contact_strain - end.kinetic - end.contact_strain, 5e-3 * swing);
  EXPECT_GT(end.local_damping, 0.9 * swing);
}

TEST(LocalDamping, SpinIsDampedAsWell) {
  // Torsional swing of a sphere that sticks to both plates: amplitude ratio again sqrt((1-a)/(1+a)). The couple of the
  // two friction springs is 2 k_s r^2 times the turn about a horizontal axis.
  Scene scene = Oscillator::make_scene(0.2);
  for (Wall& w : scene.wall_list) w.friction = 0.7;
  Simulation s(scene);
  s.set_time_step(1e-8);  // the spring counts the half step before the start, which shifts the middle of the swing
  set_motion(s, 0, {}, {0.01, 0, 0});
  double turn = 0.0, before = 0.0, rate = 1.0;
  std::vector<double> peaks;
  while (peaks.size() < 4 && s.steps < 100000) {
    s.step();
    before = turn;
    turn += clump(s, 0).spin.x * s.time_step();
    if ((turn - before) * rate < 0.0) {
      peaks.push_back(std::abs(before));
      rate = -rate;
    }
  }
  ASSERT_EQ(peaks.size(), 4U);
  for (std::size_t k = 1; k < peaks.size(); ++k) EXPECT_NEAR(peaks[k] / peaks[k - 1], 0.8165, 4e-3);
}

TEST(Servo, VelocityOfTheFormula) {
  EXPECT_DOUBLE_EQ(servo_velocity(2.0, 4e5, 1e-6, 0.5, 1e9), 0.5 * 2.0 / (1e-6 * 4e5));
  EXPECT_DOUBLE_EQ(servo_velocity(-2.0, 4e5, 1e-6, 0.5, 0.01), -0.01);
  EXPECT_DOUBLE_EQ(servo_velocity(2.0, 4e5, 1e-6, 0.5, 0.01), 0.01);
  EXPECT_DOUBLE_EQ(servo_velocity(2.0, 0.0, 1e-6, 0.5, 0.01), 0.01);    // nothing touched yet: approach
  EXPECT_DOUBLE_EQ(servo_velocity(-2.0, 0.0, 1e-6, 0.5, 0.01), -0.01);  // and the other way
}

TEST(Servo, ForceErrorShrinksByOneMinusGain) {
  // A bed of nine balls too heavy to move: nine Hertz springs under the plate, linear over a small error.
  for (const double gain : {0.5, 0.8, 1.5}) {
    Scene scene = model_scene();
    scene.gravel.density = 1e15;
    const double r = 2.5e-3;
    for (int k = 0; k < 9; ++k) add_sphere(scene, {0.01 * (k % 3), 0.01 * (k / 3), r}, r);
    scene.wall_list = {make_wall("plate", {-1, -1, 2 * r - 20e-6}, {0, 2, 0}, {2, 0, 0})};
    Simulation s(scene);
    s.set_time_step(1e-6);
    const double at_rest = 9 * 1.531458;  // N, gravel on wall at 20 um
    s.servo = {0, at_rest * 1.01, gain, 1.0};
    s.step();
    EXPECT_NEAR(s.reactions[0].force.z, at_rest, 1e-6 * at_rest);
    EXPECT_NEAR(s.reactions[0].stiffness, 9 * 1.148593e5, 1.0);
    double error = s.servo.target_force - s.reactions[0].force.z;
    for (int k = 0; k < 4; ++k) {
      s.step();
      const double next = s.servo.target_force - s.reactions[0].force.z;
      EXPECT_NEAR(next / error, 1.0 - gain, 0.01) << "gain " << gain << " step " << k;
      error = next;
    }
    run_steps(s, 100);
    EXPECT_NEAR(s.reactions[0].force.z, s.servo.target_force, 1e-9 * at_rest) << "gain " << gain;
  }
}

TEST(Servo, ApproachesAtTheCapAndLeavesOtherComponentsAlone) {
  Scene scene = model_scene();
  scene.gravel.density = 1e15;
  add_sphere(scene, {0, 0, 2.5e-3}, 2.5e-3);
  scene.wall_list = {make_wall("plate", {-1, -1, 6e-3}, {0, 2, 0}, {2, 0, 0})};
  Simulation s(scene);
  s.set_time_step(1e-6);
  s.servo = {0, 1.0, 0.5, 0.05};
  s.walls[0].velocity = {0.3, 0.1, 0};
  run_steps(s, 1000);
  EXPECT_NEAR(s.walls[0].corner.z, 6e-3 - 0.05 * 1e-3, 1e-12);
  EXPECT_NEAR(s.walls[0].corner.x, -1 + 0.3e-3, 1e-12);
  EXPECT_NEAR(s.walls[0].corner.y, -1 + 0.1e-3, 1e-12);
}

}  // namespace
