// SPDX-License-Identifier: BSD-3-Clause
// Properties of the laws on drawn inputs: symmetry under exchange, mirroring and turning; limits that nothing passes.
#include <gtest/gtest.h>
// rapidcheck's own header needs gtest's first.
#include <rapidcheck/gtest.h>

#include <cmath>

#include "dem4grm/core/random.hpp"
#include "dem4grm/laws/hertz_mindlin.hpp"
#include "dem4grm/laws/parallel_bond.hpp"
#include "dem4grm/laws/rigid_rotation.hpp"

namespace {

using namespace dem;

RandomSequence drawn() { return {*rc::gen::arbitrary<std::uint64_t>(), RandomStream::test, 0}; }

Vec3 vector(RandomSequence& random, double size) {
  return {random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)};
}

/// A touching pair of random sizes and motions, with a shear force from the step before.
HertzPair random_pair(RandomSequence& random, double dt) {
  HertzPair p;
  p.radius_i = random.uniform(1e-3, 3e-3);
  p.radius_j = random.uniform(1e-3, 3e-3);
  p.branch = frame_of(random.orientation()).e1 * ((p.radius_i + p.radius_j) * random.uniform(0.97, 0.999));
  p.relative_velocity = vector(random, 1.0);
  p.spin_i = vector(random, 500.0);
  p.spin_j = vector(random, 500.0);
  const Vec3 old_branch = p.branch - p.relative_velocity * dt;
  p.shear = perpendicular(vector(random, 1.0), old_branch * (1.0 / norm(old_branch)));
  return p;
}

constexpr double k_dt = 1e-6;

HertzForce evaluate(const HertzPair& pair, Vec3& normal) {
  const HertzParameters p{6e6, 0.8, 0.5, 0.3, 0.2};
  const HertzGeometry g = hertz_geometry(pair, k_dt);
  normal = g.normal;
  return hertz_mindlin<HertzOptions{true, true, false, false}>(p, g.motion, k_dt);
}

RC_GTEST_PROP(HertzProperty, ExchangeOfTheBallsTurnsTheForceRound, ()) {
  RandomSequence random = drawn();
  const HertzPair a = random_pair(random, k_dt);
  const HertzPair b{-a.branch, -a.relative_velocity, a.spin_j, a.spin_i, a.radius_j, a.radius_i, -a.shear};
  Vec3 na, nb;
  const HertzForce fa = evaluate(a, na), fb = evaluate(b, nb);
  RC_ASSERT(norm(na + nb) < 1e-14);
  RC_ASSERT(std::abs(fa.normal_total - fb.normal_total) <= 1e-12 * std::abs(fa.normal_total));
  RC_ASSERT(norm(fa.shear_total + fb.shear_total) <= 1e-12 * norm(fa.shear_total) + 1e-15);
  RC_ASSERT(std::abs(fa.slip_work - fb.slip_work) <= 1e-9 * fa.slip_work + 1e-18);
}

RC_GTEST_PROP(HertzProperty, TurningTheWorldTurnsTheForce, ()) {
  RandomSequence random = drawn();
  const HertzPair a = random_pair(random, k_dt);
  const Quaternion q = random.orientation();
  const HertzPair b{rotate(q, a.branch), rotate(q, a.relative_velocity),
                    rotate(q, a.spin_i), rotate(q, a.spin_j),
                    a.radius_i,          a.radius_j,
                    rotate(q, a.shear)};
  Vec3 na, nb;
  const HertzForce fa = evaluate(a, na), fb = evaluate(b, nb);
  RC_ASSERT(norm(rotate(q, fa.shear_total) - fb.shear_total) <= 1e-10 * norm(fa.shear_total) + 1e-14);
  RC_ASSERT(std::abs(fa.normal_total - fb.normal_total) <= 1e-10 * std::abs(fa.normal_total));
}

