// SPDX-License-Identifier: BSD-3-Clause
// Bonds in motion: decay of an oscillation, rigid turns, and a closed path of the bond's axis.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "dem4grm/core/random.hpp"
#include "dem4grm/verify/bond_checks.hpp"
#include "dem4grm/verify/driven_grain.hpp"

namespace dem::verify {

namespace {

constexpr double k_radius = 0.63e-3;  // m, of model_scene
const Vec3 k_along = Vec3{1, 1, 1} * (1.0 / std::sqrt(3.0));
const Vec3 k_across = Vec3{1, -1, 0} * (1.0 / std::sqrt(2.0));

const char* name_of(BondForm form) { return form == BondForm::incremental ? "incremental" : "history-free"; }

/// Speed of separation when the bond passes its rest length, and the time since the last passage.
struct Passage {
  double speed, duration;
};

/// A pair that is pushed apart: two free balls (incremental), or the vertex ball against a grain that is held
/// (history-free). The passages through the rest length, the start counted as the first.
struct Oscillation {
  std::vector<Passage> passages;
  double lost = 0.0;  ///< J, the engine's account of the dashpot
};

Oscillation oscillate(const BondSettings& bond, double dt, int steps) {
  const bool is_free_pair = bond.form == BondForm::incremental;
  Simulation s(lone_grain_scene(bond));
  if (is_free_pair) keep_only_diagonal(s, 0, 1);
  s.set_time_step(dt);
  const int tip = BallStore::rubber_index(0, is_free_pair ? 0 : 26),
            root = BallStore::rubber_index(0, is_free_pair ? 27 : 34);
  std::vector<OutsideLoad> held;
  for (int slot = 0; slot < k_grain_balls; ++slot) {
    const int i = BallStore::rubber_index(0, slot);
    if (!is_free_pair && i != tip) held.push_back({i, {}, {}, true});
  }
  const auto stretch = [&] { return norm(s.balls.position(tip) - s.balls.position(root)) - 2.0 * k_radius; };
  const auto speed = [&] {
    return dot(s.balls.velocity(tip) - s.balls.velocity(root), k_along) * (is_free_pair ? -1.0 : 1.0);
  };
  const double start = 1e-3;  // m/s
  s.balls.set_velocity(tip, k_along * (is_free_pair ? -start : start));
  if (is_free_pair) s.balls.set_velocity(root, {});
  Oscillation out;
  out.passages.push_back({start, 0.0});
  double before = 0.0, passed = -0.5 * dt;  // a velocity belongs to the middle of its step
  for (int k = 0; k < steps && out.passages.size() < 3; ++k) {
    step_with_loads(s, held, 1.0);
    const double now = stretch();
    if (before * now < 0.0) {
      const double at = s.time - dt * now / (now - before);
      out.passages.push_back({std::fabs(speed()), at - passed});
      passed = at;
    } else if (k == 0) {
      passed = 0.0;
    }
    before = now;
  }
  out.lost = s.energy().dashpot;
  return out;
}

void check_decay(Findings& findings, BondSettings bond) {
  const double mass = 1610.0 * 4.0 / 3.0 * k_pi * k_radius * k_radius * k_radius;
  const bool is_pair = bond.form == BondForm::incremental;
  const double moving = is_pair ? 0.5 * mass : mass;
  const double beside = bond.modulus * k_pi * k_radius / 2.0;
  const double axial = beside * bond.radius_multiplier * bond.radius_multiplier;
  const double dashpot = 2.0 * bond.damping_ratio * std::sqrt(0.5 * mass * beside);
  const double dt = 1e-3 / std::sqrt(axial / moving);
  const Oscillation found = oscillate(bond, dt, 20000);
  const std::string setting = fmt::format("b = {}, lambda = {}, linear spring {}, {}", bond.damping_ratio,
                                          bond.radius_multiplier, bond.linear_spring ? "on" : "off",
                                          is_pair ? "two free balls, incremental" : "one ball held, history-free");
  for (std::size_t k = 1; k < 3; ++k) {
    const bool is_squeezed = k == 2;
    const double stiffness = axial + (is_squeezed && bond.linear_spring ? beside : 0.0);
    const double damping = dashpot / (2.0 * std::sqrt(moving * stiffness));
    const double frequency = std::sqrt(stiffness / moving * (1.0 - damping * damping));
    const char* half = is_squeezed ? "squeezed" : "stretched";
    if (found.passages.size() <= k) {
      findings.at_least("passages through the rest length, " + setting, "1", 3,
                        static_cast<double>(found.passages.size()), "swing");
      return;
    }
    const Passage &a = found.passages[k - 1], &b = found.passages[k];
    findings.relative(fmt::format("duration of the {} half, {}", half, setting), "s", k_pi / frequency, b.duration,
                      2e-3, "damped oscillator");
    findings.relative(fmt::format("speed kept over the {} half, {}", half, setting), "1",
                      std::exp(-k_pi * damping / std::sqrt(1.0 - damping * damping)), b.speed / a.speed, 3e-3,
                      "damped oscillator");
  }
}

/// A slide of the bond has no dashpot: with the largest ratio, the account stays empty.
void check_no_shear_dashpot(Findings& findings) {
  BondSettings bond;
  bond.damping_ratio = 1.0;
  bond.linear_spring = false;
  for (const BondForm form : {BondForm::history_free, BondForm::incremental}) {
    bond.form = form;
    LedGrain g(lone_grain_scene(bond));
    const double slide = 1e-4 * k_radius;
    g.lead(26, g.position(26) + k_across * slide, {});
    const BallLoad load = g.loads()[26];
    const double stiffness = bond.modulus * k_pi * k_radius / 2.0 / bond.stiffness_ratio;
    findings.relative(fmt::format("force against a slide at 63 mm/s, b = 1, {}", name_of(form)), "N",
                      -stiffness * slide, dot(load.force, k_across), 1e-3, "k_s alone: only the normal has a dashpot");
  }
}

// ---- rigid turns

Vec3 draw(RandomSequence& random, double size) {
  return {random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)};
}

/// A grain whose balls are all moved by up to 0.05 r and turned by up to 0.1 rad.
LedGrain strained_grain(BondForm form) {
  BondSettings bond;
  bond.form = form;
  bond.damping_ratio = 0.0;
  LedGrain g(lone_grain_scene(bond));
  RandomSequence random(1, RandomStream::test, 7);
  std::array<Vec3, k_grain_balls> move, turn;
  for (std::size_t k = 0; k < k_grain_balls; ++k) {
    move[k] = draw(random, 0.05 * k_radius);
    turn[k] = draw(random, 0.1);
  }
  constexpr int n = 50;
  for (int k = 0; k < n; ++k) {
    for (int slot = 0; slot < k_grain_balls; ++slot) {
      const auto b = static_cast<std::size_t>(slot);
      g.lead(slot, g.position(slot) + move[b] * (1.0 / n), turn[b] * (1.0 / n));
    }
    g.loads();
  }
  return g;
}

/// Spin step whose Cayley turn is the given angle.
Vec3 turn_step(const Vec3& axis, double angle) { return axis * (2.0 * std::tan(0.5 * angle) / norm(axis)); }

struct TurnErrors {
  double force = 0.0, torque = 0.0, imbalance = 0.0;
};

/// Turns the strained grain once about the axis and compares the load on every ball with the turned one of the start.
TurnErrors turn_once(BondForm form, const Vec3& axis) {
  LedGrain g = strained_grain(form);
  const std::array<BallLoad, k_grain_balls> start = g.loads();
  std::array<Vec3, k_grain_balls> place;
  double force = 0.0, torque = 0.0;
  for (int slot = 0; slot < k_grain_balls; ++slot) {
    const auto k = static_cast<std::size_t>(slot);
    place[k] = g.position(slot);
    force = std::max(force, norm(start[k].force));
    torque = std::max(torque, norm(start[k].torque));
  }
  constexpr int n = 360;
  const Vec3 step = turn_step(axis, 2.0 * k_pi / n);
  Quaternion q;
  TurnErrors worst;
  for (int k = 0; k < n; ++k) {
    q = turned(q, step, 1.0);
    for (int slot = 0; slot < k_grain_balls; ++slot)
      g.lead(slot, rotate(q, place[static_cast<std::size_t>(slot)]), step);
    const std::array<BallLoad, k_grain_balls> now = g.loads();
    Vec3 total, couple;
    for (int slot = 0; slot < k_grain_balls; ++slot) {
      const auto b = static_cast<std::size_t>(slot);
      worst.force = std::max(worst.force, norm(now[b].force - rotate(q, start[b].force)) / force);
      worst.torque = std::max(worst.torque, norm(now[b].torque - rotate(q, start[b].torque)) / torque);
      total += now[b].force;
      couple += cross(g.position(slot), now[b].force) + now[b].torque;
    }
    worst.imbalance = std::max({worst.imbalance, norm(total) / force, norm(couple) / (force * k_radius)});
  }
  return worst;
}

// ---- a closed path

/// Stored shear and moment of bond 63 before and after its axis has been led once around a cone of that half angle;
/// the vertex ball does not turn meanwhile.
struct ClosedPath {
  BondReading before, after;
};

ClosedPath around_cone(BondForm form, double half_angle) {
  BondSettings bond;
  bond.form = form;
  bond.damping_ratio = 0.0;
  LedGrain g(lone_grain_scene(bond));
  // Straight out to the rim of the cone, a bend, and once around.
  const Vec3 centre = g.position(34), third = cross(k_along, k_across);
  const auto axis_at = [&](double tilt, double around) {
    return k_along * std::cos(tilt) + (k_across * std::cos(around) + third * std::sin(around)) * std::sin(tilt);
  };
  constexpr int n = 2000;
  for (int k = 1; k <= 50; ++k) {
    g.lead(26, centre + axis_at(half_angle * k / 50, 0.0) * (2.0 * k_radius),
           axis_at(half_angle, 0.5 * k_pi) * (0.2 / 50));
    g.loads();
  }
  ClosedPath out;
  out.before = read_bond(g.simulation(), 0, 63);
  for (int k = 1; k <= n; ++k) {
    g.lead(26, centre + axis_at(half_angle, 2.0 * k_pi * k / n) * (2.0 * k_radius), {});
    g.loads();
  }
  out.after = read_bond(g.simulation(), 0, 63);
  return out;
}

}  // namespace

