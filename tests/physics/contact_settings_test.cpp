// SPDX-License-Identifier: BSD-3-Clause
// The contact settings of a scene reach the contact law: unloading rule, dashpots and their four modes, at balls and
// at walls.
//
// Two gravel spheres of 2.5 mm (or one on a wall) led by hand through the stages of the engine. Expected: Mindlin
// springs with the constants of the contact table, k_s 3.348294e4 (9.459451e4 at the wall) N/m and F_n 0.5421047
// (1.531458) N at 20 um; shear rescaled with the cube root of the normal force; dashpots 2 b sqrt(m k) with half the
// mass of a sphere (all of it at the wall).
#include <gtest/gtest.h>

#include <cmath>

#include "support/scene_builder.hpp"

namespace {

using namespace dem;
using namespace dem::test;

constexpr double k_ball_radius = 2.5e-3, k_overlap = 20e-6, k_dt = 1e-6;

/// A sphere at the origin touched from +z by a second sphere or from below by a wall; the first sphere is led.
class Led {
 public:
  Led(const ContactSettings& contact, bool at_wall, double friction)
      : at_wall_(at_wall), s_(scene(contact, at_wall, friction)) {
    s_.set_time_step(k_dt);
    refresh_candidates(s_);
    row_ = static_cast<std::size_t>(at_wall ? wall_row(s_, 0, 0) : pair_row(s_, 0, 1));
  }
  /// Moves the led sphere by so much in one step and evaluates; returns the force on it.
  Vec3 move(const Vec3& by) {
    s_.balls.set_velocity(0, by * (1.0 / k_dt));
    s_.balls.set_position(0, s_.balls.position(0) + by);
    at_wall_ ? evaluate_wall_contacts(s_) : evaluate_ball_contacts(s_);
    return s_.contacts.force(row_);
  }
  [[nodiscard]] Vec3 shear() const { return s_.contacts.shear(row_); }

 private:
  static Scene scene(const ContactSettings& contact, bool at_wall, double friction) {
    Scene out = model_scene();
    out.contact = contact;
    out.gravel.friction = friction;
    add_sphere(out, {0, 0, 0}, k_ball_radius);
    if (at_wall) {
      out.wall_list = {make_wall("lid", {-1, -1, k_ball_radius - k_overlap}, {0, 2, 0}, {2, 0, 0})};
      out.wall_list[0].friction = friction;
    } else {
      add_sphere(out, {0, 0, 2 * k_ball_radius - k_overlap}, k_ball_radius);
    }
    return out;
  }
  bool at_wall_;
  Simulation s_;
  std::size_t row_ = 0;
};

class ContactSetting : public ::testing::TestWithParam<bool> {
 protected:
  [[nodiscard]] double shear_stiffness() const { return GetParam() ? 9.459451e4 : 3.348294e4; }
  [[nodiscard]] double normal_stiffness() const { return GetParam() ? 1.148593e5 : 4.065786e4; }
  [[nodiscard]] double normal_force() const { return GetParam() ? 1.531458 : 0.5421047; }
  [[nodiscard]] double mass() const {
    return 2710 * 4.0 / 3.0 * k_pi * k_ball_radius * k_ball_radius * k_ball_radius * (GetParam() ? 1.0 : 0.5);
  }
};

TEST_P(ContactSetting, UnloadingRule) {
  for (const int mode : {0, 1}) {
    Led led({mode, 0, 0, 0}, GetParam(), 5.0);
    led.move({});
    led.move({1e-6, 0, 0});
    const double loaded = led.shear().x;
    EXPECT_NEAR(loaded, -shear_stiffness() * 1e-6, 1e-5 * shear_stiffness() * 1e-6 + 1e-6);
    led.move({0, 0, -k_overlap * (1 - std::pow(0.5, 2.0 / 3.0))});  // half the normal force
    EXPECT_NEAR(led.shear().x / loaded, mode == 0 ? 1.0 : std::cbrt(0.5), 3e-3) << "mode " << mode;
    led.move({0, 0, k_overlap * (1 - std::pow(0.5, 2.0 / 3.0))});  // loading again changes nothing
    EXPECT_NEAR(led.shear().x / loaded, mode == 0 ? 1.0 : std::cbrt(0.5), 3e-3) << "mode " << mode;
  }
}

TEST_P(ContactSetting, DashpotsOfEachKind) {
  const double v = 0.01, step = v * k_dt;
  {
    Led led({0, 0.2, 0.0, 0}, GetParam(), 5.0);
    led.move({});
    const double c = 2 * 0.2 * std::sqrt(mass() * normal_stiffness());
    EXPECT_NEAR(led.move({0, 0, step}).z, -normal_force() - normal_stiffness() * step - c * v, 1e-3 * c * v);
    EXPECT_NEAR(led.move({0, 0, -step}).z, -normal_force() + c * v, 1e-3 * c * v);
  }
  Led led({0, 0.0, 0.1, 0}, GetParam(), 5.0);
  led.move({});
  const double c = 2 * 0.1 * std::sqrt(mass() * shear_stiffness());
  EXPECT_NEAR(led.move({step, 0, 0}).x, -shear_stiffness() * step - c * v, 1e-3 * c * v);
  EXPECT_NEAR(led.shear().x, -shear_stiffness() * step, 1e-3 * shear_stiffness() * step);
}

TEST_P(ContactSetting, ModesOneAndThreeForbidTension) {
  for (int mode = 0; mode < 4; ++mode) {
    Led led({0, 0.5, 0.0, mode}, GetParam(), 5.0);
    led.move({});
    const double force = led.move({0, 0, -0.5e-6}).z;  // parting at 0.5 m/s: the dashpot is stronger than the spring
    if (mode == 1 || mode == 3) {
      EXPECT_NEAR(force, 0.0, 1e-12) << "mode " << mode;
    } else {
      EXPECT_GT(force, 0.1 * normal_force()) << "mode " << mode;
    }
  }
}

TEST_P(ContactSetting, ModesTwoAndThreeDropTheShearDashpotInSlip) {
  for (int mode = 0; mode < 4; ++mode) {
    Led led({0, 0.0, 0.3, mode}, GetParam(), 0.1);
    led.move({});
    for (int k = 0; k < 20; ++k) led.move({1e-6, 0, 0});
    const double extra = std::abs(led.move({1e-6, 0, 0}).x) - 0.1 * normal_force();
    if (mode >= 2) {
      EXPECT_NEAR(extra, 0.0, 1e-2 * normal_force()) << "mode " << mode;
    } else {
      EXPECT_NEAR(extra, 2 * 0.3 * std::sqrt(mass() * shear_stiffness()) * 1.0, 0.1 * extra) << "mode " << mode;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Partners, ContactSetting, ::testing::Bool(),
                         [](const auto& tested) { return tested.param ? "wall" : "ball"; });

}  // namespace
