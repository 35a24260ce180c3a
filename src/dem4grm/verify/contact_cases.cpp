// SPDX-License-Identifier: BSD-3-Clause
// Friction and the loading path of one contact, led through the engine's own steps.
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "dem4grm/verify/impact_scenes.hpp"
#include "dem4grm/verify/led_contact.hpp"

namespace dem {
namespace {

using namespace verify;

constexpr double k_overlap = 20e-6, k_gravel_radius = 2.5e-3, k_rubber_radius = 0.63e-3;  // m

/// Leads sphere 0 along and across the normal as it is at the moment.
class LedContact {
 public:
  LedContact(const Scene& scene, const LedPair& pair) : s_(led_pair(scene, pair)) {}
  [[nodiscard]] Vec3 normal() const {
    if (!s_.walls.empty()) return {1, 0, 0};
    const Vec3 branch = clump(s_, 1).position - clump(s_, 0).position;
    return branch * (1.0 / norm(branch));
  }
  /// Direction of sliding: in the contact plane, next to (0, 0.6, 0.8).
  [[nodiscard]] Vec3 tangent() const {
    const Vec3 t = perpendicular({0, 0.6, 0.8}, normal());
    return t * (1.0 / norm(t));
  }
  void slide(double by) { move_clump(s_, 0, tangent() * by); }
  void press(double by) { move_clump(s_, 0, normal() * by); }
  [[nodiscard]] double normal_force() const { return led_forces(s_, normal()).normal; }
  /// Against the direction of sliding, N.
  [[nodiscard]] double shear_force() const { return -dot(led_forces(s_, normal()).shear, tangent()); }
  [[nodiscard]] double shear_size() const { return norm(led_forces(s_, normal()).shear); }
  Simulation& simulation() { return s_; }