RC_GTEST_PROP(HertzProperty, CoulombAndSigns, ()) {
  RandomSequence random = drawn();
  Vec3 n;
  const HertzForce f = evaluate(random_pair(random, k_dt), n);
  RC_ASSERT(f.normal > 0.0);
  RC_ASSERT(norm(f.shear) <= 0.5 * f.normal * (1 + 1e-12));
  RC_ASSERT(std::abs(dot(f.shear, n)) <= 1e-14 * (norm(f.shear) + 1));
  RC_ASSERT(f.slip_work >= 0.0);
  RC_ASSERT(f.dashpot_work >= 0.0);
}

RC_GTEST_PROP(HertzProperty, CarryingKeepsLengthAndAngle, ()) {
  RandomSequence random = drawn();
  const Vec3 old_branch = frame_of(random.orientation()).e1 * 2e-3;
  const Vec3 n = frame_of(random.orientation()).e1;
  RC_PRE(dot(old_branch, n) > -1.9e-3);  // not turned right round
  const Vec3 f = perpendicular(vector(random, 1.0), old_branch * 500.0);
  const Vec3 g = carried_with_normal(f, old_branch, 2e-3, n);
  RC_ASSERT(std::abs(norm(g) - norm(f)) <= 1e-12 * norm(f) + 1e-15);
  RC_ASSERT(std::abs(dot(g, n)) <= 1e-12);
  // The smallest rotation leaves alone what is perpendicular to both branches.
  const Vec3 axis = cross(old_branch, n);
  RC_ASSERT(std::abs(dot(g, axis) - dot(f, axis)) <= 1e-15);
}

RC_GTEST_PROP(BondProperty, ExchangeOfTheBallsTurnsForcesAndMomentsRound, ()) {
  RandomSequence random = drawn();
  const BondParameters p = bond_parameters({0.6e-3, 1.7e-6, 20e6, 4.0, 1.0, 1.0, 0.25, 30e200, 30e200, true});
  const Vec3 t = frame_of(random.orientation()).e1;
  const Vec3 branch = t * p.rest_length + vector(random, 1e-4), v = vector(random, 0.1);
  const Quaternion qi = turned({}, vector(random, 0.2), 1.0), qj = turned({}, vector(random, 0.2), 1.0);
  const Vec3 sum = rotate(qi, t) + rotate(qj, t);
  const BondForce a = history_free_bond(p, branch, v, sum, qi, qj);
  const BondForce b = history_free_bond(p, -branch, -v, -sum, qj, qi);
  RC_ASSERT(norm(a.force + b.force) <= 1e-13 * norm(a.force));
  RC_ASSERT(norm(a.moment + b.moment) <= 1e-13 * norm(a.moment));
  RC_ASSERT(norm(a.couple - b.couple) <= 1e-13 * norm(a.couple) + 1e-25);
}

RC_GTEST_PROP(BondProperty, TurningTheWorldTurnsTheHistoryFreeForces, ()) {
  RandomSequence random = drawn();
  const BondParameters p = bond_parameters({0.6e-3, 1.7e-6, 20e6, 4.0, 1.0, 1.0, 0.25, 30e200, 30e200, true});
  const Vec3 t = frame_of(random.orientation()).e1;
  const Vec3 branch = t * p.rest_length + vector(random, 1e-4), v = vector(random, 0.1);
  const Quaternion qi = random.orientation();  // any attitude, as after a long tumble
  const Quaternion qj = turned(qi, vector(random, 0.2), 1.0), q = random.orientation();
  const auto carried = [&](const Quaternion& a) { return rotate(a, rotate(conjugate(qi), t)); };
  const Vec3 sum = carried(qi) + carried(qj);
  const BondForce a = history_free_bond(p, branch, v, sum, qi, qj);
  const BondForce b = history_free_bond(p, rotate(q, branch), rotate(q, v), rotate(q, sum), q * qi, q * qj);
  RC_ASSERT(norm(rotate(q, a.force) - b.force) <= 1e-12 * norm(a.force));
  RC_ASSERT(norm(rotate(q, a.moment) - b.moment) <= 1e-12 * norm(a.moment));
}

}  // namespace
