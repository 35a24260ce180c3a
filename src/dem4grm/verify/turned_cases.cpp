// SPDX-License-Identifier: BSD-3-Clause
// A loaded contact that turns as a whole, twists or rolls: its forces turn along and no work is done.
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "dem4grm/verify/impact_scenes.hpp"
#include "dem4grm/verify/led_contact.hpp"

namespace dem::verify {
namespace {

constexpr double k_radius = 2.5e-3, k_small_radius = 1.25e-3, k_overlap = 20e-6;  // m
constexpr int k_turn_steps = 7200;

/// Turn by the angle (rad) about the unit axis, from the definition.
Quaternion turn_about(const Vec3& axis, double angle) {
  const double sine = std::sin(0.5 * angle);
  return {std::cos(0.5 * angle), axis.x * sine, axis.y * sine, axis.z * sine};
}

/// Gravel on smaller gravel, or on a wall, with a shear force of about a fifth of what would slip.
Simulation loaded_contact(bool at_wall) {
  Simulation s = led_pair(model_scene(), {k_gravel, k_gravel, k_radius, at_wall ? 0.0 : k_small_radius, k_overlap});
  for (int k = 0; k < 10; ++k) move_clump(s, 0, {0, 0.15e-6, -0.1e-6});
  settle(s);
  return s;
}

/// Change of the forces in the turning frame over the start, and work done.
struct TurnResult {
  double force = 0.0, shear = 0.0;  ///< largest, over the forces at the start
  double work = 0.0;                ///< over the shear force times the circumference of the pair
  double slip_work = 0.0;           ///< J
};

Vec3 couple_of(const Simulation& s, std::size_t row) { return s.contacts.couple(row); }

TurnResult turn_pair(const Vec3& direction) {
  Simulation s = loaded_contact(false);
  const std::size_t row = only_row(s);
  const Vec3 axis = direction * (1.0 / norm(direction)), force = s.contacts.force(row), shear = s.contacts.shear(row);
  const Vec3 start[2] = {clump(s, 0).position, clump(s, 1).position};
  const double angle = 2 * k_pi / k_turn_steps, levers = s.contacts.lever_i(row) + s.contacts.lever_j(row);
  const double slip_before = s.ledger.contact_slip;
  Vec3 last_force = force, last_couple = couple_of(s, row), last_move;
  TurnResult out;
  for (int k = 0; k <= k_turn_steps; ++k) {
    Vec3 move[2];
    for (std::size_t c = 0; c < 2; ++c) {
      move[c] = rotate(turn_about(axis, (k + 1) * angle), start[c]) - clump(s, c).position;
      lead(s, c, move[c] * (1.0 / s.time_step()), spin_for(s, axis, angle));
    }
    s.step();  // forces where the step before led to
    const Quaternion q = turn_about(axis, k * angle);
    const Vec3 f = s.contacts.force(row), couple = couple_of(s, row);
    out.force = std::max(out.force, norm(f - rotate(q, force)) / norm(force));
    out.shear = std::max(out.shear, norm(s.contacts.shear(row) - rotate(q, shear)) / norm(shear));
    // Forces of both ends of a step on the way between them.
    if (k > 0) out.work += 0.5 * (dot(f + last_force, last_move) + dot(couple + last_couple, axis) * levers * angle);
    last_force = f;
    last_couple = couple;
    last_move = move[0] - move[1];
  }
  out.work /= norm(shear) * levers * 2 * k_pi;
  out.slip_work = s.ledger.contact_slip - slip_before;
  return out;
}

void turned_pair(Findings& f) {
  const char* rigid = "a rigid motion changes no force in its own frame";
  for (const auto& [name, axis] : {std::pair{"about the normal", Vec3{1, 0, 0}},
                                   {"about y", Vec3{0, 1, 0}},
                                   {"about z", Vec3{0, 0, 1}},
                                   {"about (1, 2, -1)", Vec3{1, 2, -1}}}) {
    const TurnResult got = turn_pair(axis);
    const std::string text = fmt::format("full turn {}", name);
    f.absolute(text + ": change of the force, over the force", "1", 0.0, got.force, 1e-10, rigid);
    f.absolute(text + ": change of the shear force, over the shear force", "1", 0.0, got.shear, 1e-10, rigid);
    f.absolute(text + ": work done, over shear force times circumference", "1", 0.0, got.work, 1e-6, rigid);
    f.absolute(text + ": slip", "J", 0.0, got.slip_work, 0.0, rigid);
  }
  f.remark(
      "The work is summed by the trapezium rule over steps of a twentieth of a degree, which leaves 1e-7 of the shear "
      "force times the way.");
}

/// Spins the spheres about axes through their centres for so many turns of sphere 0, each step by the same angle;
/// `partner` times that for sphere 1. Returns the shear force.
Vec3 spun(Simulation& s, const Vec3& axis, double turns, double partner, const Vec3& velocity_per_spin = {}) {
  const double angle = 2 * k_pi * turns / k_turn_steps;
  for (int k = 0; k < k_turn_steps; ++k) {
    hold_all(s);
    const Vec3 spin = spin_for(s, axis, angle);
    lead(s, 0, velocity_per_spin * norm(spin), spin);
    if (s.walls.empty()) lead(s, 1, {}, spin * partner);
    s.step();
  }
  settle(s);
  return s.contacts.shear(only_row(s));
}

void check_twist(Findings& f, const std::string& name, bool at_wall, double partner, double expected_angle) {
  Simulation s = loaded_contact(at_wall);
  const Vec3 branch = at_wall ? Vec3{1, 0, 0} : clump(s, 1).position - clump(s, 0).position;
  const Vec3 normal = branch * (1.0 / norm(branch)), before = s.contacts.shear(only_row(s));
  const Vec3 after = spun(s, normal, 0.4, partner), expected = rotate(turn_about(normal, expected_angle), before);
  f.absolute(name + ": change of the shear force in the frame of the mean spin, over it", "1", 0.0,
             norm(after - expected) / norm(before), 1e-6, "shear force turns by the mean of both bodies' turns");
}

void check_rolling(Findings& f) {
  // The sphere rolls along +y on the wall at +x: its contact point stands still when v = lever x spin.
  Simulation s = loaded_contact(true);
  const Vec3 before = s.contacts.shear(only_row(s));
  const double lever = k_radius - 0.5 * k_overlap;
  const Vec3 rolled = spun(s, {0, 0, -1}, 0.2, 0.0, {0, lever, 0});
  f.absolute("sphere rolled along a wall by 3 mm: change of the shear force, over it", "1", 0.0,
             norm(rolled - before) / norm(before), 1e-6, "no slip at the middle of the overlap");
  // Two spheres turn like gears: the contact point moves with both.
  Simulation gears = loaded_contact(false);
  const Vec3 start = gears.contacts.shear(only_row(gears));
  const Vec3 branch = clump(gears, 1).position - clump(gears, 0).position;
  const Vec3 axis = cross(branch, {0, 1, 0}) * (1.0 / norm(cross(branch, {0, 1, 0})));
  const double overlap = k_radius + k_small_radius - norm(branch);
  const double ratio = -(k_radius - 0.5 * overlap) / (k_small_radius - 0.5 * overlap);
  const Vec3 turned = spun(gears, axis, 0.2, ratio);
  f.absolute("spheres turned like gears by 0.2 turns: change of the shear force, over it", "1", 0.0,
             norm(turned - start) / norm(start), 1e-6, "no slip at the middle of the overlap");
}

void twisted_and_rolled(Findings& f) {
  check_twist(f, "both spheres spun by 144 deg about the normal", false, 1.0, 0.8 * k_pi);
  check_twist(f, "one sphere of a pair spun by 144 deg about the normal", false, 0.0, 0.4 * k_pi);
  check_twist(f, "spheres spun by 144 deg against each other", false, -1.0, 0.0);
  check_twist(f, "sphere on a wall spun by 144 deg about the normal", true, 0.0, 0.4 * k_pi);
  check_rolling(f);
}

}  // namespace

void add_turned_cases(std::vector<VerificationCase>& cases) {
  cases.push_back(
      {"contact-objectivity", "Rigid turn of a loaded contact",
       "Two gravel spheres of 2.5 and 1.25 mm overlap by 20 um and are loaded in shear. The pair is led "
       "through a full turn as one rigid body, in 7200 steps of the engine, about the normal, across it and "
       "askew. Force and shear force must turn along to rounding, no slip may be booked, and the forces of "
       "both contact partners with their couples may do no net work: that fails when the lever arms do not "
       "add up to the distance of the centres.",
       Extent::quick, turned_pair});
  cases.push_back({"twist-and-rolling", "Twist and rolling of a loaded contact",
                   "The shear force of a contact turns about the normal by the mean of the turns of its two bodies (a "
                   "wall does not turn), and no shear arises where the middle of the overlap does not slide: a sphere "
                   "rolls along a wall with v = (R - d/2) w, two unequal spheres turn like gears with w1 (R1 - d/2) = "
                   "-w2 (R2 - d/2).",
                   Extent::quick, twisted_and_rolled});
}

}  // namespace dem::verify