 private:
  Simulation s_;
};

// ---- Friction -------------------------------------------------------------------------------------------------------

struct FrictionRow {
  std::string name;
  LedPair pair;
  double expected = 0.0;
  FrictionTable table;  ///< used when it names a coefficient
  bool uses_table = false;
  double wall_friction = 0.70;
};

std::vector<FrictionRow> friction_rows() {
  const double g = k_gravel_radius, r = k_rubber_radius, d = k_overlap;
  std::vector<FrictionRow> rows{{"gravel on gravel", {k_gravel, k_gravel, g, g, d}, 0.72, {}},
                                {"gravel on rubber", {k_gravel, k_rubber, g, r, d}, 0.27, {}},
                                {"rubber on gravel", {k_rubber, k_gravel, r, g, d}, 0.27, {}},
                                {"rubber on rubber", {k_rubber, k_rubber, r, r, d}, 0.27, {}},
                                {"gravel on wall of 0.70", {k_gravel, k_gravel, g, 0, d}, 0.70, {}},
                                {"rubber on wall of 0.70", {k_rubber, k_rubber, r, 0, d}, 0.27, {}}};
  FrictionRow smooth{"gravel on wall of 0.10", {k_gravel, k_gravel, g, 0, d}, 0.10, {}};
  smooth.wall_friction = 0.10;
  FrictionRow stage{"gravel on rubber, set to 0.4 for a stage", {k_gravel, k_rubber, g, r, d}, 0.4, {}, true};
  stage.table.between_grains = {{{0.1, 0.4}, {0.4, 0.2}}};
  stage.table.against_walls = {0.3, 0.5};
  FrictionRow stage_wall{
      "rubber on wall of 0.70, set to 0.5 for a stage", {k_rubber, k_rubber, r, 0, d}, 0.5, {}, true};
  stage_wall.table = stage.table;
  rows.push_back(smooth);
  rows.push_back(stage);
  rows.push_back(stage_wall);
  return rows;
}

LedContact contact_of(const FrictionRow& row) {
  Scene scene = model_scene();
  scene.walls.friction = row.wall_friction;
  LedContact c(scene, row.pair);
  if (row.uses_table) c.simulation().set_friction(row.table);
  settle(c.simulation());
  return c;
}

void check_friction(Findings& f, const FrictionRow& row) {
  const char* coulomb = "Coulomb, with the smaller of both coefficients";
  LedContact c = contact_of(row);
  Simulation& s = c.simulation();
  c.slide(1e-9);
  const double start = c.normal_force(), stiffness = c.shear_force() / 1e-9;
  const double reach = row.expected * start / stiffness;  // where slip must begin
  const int n = 60;
  double largest = 0.0, halfway = 0.0, work = 0.0, last = c.shear_force(), ledger = 0.0;
  for (int k = 1; k <= 2 * n; ++k) {
    c.slide(reach / n);
    largest = std::max(largest, c.shear_size() / c.normal_force());
    if (k == n / 2) halfway = c.shear_force();
    if (k == n + 5) ledger = s.ledger.contact_slip;
    if (k > n + 5) work += 0.5 * (c.shear_force() + last) * reach / n;
    last = c.shear_force();
  }
  f.relative(row.name + ": largest shear over normal force", "1", row.expected, largest, 1e-9, coulomb);
  f.relative(row.name + ": against the motion in slip", "1", row.expected, c.shear_force() / c.normal_force(), 1e-6,
             coulomb);
  f.relative(row.name + ": shear over normal force half way to slip", "1", 0.5 * row.expected, halfway / start, 2e-3,
             "spring below the limit");
  f.relative(row.name + ": work of slip", "J", work, s.ledger.contact_slip - ledger, 1e-3, "force times path");
  // Back by the length that loads the spring fully: it is empty there.
  for (int k = 0; k < n; ++k) c.slide(-reach / n);
  f.absolute(row.name + ": shear over normal force half way back", "1", 0.0, c.shear_force() / c.normal_force(), 5e-3,
             "spring below the limit");
  // From there in one long step: the shear force at both ends is 0 and the limit.
  const double rest = s.ledger.contact_slip;
  LedContact leap = c;
  leap.slide(-3.0 * reach);
  f.relative(row.name + ": work of slip in a single step", "J", 0.5 * leap.shear_size() * 2.0 * reach,
             leap.simulation().ledger.contact_slip - rest, 2e-2, "PFC: mean shear force times slipped length");
  for (int k = 0; k < n + 10; ++k) c.slide(-reach / n);
  f.relative(row.name + ": sliding back", "1", -row.expected, c.shear_force() / c.normal_force(), 1e-6, coulomb);
}

/// The wall slides under a ball that stands still, and drags it along.
void check_moving_wall(Findings& f) {
  LedContact c = contact_of({"", {k_gravel, k_gravel, k_gravel_radius, 0, k_overlap}, 0.70, {}});
  const Vec3 by = c.tangent() * 1e-6;
  move_wall(c.simulation(), 0, by);
  const double shear_modulus = 1.0 / (1.70 / 90e6 + 1.75 / 80e9);
  f.relative("gravel on wall, wall moved by 1 um: drag", "N",
             8.0 * shear_modulus * std::sqrt(k_gravel_radius * k_overlap) * 1e-6, -c.shear_force(), 1e-6,
             "Mindlin (1949)");
  for (int k = 0; k < 30; ++k) move_wall(c.simulation(), 0, by);
  f.relative("gravel on wall, wall moved by 31 um: drag over normal force", "1", 0.70,
             -c.shear_force() / c.normal_force(), 1e-9, "Coulomb");
  const WallReaction& reaction = c.simulation().reactions[0];
  f.relative("gravel on wall: normal force on the wall", "N", c.normal_force(), reaction.force.x, 1e-12, "Newton");
  f.relative("gravel on wall: shear force on the wall", "N", c.shear_force(), dot(reaction.force, c.tangent()), 1e-9,
             "Newton");
}

void friction(Findings& f) {
  for (const FrictionRow& row : friction_rows()) check_friction(f, row);
  check_moving_wall(f);
}

// ---- Loading path ---------------------------------------------------------------------------------------------------

struct LoadingPath {
  std::string name;
  LedPair pair;
  double shear_modulus = 0.0;  ///< G* of Mindlin, Pa
  double friction = 0.0;
  int rule = 0;
};

/// Forces at the corners of the path, and all along it.
struct Walked {
  Series curve;
  void note(LedContact& c, double slid) {
    curve.x.push_back(1e6 * slid);
    curve.y.push_back(c.shear_force());
  }
};

Series walk(Findings& f, const LoadingPath& p) {
  Scene scene = model_scene();
  scene.contact.hz_mode = p.rule;
  LedContact c(scene, p.pair);
  const double r1 = p.pair.radius, r2 = p.pair.partner_radius, radius = r2 > 0.0 ? r1 * r2 / (r1 + r2) : r1;
  const double stiffness = 8.0 * p.shear_modulus * std::sqrt(radius * k_overlap), load = c.normal_force();
  const double to = 0.4 * p.friction * load / stiffness, lifted = k_overlap * (1.0 - std::pow(0.5, 2.0 / 3.0));
  const int n = 40;
  const char* mindlin = "Mindlin (1949), k_s = 8 G* a";
  Walked path{{p.name, false, {}, {}}};
  double slid = 0.0;
  const auto go = [&](double by, int steps, bool along_normal) {
    for (int k = 0; k < steps; ++k) {
      if (along_normal) c.press(by / steps);
      if (!along_normal) c.slide(by / steps), slid += by / steps;
      path.note(c, slid);
    }
  };
  path.note(c, slid);
  go(to, n, false);
  const double loaded = c.shear_force();
  f.relative(p.name + ": shear force of the loaded contact", "N", stiffness * to, loaded, 1e-4, mindlin);
  go(-lifted, n, true);
  f.relative(p.name + ": normal force after unloading, over that before", "1", 0.5, c.normal_force() / load, 1e-4,
             "Hertz (1882)");
  const double kept = p.rule == 0 ? 1.0 : std::cbrt(0.5);
  f.relative(p.name + ": shear force after unloading, over that before", "1", kept, c.shear_force() / loaded, 1e-5,
             p.rule == 0 ? "rule: kept" : "rule: falls with k_s, (F_n/F_n,old)^(1/3)");
  const double before = c.shear_force();
  go(-0.1 * to, 5, false);
  f.relative(p.name + ": k_s at half the normal force", "N/m", stiffness * std::cbrt(0.5),
             (before - c.shear_force()) / (0.1 * to), 1e-4, mindlin);
  const double held = c.shear_force();
  go(lifted, n, true);
  f.relative(p.name + ": shear force after loading again, over that before", "1", 1.0, c.shear_force() / held, 1e-5,
             "rule: kept under growing normal force");
  go(-0.5 * to, n, false);
  f.absolute(p.name + ": shear force on the way back", "N", held - 0.5 * stiffness * to, c.shear_force(),
             1e-4 * stiffness * to, mindlin);
  go(-4.0 * to, n, false);
  f.relative(p.name + ": shear force in slip", "N", -p.friction * load, c.shear_force(), 1e-3, "Coulomb");
  return path.curve;
}

void mindlin(Findings& f) {
  const double gravel = 1.0 / (2.0 * 1.70 / 90e6), gravel_wall = 1.0 / (1.70 / 90e6 + 1.75 / 80e9);
  Picture picture{"mindlin-path",
                  "Shear force along the loading path, gravel on a wall",
                  "tangential displacement (um)",
                  "shear force (N)",
                  {}};
  const double g = k_gravel_radius;
  for (const int rule : {0, 1}) {
    walk(f,
         {fmt::format("gravel on gravel, rule {}", rule), {k_gravel, k_gravel, g, g, k_overlap}, gravel, 0.72, rule});
    const LoadingPath wall{
        fmt::format("gravel on wall, rule {}", rule), {k_gravel, k_gravel, g, 0, k_overlap}, gravel_wall, 0.70, rule};
    picture.series.push_back(walk(f, wall));
    const double stiffness = 8.0 * gravel_wall * std::sqrt(g * k_overlap), load = 1.531458,
                 to = 0.28 * load / stiffness;
    const double kept = rule == 0 ? 1.0 : std::cbrt(0.5), half = std::cbrt(0.5);
    const double a = stiffness * to, b = a * kept, c = b - 0.1 * a * half, e = c - 0.5 * a;
    picture.series.push_back({fmt::format("corners, rule {}", rule),
                              true,
                              {0, 1e6 * to, 1e6 * to, 0.9e6 * to, 0.9e6 * to, 0.4e6 * to, -3.6e6 * to},
                              {0, a, b, c, c, e, -0.70 * load}});
  }
  f.picture(picture);
}

}  // namespace

void add_contact_cases(std::vector<VerificationCase>& cases) {
  cases.push_back(
      {"friction", "Coulomb friction",
       "Two balls, or a ball and a wall, overlap by 20 um and are slid past each other by twice the length "
       "mu F_n/k_s that loads the spring, and back. The shear force may not exceed mu F_n, acts against the "
       "motion, and its slip turns mu F_n times the path into heat. mu is the smaller of both sides': gravel "
       "0.72, rubber 0.27, walls 0.70 or 0.10; a stage of a test may set others for grains, which the wall's "
       "own still caps.",
       Extent::quick, friction});
  cases.push_back(
      {"mindlin-loading", "Loading path of a sticking contact",
       "Gravel (R = 2.5 mm) on gravel and on a wall, overlap d of 20 um, through: sliding up to 0.4 mu F_n at "
       "constant F_n; unloading to F_n/2; sliding back a little; loading to F_n again; sliding back into slip. "
       "Slopes are k_s = 8 G* sqrt(R* d) (N/m) at the overlap of the moment. Unloading keeps the shear force "
       "(rule 0) or lowers it with k_s, by (1/2)^(1/3) (rule 1).",
       Extent::quick, mindlin});
  add_turned_cases(cases);
  add_edge_cases(cases);
  add_mixing_cases(cases);
}

}  // namespace dem
