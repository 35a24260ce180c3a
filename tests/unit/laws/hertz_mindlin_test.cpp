// SPDX-License-Identifier: BSD-3-Clause
// The Hertz-Mindlin law by itself: loading slope, unloading rules, slip and its work, dashpots, energy, geometry.
//
// Contact of the tests: two gravel spheres of 2.5 mm at 20 um overlap, F_n 0.5421047 N, k_n 4.065786e4 N/m,
// k_s 3.348294e4 N/m (numbers of mixing_test.cpp). Not tested here: the padding rows of the contact table.
#include <gtest/gtest.h>

#include <cmath>

#include "dem4grm/laws/hertz_mindlin.hpp"
#include "support/scene_builder.hpp"

namespace {

using namespace dem;

constexpr double k_overlap = 20e-6, k_force = 0.5421047, k_kn = 4.065786e4, k_ks = 3.348294e4;
constexpr double k_dt = 1e-6;

HertzParameters gravel_contact(double friction, double normal_ratio = 0.0, double shear_ratio = 0.0) {
  const MixedElastic m = mix({90e6, 0.30}, {90e6, 0.30});
  const double h = hertz_coefficient(m, 2.5e-3, 2.5e-3), reduced_mass = 1e-3;
  return {h, mindlin_ratio(m), friction, dashpot_coefficient(normal_ratio, reduced_mass, 1.5 * h),
          dashpot_coefficient(shear_ratio, reduced_mass, 1.5 * h * mindlin_ratio(m))};
}

HertzMotion at_rest(double overlap, const Vec3& shear = {}) {
  HertzMotion m;
  m.overlap = m.old_overlap = overlap;
  m.carried_shear = shear;
  return m;
}

TEST(HertzMindlin, LoadingFollowsTheMindlinSlopeUpToHalfTheFrictionLimit) {
  const HertzParameters p = gravel_contact(0.72);
  Vec3 shear;
  double slid = 0.0;
  while (norm(shear) < 0.5 * 0.72 * k_force && slid < 1e-3) {
    HertzMotion m = at_rest(k_overlap, shear);
    m.shear_velocity = {0.01, 0, 0};
    slid += 0.01 * k_dt;
    shear = hertz_mindlin<HertzOptions{}>(p, m, k_dt).shear;
    ASSERT_NEAR(shear.x, k_ks * slid, 2e-6 * k_ks * slid);  // along the motion of j: it drags i with it
  }
  EXPECT_NEAR(slid, 0.5 * 0.72 * k_force / k_ks, 1e-7);
}

TEST(HertzMindlin, UnloadingRulesAtHalfTheNormalForce) {
  const HertzParameters p = gravel_contact(5.0);  // friction high enough that nothing slips
  const double half = k_overlap * std::pow(0.5, 2.0 / 3.0);
  HertzMotion m = at_rest(half, {0.1, 0, 0});
  m.old_overlap = k_overlap;
  const HertzForce kept = hertz_mindlin<HertzOptions{false, false, false, false}>(p, m, k_dt);
  EXPECT_NEAR(kept.normal, 0.5 * k_force, 1e-7);
  EXPECT_EQ(kept.shear.x, 0.1);
  const HertzForce scaled = hertz_mindlin<HertzOptions{true, false, false, false}>(p, m, k_dt);
  EXPECT_NEAR(scaled.shear.x, 0.1 * std::cbrt(0.5), 1e-12);  // k_s goes with the cube root of the force
  m.old_overlap = 0.5 * half;                                // loading: neither rule changes the shear force
  EXPECT_EQ((hertz_mindlin<HertzOptions{true, false, false, false}>(p, m, k_dt).shear.x), 0.1);
}

TEST(HertzMindlin, SlipCutsToTheFrictionForceAndBooksForceTimesSlip) {
  const HertzParameters p = gravel_contact(0.72);
  const double limit = 0.72 * k_force;
  HertzMotion m = at_rest(k_overlap, {0.0, limit, 0.0});
  m.shear_velocity = {0.0, 0.5, 0.0};
  const HertzForce f = hertz_mindlin<HertzOptions{}>(p, m, k_dt);
  EXPECT_NEAR(norm(f.shear), limit, 1e-7);
  EXPECT_NEAR(f.slip_work, limit * 0.5 * k_dt, 5e-6 * limit * 0.5 * k_dt);
  m.carried_shear = {0.0, 0.5 * limit, 0.0};
  m.shear_velocity = {0.0, 0.001, 0.0};
  EXPECT_EQ(hertz_mindlin<HertzOptions{}>(p, m, k_dt).slip_work, 0.0);  // sticks
}

TEST(HertzMindlin, SlipTurnsTheForceTowardsTheMotion) {
  const HertzParameters p = gravel_contact(0.72);
  Vec3 shear{0.72 * k_force, 0, 0};
  for (int k = 0; k < 200; ++k) {
    HertzMotion m = at_rest(k_overlap, shear);
    m.shear_velocity = {0.0, 0.5, 0.0};
    shear = hertz_mindlin<HertzOptions{}>(p, m, k_dt).shear;
  }
  EXPECT_NEAR(shear.y, 0.72 * k_force, 1e-3 * k_force);
  EXPECT_NEAR(shear.x, 0.0, 1e-2 * k_force);
}

TEST(HertzMindlin, FrictionlessContactHasNoShear) {
  HertzMotion m = at_rest(k_overlap, {0.1, 0.2, 0});
  m.shear_velocity = {1, 0, 0};
  EXPECT_EQ(norm(hertz_mindlin<HertzOptions{}>(gravel_contact(0.0), m, k_dt).shear), 0.0);
}

TEST(HertzMindlin, NothingRemainsOfAnOpenContact) {
  HertzMotion m = at_rest(0.0, {0.1, 0.2, 0});
  m.old_overlap = 1e-6;
  m.shear_velocity = {1, 0, 0};
  m.normal_speed = 1.0;
  const HertzForce f = hertz_mindlin<HertzOptions{true, true, false, false}>(gravel_contact(0.7, 0.25, 0.25), m, k_dt);
  EXPECT_EQ(f.normal_total, 0.0);
  EXPECT_EQ(norm(f.shear), 0.0);
  EXPECT_EQ(norm(f.shear_total), 0.0);
  EXPECT_EQ(f.slip_work, 0.0);
  EXPECT_EQ(f.dashpot_work, 0.0);
}

// Dashpots: 2 * 0.25 * sqrt(1e-3 kg * 4.065786e4 N/m) = 3.188176 N s/m, and with k_s and ratio 0.1 in place of k_n and
// 0.25: 2 * 0.1 * sqrt(1e-3 * 3.348294e4) = 1.157289 N s/m.
constexpr double k_normal_dashpot = 3.188176, k_shear_dashpot = 1.157289;

TEST(HertzMindlin, DashpotsOfModeZero) {
  const HertzParameters p = gravel_contact(5.0, 0.25, 0.1);
  HertzMotion m = at_rest(k_overlap, {0.1, 0, 0});
  m.normal_speed = 0.3;  // separating: the dashpot holds back, even against the spring
  m.shear_velocity = {0.02, 0, 0};
  const HertzForce f = hertz_mindlin<HertzOptions{false, true, false, false}>(p, m, k_dt);
  EXPECT_NEAR(f.normal, k_force, 1e-7);
  EXPECT_NEAR(f.normal_total, k_force - 0.3 * k_normal_dashpot, 1e-6);
  EXPECT_NEAR(f.shear_total.x - f.shear.x, 0.02 * k_shear_dashpot, 1e-8);
  EXPECT_NEAR(f.dashpot_work, (0.09 * k_normal_dashpot + 0.0004 * k_shear_dashpot) * k_dt, 1e-12);
  EXPECT_NEAR(f.shear.x, 0.1 + k_ks * 0.02 * k_dt, 1e-9);  // the history holds the elastic part alone
  m.normal_speed = -0.3;
  const HertzForce approaching = hertz_mindlin<HertzOptions{false, true, false, false}>(p, m, k_dt);
  EXPECT_NEAR(approaching.normal_total, k_force + 0.3 * k_normal_dashpot, 1e-6);
}

TEST(HertzMindlin, ModeOneNeverPulls) {
  const HertzParameters p = gravel_contact(5.0, 0.25, 0.0);
  HertzMotion m = at_rest(k_overlap);
  m.normal_speed = 0.3;
  const HertzForce f = hertz_mindlin<HertzOptions{false, true, true, false}>(p, m, k_dt);
  EXPECT_EQ(f.normal_total, 0.0);
  EXPECT_NEAR(f.dashpot_work, k_force * 0.3 * k_dt, 1e-12);  // only what it really held
  m.normal_speed = 0.1;
  EXPECT_NEAR((hertz_mindlin<HertzOptions{false, true, true, false}>(p, m, k_dt).normal_total),
              k_force - 0.1 * k_normal_dashpot, 1e-6);
}

TEST(HertzMindlin, ModeTwoDropsTheShearDashpotWhileSlipping) {
  const HertzParameters p = gravel_contact(0.1, 0.25, 0.1);
  HertzMotion m = at_rest(k_overlap);
  m.shear_velocity = {0.1, 0, 0};
  m.carried_shear = {0.1 * k_force, 0, 0};
  const HertzForce slipping = hertz_mindlin<HertzOptions{false, true, false, true}>(p, m, k_dt);
  EXPECT_NEAR(slipping.shear_total.x, 0.1 * k_force, 1e-8);
  m.carried_shear = {};
  const HertzForce sticking = hertz_mindlin<HertzOptions{false, true, false, true}>(p, m, k_dt);
  EXPECT_NEAR(sticking.shear_total.x - sticking.shear.x, 0.1 * k_shear_dashpot, 1e-7);
  const HertzForce full = hertz_mindlin<HertzOptions{false, true, false, false}>(p, at_rest(k_overlap), k_dt);
  EXPECT_EQ(full.shear_total.x, 0.0);
}

TEST(HertzMindlin, EnergyIsTheWorkDoneOnTheContact) {
  // Normal: the trapezium sum of the force over a ramp; shear: of the shear force at that overlap.
  const HertzParameters p = gravel_contact(5.0);
  double work = 0.0, before = 0.0;
  const int n = 4000;
  for (int k = 1; k <= n; ++k) {
    const double f = hertz_mindlin<HertzOptions{}>(p, at_rest(k_overlap * k / n), k_dt).normal;
    work += 0.5 * (f + before) * k_overlap / n;
    before = f;
  }
  EXPECT_NEAR(hertz_mindlin_energy(p, k_overlap, {}), work, 1e-6 * work);
  Vec3 shear;
  for (int k = 0; k < 1000; ++k) {
    HertzMotion m = at_rest(k_overlap, shear);
    m.shear_velocity = {0.003, 0.004, 0.0};
    const Vec3 next = hertz_mindlin<HertzOptions{}>(p, m, k_dt).shear;
    work += 0.5 * dot(next + shear, m.shear_velocity) * k_dt;
    shear = next;
  }
  EXPECT_NEAR(hertz_mindlin_energy(p, k_overlap, shear), work, 1e-6 * work);
  EXPECT_EQ(hertz_mindlin_energy(p, 0.0, shear), 0.0);
}

TEST(HertzGeometry, VelocityAtTheContactPointOfUnequalSpinningBalls) {
  // Balls of 2 and 1 mm on the x axis, overlap 0.2 mm: the contact point is 1.9 mm from i and 0.9 mm from j.
  HertzPair pair;
  pair.branch = {2.8e-3, 0, 0};
  pair.radius_i = 2e-3;
  pair.radius_j = 1e-3;
  pair.relative_velocity = {-0.5, 0.1, 0.0};
  pair.spin_i = {7.0, 0, 100.0};
  pair.spin_j = {0, 50.0, 0};
  const double dt = 1e-12;  // so that the mid-step branch is the branch
  const HertzGeometry g = hertz_geometry(pair, dt);
  EXPECT_NEAR(g.motion.overlap, 0.2e-3, 1e-15);
  EXPECT_NEAR(g.lever_i, 1.9e-3, 1e-15);
  EXPECT_NEAR(g.lever_j, 0.9e-3, 1e-15);
  EXPECT_NEAR(g.motion.normal_speed, -0.5, 1e-15);
  // i's point moves with w x r = 100 * 1.9e-3 along +y; j's point with (0,50,0) x (-0.9e-3,0,0) = (0,0,+0.045).
  EXPECT_NEAR(g.motion.shear_velocity.y, 0.1 - 0.19, 1e-9);
  EXPECT_NEAR(g.motion.shear_velocity.z, 0.045, 1e-9);
  EXPECT_NEAR(g.motion.old_overlap, g.motion.overlap - 0.5 * dt, 1e-15);
}

TEST(HertzGeometry, ShearForceTurnsWithTheMeanSpinAboutTheNormal) {
  // Both balls turn about the common normal by 0.1 rad: the shear force goes with them. One alone: half of it.
  const double dt = 1e-3, t = 2.0 / dt * std::tan(0.05);
  for (const double share : {1.0, 0.5}) {
    HertzPair pair;
    pair.branch = {0, 0, 1.9e-3};
    pair.radius_i = pair.radius_j = 1e-3;
    pair.shear = {1, 0, 0};
    pair.spin_i = {0, 0, t};
    pair.spin_j = {0, 0, (2.0 * share - 1.0) * t};
    const Vec3 f = hertz_geometry(pair, dt).motion.carried_shear;
    const double angle = 2.0 * std::atan(share * std::tan(0.05));
    EXPECT_NEAR(f.x, std::cos(angle), 1e-14);
    EXPECT_NEAR(f.y, std::sin(angle), 1e-14);
  }
}

}  // namespace