void check_bond_dashpot(Findings& findings) {
  for (const BondForm form : {BondForm::history_free, BondForm::incremental}) {
    for (const double ratio : {0.0, 0.25, 0.5}) {
      BondSettings bond;
      bond.form = form;
      bond.damping_ratio = ratio;
      check_decay(findings, bond);
      if (ratio != 0.25) continue;
      bond.linear_spring = false;
      check_decay(findings, bond);
      bond.radius_multiplier = 0.8;
      check_decay(findings, bond);
    }
  }
  check_no_shear_dashpot(findings);
  const double mass = 1610.0 * 4.0 / 3.0 * k_pi * k_radius * k_radius * k_radius;
  for (const BondForm form : {BondForm::history_free, BondForm::incremental}) {
    BondSettings bond;
    bond.form = form;
    const Oscillation o = oscillate(bond, 1e-8, 20000);
    const double first = o.passages.front().speed, last = o.passages.back().speed;
    const double moving = form == BondForm::incremental ? 0.5 * mass : mass;
    findings.relative(fmt::format("energy that the dashpot took over one swing, b = 0.25, {}", name_of(form)), "J",
                      0.5 * moving * (first * first - last * last), o.lost, 5e-3, "balance of energy");
  }
}

void check_bond_turned(Findings& findings) {
  for (const BondForm form : {BondForm::history_free, BondForm::incremental}) {
    TurnErrors worst;
    for (const Vec3& axis : {Vec3{1, 0, 0}, Vec3{1, 1, 1}, Vec3{1, -2, 3}}) {
      const TurnErrors e = turn_once(form, axis);
      worst.force = std::max(worst.force, e.force);
      worst.torque = std::max(worst.torque, e.torque);
      worst.imbalance = std::max(worst.imbalance, e.imbalance);
    }
    const char* source = "a rigid turn strains nothing";
    findings.at_most(fmt::format("change of a force over one turn, {}", name_of(form)), "1", 1e-10, worst.force,
                     source);
    findings.at_most(fmt::format("change of a torque over one turn, {}", name_of(form)), "1", 1e-10, worst.torque,
                     source);
    findings.at_most(fmt::format("net force and net moment of a strained grain, {}", name_of(form)), "1", 1e-11,
                     worst.imbalance, "Newton's third law");
  }
}

void check_bond_closed_path(Findings& findings) {
  for (const double angle : {0.1, 0.2}) {
    const ClosedPath free = around_cone(BondForm::history_free, angle),
                     summed = around_cone(BondForm::incremental, angle);
    findings.at_most(fmt::format("moment not returned, cone of {} rad, history-free", angle), "1", 1e-10,
                     norm(free.after.moment - free.before.moment) / norm(free.before.moment), "function of the state");
    const Vec3 a = perpendicular(summed.before.moment, summed.before.normal),
               b = perpendicular(summed.after.moment, summed.after.normal);
    findings.relative(fmt::format("turn of the bending moment, cone of {} rad, incremental", angle), "rad",
                      2.0 * k_pi * (1.0 - std::cos(angle)),
                      std::atan2(dot(summed.before.normal, cross(a, b)), dot(a, b)), 1e-3,
                      "solid angle of the cone (Gauss-Bonnet)");
    findings.relative(fmt::format("size of the bending moment, cone of {} rad, incremental", angle), "1", 1.0,
                      norm(b) / norm(a), 1e-6, "carried by rotations");
  }
}

}  // namespace dem::verify
