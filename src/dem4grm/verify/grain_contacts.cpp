// SPDX-License-Identifier: BSD-3-Clause
// Contacts inside a rubber grain: second neighbours that meet, and pairs whose bond is broken.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "dem4grm/verify/driven_grain.hpp"
#include "dem4grm/verify/grain_checks.hpp"

namespace dem::verify {

namespace {

constexpr double k_radius = 0.63e-3, k_overlap = 20e-6;  // m
// Rubber on rubber at that radius and overlap, N and N/m: tabulated constants of the contact.
constexpr double k_normal_force = 0.05079843, k_shear_stiffness = 2.539921e3, k_friction = 0.27;

/// Two balls of a grain without bonds, all other balls far away; ball j is led around ball i at constant overlap.
class PressedPair {
 public:
  PressedPair(int i, int j, double dashpot_ratio = 0.0) : i_(i), j_(j), grain_(scene(dashpot_ratio)) {
    keep_only_diagonal(grain_.simulation(), 0, 0);
    at(i_, k_place);
    at(j_, k_place + branch_);
  }

  /// Leads ball j by an arc (m) across, then evaluates.
  void slide(double arc) {
    const Quaternion q = turned({}, k_axis * (arc / norm(branch_)), 1.0);
    branch_ = rotate(q, branch_);
    across_ = rotate(q, across_);
    grain_.lead(j_, k_place + branch_, {});
    loads_ = grain_.loads();
  }
  /// Leads ball j along the normal (m), then evaluates.
  void pull(double distance) {
    branch_ += branch_ * (distance / norm(branch_));
    grain_.lead(j_, k_place + branch_, {});
    loads_ = grain_.loads();
  }

  [[nodiscard]] double normal() const { return dot(loads_[index(j_)].force, branch_) / norm(branch_); }
  /// Against the slide, on ball j.
  [[nodiscard]] double shear() const { return -dot(loads_[index(j_)].force, across_); }
  [[nodiscard]] double torque(int slot) const { return dot(loads_[index(slot)].torque, k_axis); }
  [[nodiscard]] const Simulation& simulation() const { return grain_.simulation(); }

 private:
  // Oblique, so that no component of a force is nothing; the place is away from the other balls.
  static constexpr Vec3 k_axis = Vec3{2, 1, -2} * (1.0 / 3.0), k_place{0.03, 0, 0};

  static Scene scene(double dashpot_ratio) {
    BondSettings bond;
    bond.form = BondForm::incremental;
    Scene s = lone_grain_scene(bond);
    s.contact.normal_damping_ratio = dashpot_ratio;
    return s;
  }
  static std::size_t index(int slot) { return static_cast<std::size_t>(slot); }
  void at(int slot, const Vec3& place) { grain_.simulation().balls.set_position(LedGrain::index(slot), place); }

  int i_, j_;
  LedGrain grain_;
  Vec3 branch_ = Vec3{1, 2, 2} * ((2.0 * k_radius - k_overlap) / 3.0), across_ = Vec3{2, -2, 1} * (1.0 / 3.0);
  std::array<BallLoad, k_grain_balls> loads_;
};

double stored(const Simulation& s) { return s.energy().contact_strain + s.energy().bond_strain; }

void check_slide(Findings& findings, const std::string& name, int i, int j) {
  constexpr double step = 20e-9;
  const char* source = "Hertz and Mindlin, tabulated constants";
  PressedPair pair(i, j);
  const auto slide_to = [&](double from, double to) {
    for (int k = 0; k < static_cast<int>(std::lround((to - from) / step)); ++k) pair.slide(step);
  };
  slide_to(0.0, 4e-6);
  const double shear = k_shear_stiffness * 4e-6, lever = k_radius - 0.5 * k_overlap;
  findings.relative("normal force, " + name, "N", k_normal_force, pair.normal(), 1e-5, source);
  findings.relative("shear force after a slide of 4 um, " + name, "N", shear, pair.shear(), 1e-4, source);
  findings.relative("torque on the ball at rest, " + name, "N m", shear * lever, pair.torque(i), 1e-4, source);
  findings.relative("torque on the ball that slides, " + name, "N m", shear * lever, pair.torque(j), 1e-4, source);
  findings.relative("stored energy, " + name, "J",
                    0.4 * k_normal_force * k_overlap + 0.5 * shear * shear / k_shear_stiffness,
                    stored(pair.simulation()), 1e-4, source);
  slide_to(4e-6, 10e-6);
  const double limit = k_friction * k_normal_force;
  findings.relative("shear force after a slide of 10 um, " + name, "N", limit, pair.shear(), 1e-5, "Coulomb, 0.27");
  findings.relative("work lost to slip, " + name, "J", limit * (10e-6 - limit / k_shear_stiffness),
                    pair.simulation().energy().slip, 5e-3, "Coulomb, 0.27");
  pair.pull(k_overlap + 1e-6);
  findings.absolute("normal force when apart, " + name, "N", 0.0, pair.normal(), 1e-10, "no contact");
  pair.pull(-k_overlap - 1e-6);
  findings.relative("normal force when back, " + name, "N", k_normal_force, pair.normal(), 1e-5, source);
  findings.absolute("shear force when back, " + name, "N", 0.0, pair.shear(), 1e-8, "a new contact");
}

/// Force of the dashpot, 2 b sqrt(m/2 k_n) v, at 1 mm/s of separation, and the work that it takes in that step.
void check_dashpot(Findings& findings, const std::string& name, int i, int j) {
  PressedPair pair(i, j, 0.3);
  pair.slide(0.0);
  const double before = pair.normal();
  pair.pull(1e-9);
  const double mass = 1610.0 * 4.0 / 3.0 * k_pi * k_radius * k_radius * k_radius, stiffness = 3.809882e3;
  const double force = 0.6 * std::sqrt(0.5 * mass * stiffness) * 1e-3;
  findings.relative("dashpot force at 1 mm/s, " + name, "N", force, before - pair.normal() - stiffness * 1e-9, 1e-3,
                    "2 b sqrt(m/2 k_n) v, tabulated constants");
  findings.relative("work of the dashpot, " + name, "J", force * 1e-9, pair.simulation().energy().dashpot, 1e-3,
                    "force times path");
}

}  // namespace

void check_grain_contacts(Findings& findings) {
  check_slide(findings, "second neighbours", 0, 1);
  check_slide(findings, "broken bond", 27, 0);
  check_dashpot(findings, "second neighbours", 0, 1);
  check_dashpot(findings, "broken bond", 27, 0);
}

}  // namespace dem::verify
