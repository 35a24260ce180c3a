// SPDX-License-Identifier: BSD-3-Clause
// Gravity: free fall, weight on a floor, energy. Expected values are those of school mechanics; the sums of the leapfrog
// scheme are written down beside them.
// Not tested: gravity in a shear test, which has none.
#include <gtest/gtest.h>

#include "dem4grm/engine/observe.hpp"
#include "dem4grm/verify/driven_grain.hpp"
#include "support/scene_builder.hpp"

namespace dem::test {
namespace {

constexpr double k_g = 9.81, k_dt = 1e-6;

Scene falling_scene() {
  Scene scene = model_scene();
  scene.gravity = {0.5, -1.0, -k_g};
  scene.grains = {{{0, 0, 0}, {}}};
  add_sphere(scene, {0.02, 0, 0}, 2e-3);
  add_sphere(scene, {0.03, 0, 0}, 1e-3, k_rubber);
  return scene;
}

/// A grain that starts at rest has moved g dt^2 n (n + 1) / 2 after n steps of the scheme: the sum of its velocities
/// k g dt. The mass does not count.
TEST(Gravity, EveryGrainFallsAlike) {
  Simulation s(falling_scene());
  s.set_time_step(k_dt);
  const int n = 2000;
  run_steps(s, n);
  const Vec3 expected = s.scene.gravity * (k_dt * k_dt * n * (n + 1) / 2.0);
  for (int body = 0; body < s.n_bodies(); ++body) {
    const double start = body == 0 ? 0.0 : body == 1 ? 0.02 : 0.03;
    const Vec3 moved = body_position(s, body) - Vec3{start, 0, 0};
    std::printf("body %d fell %.15e m, expected %.15e (rounding of positions: 1e-17)\n", body, moved.z, expected.z);
    EXPECT_LT(norm(moved - expected), 2e-15) << body;
  }
}

/// What a falling grain gains in motion it loses in height; the kinetic energy is that of the half step before, so the
/// balance is open by g dt / 2 times the momentum.
TEST(Gravity, HeightBecomesSpeed) {
  Simulation s(falling_scene());
  s.set_time_step(k_dt);
  const double before = gravity_energy(s);
  run_steps(s, 2000);
  const double lost = before - gravity_energy(s), gained = s.energy().kinetic;
  std::printf("lost %.9e J, gained %.9e J; 1/n = 5e-4 of it lies in the half step\n", lost, gained);
  EXPECT_NEAR(gained / lost, 1.0, 1.0 / 2000);
}

/// Local damping leaves the share 1 - alpha of a force that acts along the motion.
TEST(Gravity, LocalDampingHoldsBackAFall) {
  Scene scene = falling_scene();
  scene.integration.local_damping = 0.2;
  Simulation s(scene);
  s.set_time_step(k_dt);
  run_steps(s, 1000);
  // The first step starts at rest and is not damped.
  const double expected = -k_g * k_dt * (1.0 + 999 * 0.8);
  EXPECT_NEAR(clump(s, 0).velocity.z, expected, 1e-12 * 1e-2);
}

/// Resting grains press with their weight, and local damping, which sees the whole force, leaves that alone.
TEST(Gravity, FloorCarriesTheWeight) {
  Scene scene = model_scene();
  scene.gravity = {0, 0, -k_g};
  scene.integration.local_damping = 0.7;
  scene.wall_list = {make_wall("floor", {-0.05, -0.05, 0}, {0.1, 0, 0}, {0, 0.1, 0})};
  scene.grains = {{{0, 0, (k_grain_lattice + 1.0) * scene.rubber_ball_radius}, {}}};
  add_sphere(scene, {0.02, 0, 2e-3}, 2e-3);
  Simulation s(scene);
  s.set_time_step(2e-6);
  run_steps(s, 40000);
  const double weight = k_g * (35 * s.rubber().ball_mass + clump(s, 0).mass);
  std::printf("floor %.9e N, weight %.9e N\n", -s.reactions[0].force.z, weight);
  EXPECT_NEAR(-s.reactions[0].force.z / weight, 1.0, 1e-4);
  EXPECT_GT(s.energy().local_damping, 0.0);
}

}  // namespace
}  // namespace dem::test
