// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "dem4grm/engine/stiffest_mode.hpp"
#include "dem4grm/lab/direct_shear.hpp"
#include "dem4grm/verify/cases.hpp"
#include "dem4grm/verify/growth.hpp"
#include "dem4grm/verify/scenes.hpp"

namespace dem {

namespace {

using namespace verify;

// ---- one grain, of which only the bonds have stiffness

void check_grain(Findings& findings) {
  struct Study {
    double damping = 0.0;
    bool linear_spring = false;
    double kappa = 4.0, limit = 0.0;  // us
  };
  constexpr std::array studies{Study{0.0, false, 4.0, 6.62}, Study{0.25, false, 4.0, 5.53},
                               Study{0.0, true, 4.0, 5.76},  Study{0.25, true, 4.0, 4.55},
                               Study{0.0, false, 1.0, 3.75}, Study{0.0, false, 8.0, 7.52}};
  for (const Study& study : studies) {
    Scene scene = model_scene();
    scene.rubber_ball_radius = 0.65e-3;
    scene.grains = {{{0, 0, 0}, {}}};
    scene.rubber.shear_modulus = 1.0;
    scene.bond.damping_ratio = study.damping;
    scene.bond.linear_spring = study.linear_spring;
    scene.bond.stiffness_ratio = study.kappa;
    findings.relative(fmt::format("limit of a grain, b = {}, kappa = {}{}", study.damping, study.kappa,
                                  study.linear_spring ? ", linear springs" : ""),
                      "s", study.limit * 1e-6, stable_time_step(Simulation(scene), study.limit * 1e-6), 5e-3,
                      "separate eigenvalue study, three digits");
  }
}

// ---- a row of spheres between soft walls: contacts between clumps

constexpr int k_row = 12;
constexpr double k_radius = 2.5e-3, k_overlap = 20e-6;        // m
constexpr double k_between = 6.060915e6, k_shear = 0.823529;  // gravel on gravel: N/m^1.5, k_s / k_n

/// Twelve spheres in a row, pressed together, nothing else.
Simulation pressed_row(bool dashpots) {
  Scene scene = model_scene();
  if (dashpots) scene.contact.normal_damping_ratio = scene.contact.shear_damping_ratio = 0.2;
  for (int k = 0; k < k_row; ++k) add_sphere(scene, {k * (2.0 * k_radius - k_overlap), 0, 0}, k_radius);
  Simulation s(scene);
  s.set_time_step(1e-9);
  s.step();
  return s;
}

/// Limit of the row, s. Its stiffest motion slides all contacts at once: spheres turn alike and swing against each other.
/// Between the gaps of contacts a and b act 2 (1/m + l^2/I) for a = b and l^2/I - 1/m for neighbours, which share a
/// sphere; the largest eigenvalue of that band of N - 1 contacts is 2 (1/m + l^2/I) + 2 (l^2/I - 1/m) cos(pi/N).
double row_limit(bool dashpots) {
  const double mass = 4.0 / 3.0 * k_pi * k_radius * k_radius * k_radius * 2710.0;
  const double lever = k_radius - 0.5 * k_overlap, spin = lever * lever / (0.4 * mass * k_radius * k_radius);
  const double chain = 2.0 * (1.0 / mass + spin) + 2.0 * (spin - 1.0 / mass) * std::cos(k_pi / k_row);
  const double k = k_shear * 1.5 * k_between * std::sqrt(k_overlap);
  const double c = dashpots ? 2.0 * 0.2 * std::sqrt(0.5 * mass * k) : 0.0;
  return (-c * chain + std::sqrt(c * c * chain * chain + 4.0 * k * chain)) / (k * chain);
}

void check_row(Findings& findings) {
  for (const bool dashpots : {false, true}) {
    const double expected = row_limit(dashpots);
    findings.relative(fmt::format("limit of a row of spheres{}", dashpots ? ", dashpots of 0.2" : ""), "s", expected,
                      stable_time_step(pressed_row(dashpots), expected), 1e-4,
                      "band matrix of the gaps, Mindlin stiffness at the lever");
  }
}

// ---- a specimen

/// A mixture at 100 kPa in a box of 30 mm.
Simulation small_specimen(double rubber_content) {
  DirectShearCase test;
  test.specimen.rubber_content = rubber_content;
  test.specimen.preparation_friction = 0.3;
  test.specimen.gravel_grading = {{3.4e-3, 0.0}, {5.0e-3, 1.0}};
  test.specimen.rubber_grading = {{3.65e-3, 0.0}, {3.75e-3, 1.0}};
  test.box.length = test.box.width = 0.030;
  test.box.height = 0.024;
  test.box.upper_height = 0.045;
  test.equilibrium.force_ratio = 2e-3;
  test.equilibrium.plate_speed = 1e-3;
  test.equilibrium.hold_steps = 500;
  test.shear.normal_stress = 100e3;
  return std::move(*prepare_specimen(specimen_order(test), {}).simulation);
}

/// Nothing slides, nothing damps, no wall moves: what is left is the assembly of springs that the limit speaks of.
double growth_of_specimen(const Simulation& specimen, double time_step) {
  Simulation s = specimen;
  s.scene.integration.local_damping = 0.0;
  s.servo.wall = -1;
  FrictionTable rough;
  for (auto& row : rough.between_grains) row.fill(1e3);
  rough.against_walls.fill(1e3);
  for (Wall& wall : s.walls) wall.friction = 1e3, wall.velocity = {};
  s.set_friction(rough);
  s.reset_velocities();
  RandomVectors random(5);
  constexpr double k_speed = 1e-3;  // m/s, above what is left of unbalanced forces
  for (std::size_t c = 0; c < s.clumps.clumps.size(); ++c) set_motion(s, c, random(k_speed), random(1e3 * k_speed));
  for (int id = 0; id < s.balls.n_rubber_balls(); ++id) {
    s.balls.set_velocity(s.balls.index_of_id(id), random(k_speed));
    s.balls.set_spin(s.balls.index_of_id(id), random(1e3 * k_speed));
  }
  s.set_time_step(time_step);
  return largest_growth(s, 4000, 1e3);
}

void check_specimen(Findings& findings) {
  for (const double rubber_content : {0.0, 0.3}) {
    const Simulation s = small_specimen(rubber_content);
    const double limit = stable_time_step(s, s.dt / 0.8);
    for (const double fraction : {0.95, 1.05}) {
      hold_growth(findings, fmt::format("specimen with VRC {}", rubber_content), fraction,
                  growth_of_specimen(s, fraction * limit), 1e3);
    }
  }
}

constexpr const char* k_text = R"(During a test the time step follows the stiffest mode of the whole assembly in its
present contacts, found with thirty products of a Lanczos iteration. It must give the limits of a free grain (a separate
study of its 210 unknowns, as above) and of a row of N pressed spheres whose contacts all slide at once, k_s times
2 (1/m + l^2/I) + 2 (l^2/I - 1/m) cos(pi/N) with the lever l of the contact, with and without dashpots.

Then specimens of gravel and of a mixture with 30 % rubber at 100 kPa, as prepared for a test: with all sliding and damping
taken away and
a little random motion, the engine must neither gain energy at 0.95 of the limit nor keep it at 1.05. So every stiffness
that acts in the engine is in the limit, and none twice.)";

void check(Findings& findings) {
  check_grain(findings);
  check_row(findings);
  check_specimen(findings);
}

}  // namespace

void add_assembly_limit_cases(std::vector<VerificationCase>& cases) {
  cases.push_back({"time-step-of-state", "The largest stable time step of a specimen", k_text, Extent::quick, check});
}

}  // namespace dem
