// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <cmath>

#include "dem4grm/engine/time_step.hpp"
#include "dem4grm/verify/cases.hpp"
#include "dem4grm/verify/driven_grain.hpp"
#include "dem4grm/verify/growth.hpp"

namespace dem {

namespace {

using namespace verify;

const char* name_of(BondForm form) { return form == BondForm::incremental ? "incremental" : "history-free"; }

/// A grain of which only the bonds have stiffness: 0.65 mm, contacts of 1 Pa.
Scene bonded_scene(double damping, bool linear_spring, double kappa = 4.0) {
  Scene s = model_scene();
  s.rubber_ball_radius = 0.65e-3;
  s.grains = {{{0, 0, 0}, {}}};
  s.rubber.shear_modulus = 1.0;
  s.bond.damping_ratio = damping;
  s.bond.linear_spring = linear_spring;
  s.bond.stiffness_ratio = kappa;
  return s;
}

/// Grain with all contacts that the limit counts on.
Scene loaded_scene(double radius) {
  Scene s = model_scene();
  s.rubber_ball_radius = radius;
  s.grains = {{{0, 0, 0}, {}}};
  s.contact.normal_damping_ratio = 0.25;
  return s;
}

void hold_limit(Findings& findings, const std::string& what, const TimeStepLimit& limit, double expected_us) {
  findings.relative(what, "s", expected_us * 1e-6, limit.seconds, 3e-3, "separate eigenvalue study, three digits");
}

void check_limits(Findings& findings) {
  hold_limit(findings, "limit, bonds", loaded_grain_limit(bonded_scene(0.0, false)), 6.62);
  hold_limit(findings, "limit, bonds with dashpots 0.25", loaded_grain_limit(bonded_scene(0.25, false)), 5.53);
  hold_limit(findings, "limit, bonds and linear springs", loaded_grain_limit(bonded_scene(0.0, true)), 5.76);
  hold_limit(findings, "limit, bonds, springs, dashpots", loaded_grain_limit(bonded_scene(0.25, true)), 4.55);
  for (const auto& [kappa, expected] : {std::pair{1.0, 3.75}, {2.0, 5.12}, {8.0, 7.52}}) {
    hold_limit(findings, fmt::format("limit, bonds, kappa = {}", kappa),
               loaded_grain_limit(bonded_scene(0.0, false, kappa)), expected);
  }
  for (const auto& [radius, expected] : {std::pair{0.65e-3, 3.92}, {0.627e-3, 3.78}, {0.40e-3, 2.41}}) {
    hold_limit(findings, fmt::format("limit, everything, r = {} mm", radius * 1e3),
               loaded_grain_limit(loaded_scene(radius)), expected);
  }
  findings.relative("diagonal estimate, bonds", "s", 2.78e-6 / 0.8,
                    diagonal_grain_limit(bonded_scene(0.0, false)).seconds, 3e-3,
                    "separate eigenvalue study, three digits");
  Scene chosen = loaded_scene(0.65e-3);
  chosen.integration.time_step_safety = 0.8;
  findings.absolute("chosen time step, safety 0.8", "s", 0.8 * 3.92e-6,
                    choose_time_step(Simulation(chosen), 0.0).seconds, 0.01e-6,
                    "separate eigenvalue study, three digits");
}

/// Random velocities of +-speed (m/s) and spins of +-speed / 1 mm.
void shake_grain(Simulation& s, double speed) {
  RandomVectors draw(3);
  for (int slot = 0; slot < k_grain_balls; ++slot) {
    s.balls.set_velocity(BallStore::rubber_index(0, slot), draw(speed));
    s.balls.set_spin(BallStore::rubber_index(0, slot), draw(1e3 * speed));
  }
}

double grain_growth(BondForm form, double damping, double fraction, int steps) {
  Scene scene = bonded_scene(damping, false);
  scene.bond.form = form;
  Simulation s(scene);
  shake_grain(s, 1e-6);
  s.set_time_step(fraction * loaded_grain_limit(scene).seconds);
  return largest_growth(s, steps);
}

void check_grain_border(Findings& findings, int steps, double above) {
  for (const BondForm form : {BondForm::history_free, BondForm::incremental}) {
    for (const double damping : {0.0, 0.25}) {
      const std::string what = fmt::format("grain, b = {}, {}", damping, name_of(form));
      for (const double fraction : {0.95, above}) {
        hold_growth(findings, what, fraction, grain_growth(form, damping, fraction, steps));
      }
    }
  }
}

// ---- clumps

constexpr int k_side = 8;
constexpr double k_sphere = 2.5e-3, k_overlap = 20e-6;  // m
// Gravel on gravel at 2.5 mm: effective modulus, Pa, and Hertz constant, N/m^1.5.
constexpr double k_modulus = 128.5714e6, k_between = 6.060915e6, k_shear_ratio = 0.823529;

/// A square layer of spheres that press on each other and on smooth walls with one and the same force. The walls are so
/// soft that their Hertz constant is an eighth of k_between and their stiffness a quarter: they limit nothing.
Simulation pressed_layer() {
  Scene scene = model_scene();
  scene.walls.shear_modulus = 0.5 * (1.0 - 0.25) / (8.0 * std::sqrt(2.0) / k_modulus - 0.7 / 180e6);
  const double at_wall = 4.0 * k_overlap, pitch = 2.0 * k_sphere - k_overlap;
  const double side = (k_side - 1) * pitch + 2.0 * (k_sphere - at_wall), height = 2.0 * (k_sphere - 0.25 * at_wall);
  scene.wall_list = closed_box({side, side, height});
  const double first = k_sphere - at_wall;
  for (int y = 0; y < k_side; ++y) {
    for (int x = 0; x < k_side; ++x) add_sphere(scene, {first + x * pitch, first + y * pitch, 0.5 * height}, k_sphere);
  }
  Simulation s(scene);
  s.set_time_step(1e-8);
  s.step();
  return s;
}

/// The stiffest own motion of a sphere inside is the turn against its four neighbours: 4 k_s l^2 / (0.4 m r^2); when
/// all turn alike, every contact slides twice as much, which is the bound.
double layer_limit() {
  const double shear = k_shear_ratio * 1.5 * k_between * std::sqrt(k_overlap), lever = k_sphere - 0.5 * k_overlap;
  const double mass = 4.0 / 3.0 * k_pi * k_sphere * k_sphere * k_sphere * 2710.0;
  return 2.0 / std::sqrt(2.0 * 4.0 * shear * lever * lever / (0.4 * mass * k_sphere * k_sphere));
}

double layer_growth(double time_step, int steps) {
  Simulation s = pressed_layer();
  RandomVectors draw(4);
  for (std::size_t c = 0; c < s.clumps.clumps.size(); ++c) set_motion(s, c, draw(1e-7), draw(1e-4));
  s.set_time_step(time_step);
  return largest_growth(s, steps);
}

void check_clump_limit(Findings& findings) {
  findings.relative("limit of a pressed layer of spheres", "s", layer_limit(), clump_limit(pressed_layer()).seconds,
                    1e-4, "Hertz-Mindlin stiffness, all spheres turning alike");
}

void check_layer_border(Findings& findings, int steps, double above) {
  const double bound = clump_limit(pressed_layer()).seconds;
  hold_growth(findings, "layer of spheres", 0.95, layer_growth(0.95 * bound, steps));
  hold_growth(findings, "layer of spheres", above, layer_growth(above * bound, steps));
}

// ---- cases

constexpr const char* k_limit = R"(The leapfrog scheme with explicit dashpots is stable while the largest eigenvalue of
M^-1 (dt^2 K + 2 dt C) stays below 4. The limits that `choose_time_step` starts from are held against a separate study of
all 210 unknowns of the grain (r = 0.65 mm, 1610 kg/m3, E = 20 MPa): bonds, bonds with normal dashpots, with linear springs, several
ratios kappa, and with second neighbours and outer contacts pressed together and dashpots of 0.25. The usual estimate
from the diagonal, 0.8 sqrt(m/k), is about half.

Then the engine itself: a free grain with small random motion must neither gain energy at 0.95 of the limit nor keep it at 1.02,
over 4000 steps. The bond springs alone make this the limit of the grain, not only a bound.

For clumps the limit is a bound, twice the stiffness of each body in its own contacts. It is reached by a layer of 8 x 8
equal spheres that press on each other: all turning alike, every contact slides twice as much. Soft smooth walls
around hold it; the border of the layer itself lies less than 2 % above, sqrt(4 / (2 + 2 cos(pi/8))), so the engine is tried at 0.95 and 1.1.)";

constexpr const char* k_long = R"(The same grains and the same layer of spheres over 100 000 steps, at 0.95 and 1.1 of
the limit. Nothing damps the grain with b = 0 nor the spheres, so that a slow growth would show.)";

void check_time_step(Findings& findings) {
  check_limits(findings);
  check_grain_border(findings, 4000, 1.02);
  check_clump_limit(findings);
  check_layer_border(findings, 4000, 1.1);
}

void check_long_runs(Findings& findings) {
  check_grain_border(findings, 100000, 1.1);
  check_layer_border(findings, 100000, 1.1);
}

}  // namespace

void add_stability_cases(std::vector<VerificationCase>& cases) {
  cases.push_back({"time-step-limit", "The largest stable time step", k_limit, Extent::quick, check_time_step});
  cases.push_back({"time-step-long", "Stable over a hundred thousand steps", k_long, Extent::full, check_long_runs});
}

}  // namespace dem
