// SPDX-License-Identifier: BSD-3-Clause
// A rubber grain that nothing touches and nothing damps: what its vibration must keep.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "dem4grm/core/random.hpp"
#include "dem4grm/verify/driven_grain.hpp"
#include "dem4grm/verify/grain_checks.hpp"

namespace dem::verify {

namespace {

const char* name_of(BondForm form) { return form == BondForm::incremental ? "incremental" : "history-free"; }

/// A tilted grain whose balls get random velocities (m/s) and the spins that go with them.
Simulation vibrating_grain(BondForm form, double speed) {
  BondSettings bond;
  bond.form = form;
  bond.damping_ratio = 0.0;
  bond.linear_spring = false;
  Scene scene = lone_grain_scene(bond);
  scene.grains = {{{0.01, 0.02, 0.03}, normalized({1, 0.3, 0.2, -0.4})}};
  Simulation s(scene);
  RandomSequence random(5, RandomStream::test, 0);
  for (int slot = 0; slot < k_grain_balls; ++slot) {
    const int i = BallStore::rubber_index(0, slot);
    const auto draw = [&](double size) {
      return Vec3{random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)};
    };
    s.balls.set_velocity(i, draw(speed));
    s.balls.set_spin(i, draw(speed / scene.rubber_ball_radius));
  }
  return s;
}

struct Totals {
  Vec3 momentum, angular_momentum;
  double scale = 0.0;  // sum of |m v|
};

Totals totals(const Simulation& s) {
  Totals t;
  for (int slot = 0; slot < k_grain_balls; ++slot) {
    const int i = BallStore::rubber_index(0, slot);
    const Vec3 p = s.balls.velocity(i) * s.rubber().ball_mass;
    t.momentum += p;
    t.angular_momentum +=
        cross(s.balls.position(i) - s.scene.grains[0].position, p) + s.balls.spin(i) * ball_inertia(s);
    t.scale += norm(p);
  }
  return t;
}

/// Strain energy at the present positions. The incremental form holds the shear force and moment of the last
/// evaluation, one step behind the positions, so they are taken from the state after the next step.
double bond_energy_now(const Simulation& s, const Simulation& next) {
  if (s.scene.bond.form == BondForm::history_free) return s.energy().bond_strain;
  double sum = 0.0;
  for (int k = 0; k < k_grain_bonds; ++k) {
    const BondReading now = read_bond(s, 0, k), later = read_bond(next, 0, k);
    sum += bond_energy(s.rubber().bond, now.length, later.shear, later.moment, now.normal);
  }
  return sum;
}

struct Departure {
  double worst = 0.0, least_kinetic = 1.0;  ///< over the energy at the start
};

/// Largest departure of the total energy from its start over 0.5 ms; kinetic energy as the mean over the half steps
/// around the instant to which the strain energy belongs.
Departure energy_departure(BondForm form, double speed, double dt) {
  Simulation s = vibrating_grain(form, speed);
  s.set_time_step(dt);
  const double start = s.energy().kinetic;
  Departure out;
  const int n = static_cast<int>(std::lround(0.5e-3 / dt));
  for (int k = 0; k < n; ++k) {
    s.step();
    Simulation next = s;
    next.step();
    const double kinetic = 0.5 * (s.energy().kinetic + next.energy().kinetic);
    out.worst = std::max(out.worst, std::abs(kinetic + bond_energy_now(s, next) - start) / start);
    out.least_kinetic = std::min(out.least_kinetic, kinetic / start);
    s = std::move(next);
  }
  return out;
}

}  // namespace

void check_free_grain(Findings& findings) {
  for (const BondForm form : {BondForm::history_free, BondForm::incremental}) {
    Simulation s = vibrating_grain(form, 0.5);  // up to about 5 % strain
    s.set_time_step(1e-6);
    s.step();  // positions catch up with the velocities
    const Totals before = totals(s);
    run_steps(s, 5000);
    const Totals after = totals(s);
    const double arm = 4.0 * s.scene.rubber_ball_radius;
    findings.at_most(fmt::format("change of momentum over its scale, 5000 steps, {}", name_of(form)), "1", 1e-12,
                     norm(after.momentum - before.momentum) / before.scale, "Newton's third law");
    findings.at_most(fmt::format("change of angular momentum over its scale, 5000 steps, {}", name_of(form)), "1",
                     1e-10, norm(after.angular_momentum - before.angular_momentum) / (before.scale * arm),
                     "forces and moments of a bond balance");
    const Departure coarse = energy_departure(form, 1e-3, 2e-6), fine = energy_departure(form, 1e-3, 1e-6);
    findings.at_most(fmt::format("departure of the energy, dt = 1 us, {}", name_of(form)), "1", 0.02, fine.worst,
                     "elastic bonds");
    findings.absolute(fmt::format("departure at 2 us over that at 1 us, {}", name_of(form)), "1", 4.0,
                      coarse.worst / fine.worst, 0.6, "leapfrog is of second order");
    findings.at_most(fmt::format("least share of motion in the energy, {}", name_of(form)), "1", 0.6,
                     fine.least_kinetic, "a vibration passes its energy to and fro");
  }
}

}  // namespace dem::verify
