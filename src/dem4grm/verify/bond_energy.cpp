// SPDX-License-Identifier: BSD-3-Clause
// One bond strained by hand: stored energy against work, and the strain at which it breaks.
#include <fmt/format.h>

#include <cmath>

#include "dem4grm/verify/bond_checks.hpp"
#include "dem4grm/verify/driven_grain.hpp"

namespace dem::verify {

namespace {

constexpr double k_radius = 0.63e-3;         // m, of model_scene
constexpr int k_vertex = 26, k_centre = 34;  // the vertex ball has one bond, number 63, to this centre
constexpr int k_bond = 63;

const Vec3 k_along = Vec3{1, 1, 1} * (1.0 / std::sqrt(3.0));
const Vec3 k_across = Vec3{1, -1, 0} * (1.0 / std::sqrt(2.0));

/// Motion of the vertex ball against its neighbour at rest: stretch and slide of the bond (m) and turn (rad).
struct Strain {
  Vec3 move, turn;
};

/// Leads the vertex ball by a strain and returns its displacement. With the ball, the bond's axis turns by half as
/// much: then a turn neither slides nor stretches the bond.
Vec3 strain_by(LedGrain& g, const Strain& d) {
  const Vec3 centre = g.position(k_centre), before = g.position(k_vertex);
  const Vec3 after = centre + rotate(turned({}, d.turn * 0.5, 1.0), before - centre) + d.move;
  g.lead(k_vertex, after, d.turn);
  return after - before;
}

/// Axial, shear, bending and twisting stiffness of a bond, and of the spring beside it, by beam theory.
struct Stiffness {
  double axial, shear, bending, twisting, beside;
  explicit Stiffness(const BondSettings& b) {
    const double bond_radius = b.radius_multiplier * k_radius, area = k_pi * bond_radius * bond_radius;
    const double second_moment = b.moment_scale * 0.25 * area * bond_radius * bond_radius, length = 2.0 * k_radius;
    axial = b.modulus * area / length;
    shear = axial / b.stiffness_ratio;
    bending = b.modulus * second_moment / length;
    twisting = b.modulus / b.stiffness_ratio * 2.0 * second_moment / length;
    beside = b.linear_spring ? b.modulus * k_pi * k_radius * k_radius / length : 0.0;
  }
};

struct Energies {
  double stored = 0.0, work = 0.0;
};

/// Strains the bond in equal steps; work is the sum of mean load times step.
Energies strain_slowly(const BondSettings& bond, const Strain& total) {
  constexpr int n = 50;
  LedGrain g(lone_grain_scene(bond));
  Energies out;
  const Strain step{total.move * (1.0 / n), total.turn * (1.0 / n)};
  BallLoad before;
  for (int k = 0; k < n; ++k) {
    const Vec3 moved = strain_by(g, step);
    const BallLoad now = g.loads()[k_vertex];
    out.work -= 0.5 * (dot(now.force + before.force, moved) + dot(now.torque + before.torque, step.turn));
    before = now;
  }
  out.stored = g.simulation().energy().bond_strain;
  return out;
}

struct Mode {
  const char* name;
  Strain strain;
  double expected;
};

void check_modes(Findings& findings, const std::string& setting, const BondSettings& bond) {
  const double move = 1e-4 * k_radius, turn = 1e-4;
  const Stiffness k(bond);
  const Mode modes[] = {
      {"stretch", {k_along * move, {}}, 0.5 * k.axial * move * move},
      {"shortening", {k_along * -move, {}}, 0.5 * (k.axial + k.beside) * move * move},
      {"shear", {k_across * move, {}}, 0.5 * k.shear * move * move},
      {"bending", {{}, k_across * turn}, 0.5 * k.bending * turn * turn},
      {"twist", {{}, k_along * turn}, 0.5 * k.twisting * turn * turn},
  };
  for (const Mode& m : modes) {
    const Energies e = strain_slowly(bond, m.strain);
    const std::string what = fmt::format("{}, {}", m.name, setting);
    findings.relative("stored energy of " + what, "J", m.expected, e.stored, 1e-5, "1/2 k e^2, beam theory");
    findings.relative("work of " + what, "J", m.expected, e.work, 1e-5, "1/2 k e^2, beam theory");
  }
}

BondSettings other_bond() {
  BondSettings b;
  b.modulus = 35e6;
  b.stiffness_ratio = 2.5;
  b.radius_multiplier = 0.8;
  b.moment_scale = 0.6;
  return b;
}

// ---- strength

constexpr double k_tensile = 60e3, k_shear = 25e3;  // Pa
constexpr int k_steps = 4000;                       // to the expected strain

/// Fraction of the strain at which the bond breaks, after a first strain in one step.
double breaking_fraction(BondSettings bond, const Strain& first, const Strain& total) {
  bond.form = BondForm::incremental;
  bond.damping_ratio = 0.0;
  bond.tensile_strength = k_tensile;
  bond.shear_strength = k_shear;
  LedGrain g(lone_grain_scene(bond));
  strain_by(g, first);
  g.loads();
  for (int k = 1; k <= k_steps * 11 / 10; ++k) {
    strain_by(g, {total.move * (1.0 / k_steps), total.turn * (1.0 / k_steps)});
    g.loads();
    if (read_bond(g.simulation(), 0, k_bond).is_broken) return (k - 0.5) / k_steps;
  }
  return 2.0;
}

void check_limits(Findings& findings, const std::string& setting, const BondSettings& bond) {
  const double bond_radius = bond.radius_multiplier * k_radius, length = 2.0 * k_radius, s = bond.moment_scale;
  const double stretch = k_tensile * length / bond.modulus, bend = stretch / (s * bond_radius);
  const double slide = k_shear * bond.stiffness_ratio * length / bond.modulus, twist = slide / (s * bond_radius);
  struct Limit {
    const char* name;
    Strain first, total;
    double expected;
    const char* unit;
  };
  const Limit limits[] = {
      {"stretch, tensile strength", {}, {k_along * stretch, {}}, stretch, "m"},
      {"bending angle, tensile strength", {}, {{}, k_across * bend}, bend, "rad"},
      {"bending angle, stretched to half the strength",
       {k_along * (0.5 * stretch), {}},
       {{}, k_across * (0.5 * bend)},
       0.5 * bend,
       "rad"},
      {"bending angle, shortened by half the strength",
       {k_along * (-0.5 * stretch), {}},
       {{}, k_across * (1.5 * bend)},
       1.5 * bend,
       "rad"},
      {"slide, shear strength", {}, {k_across * slide, {}}, slide, "m"},
      {"twist, shear strength", {}, {{}, k_along * twist}, twist, "rad"},
      {"twist, slid to half the strength",
       {k_across * (0.5 * slide), {}},
       {{}, k_along * (0.5 * twist)},
       0.5 * twist,
       "rad"},
  };
  for (const Limit& l : limits) {
    findings.relative(fmt::format("{}, {}", l.name, setting), l.unit, l.expected,
                      l.expected * breaking_fraction(bond, l.first, l.total), 1e-3, "beam theory");
  }
}

/// Pressed by 20 um, the bond is broken by shear: that step has the force of the contact table and a slide below it.
void check_contact_afterwards(Findings& findings) {
  BondSettings bond;
  bond.form = BondForm::incremental;
  bond.damping_ratio = 0.0;
  bond.shear_strength = 1e4;
  LedGrain g(lone_grain_scene(bond));
  const double overlap = 20e-6, slide = 3e-6;
  const Vec3 moved = strain_by(g, {k_along * -overlap + k_across * slide, {}});
  const Vec3 branch = g.position(k_vertex) - g.position(k_centre);
  const Vec3 n = branch * (1.0 / norm(branch));
  const double left = 2.0 * k_radius - norm(branch);
  const BallLoad load = g.loads()[k_vertex];
  const BondReading broken = read_bond(g.simulation(), 0, k_bond);
  findings.absolute("bond broken in the step of the overload", "1", 1.0, broken.is_broken ? 1.0 : 0.0, 0.0, "strength");
  findings.relative("normal force in the step of breaking", "N", 5.679437e5 * std::pow(left, 1.5), dot(load.force, n),
                    1e-5, "Hertz, table of contact constants");
  const double shear_stiffness = 2.0 / 3.0 * 1.5 * 5.679437e5 * std::sqrt(left);
  findings.relative("shear force in the step of breaking", "N",
                    -shear_stiffness * dot(perpendicular(moved, n), k_across),
                    dot(perpendicular(load.force, n), k_across), 1e-4, "Mindlin, table of contact constants");
  strain_by(g, {k_along * (2.0 * overlap), {}});
  findings.absolute("force after pulling a broken pair apart", "N", 0.0, norm(g.loads()[k_vertex].force), 1e-12,
                    "no bond");
}

}  // namespace

void check_bond_energy(Findings& findings) {
  for (const BondForm form : {BondForm::history_free, BondForm::incremental}) {
    const char* name = form == BondForm::incremental ? "incremental" : "history-free";
    BondSettings published, other = other_bond(), bare = other_bond();
    for (BondSettings* b : {&published, &other, &bare}) {
      b->form = form;
      b->damping_ratio = 0.0;
    }
    bare.linear_spring = false;
    check_modes(findings, fmt::format("published, {}", name), published);
    check_modes(findings, fmt::format("others, {}", name), other);
    check_modes(findings, fmt::format("others without linear spring, {}", name), bare);
  }
}

void check_bond_strength(Findings& findings) {
  check_limits(findings, "published", {});
  check_limits(findings, "others", other_bond());
  check_contact_afterwards(findings);
}

}  // namespace dem::verify
