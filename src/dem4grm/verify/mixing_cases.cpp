// SPDX-License-Identifier: BSD-3-Clause
// Contacts of unlike materials: normal force, both stiffnesses and impacts of every pairing of the model.
#include <fmt/format.h>

#include <array>
#include <string>
#include <vector>

#include "dem4grm/verify/impact_scenes.hpp"
#include "dem4grm/verify/led_contact.hpp"

namespace dem::verify {
namespace {

constexpr double k_overlap = 20e-6, k_gravel_radius = 2.5e-3, k_rubber_radius = 0.63e-3;  // m

/// Hertz and Mindlin for two elastic bodies, from Young's moduli and the contact radius (Johnson 1985).
struct Expected {
  double force = 0.0, normal_stiffness = 0.0, shear_stiffness = 0.0;  ///< N, N/m, N/m
};
Expected expected(const MaterialSettings& a, const MaterialSettings& b, double radius) {
  const auto young = [](const MaterialSettings& m) { return 2.0 * m.shear_modulus * (1.0 + m.poisson_ratio); };
  const double modulus =
      1.0 / ((1 - a.poisson_ratio * a.poisson_ratio) / young(a) + (1 - b.poisson_ratio * b.poisson_ratio) / young(b));
  const double shear = 1.0 / ((2 - a.poisson_ratio) / a.shear_modulus + (2 - b.poisson_ratio) / b.shear_modulus);
  const double patch = std::sqrt(radius * k_overlap);
  return {4.0 / 3.0 * modulus * patch * k_overlap, 2.0 * modulus * patch, 8.0 * shear * patch};
}

struct Pairing {
  std::string name;
  LedPair pair;
  double rubber_poisson = 0.5;
};

double radius_of(Material m) { return m == k_gravel ? k_gravel_radius : k_rubber_radius; }

std::vector<Pairing> pairings() {
  std::vector<Pairing> all;
  const auto add = [&](Material a, const Material* b, double poisson) {
    const auto word = [](Material m) { return m == k_gravel ? "gravel" : "rubber"; };
    std::string name = fmt::format("{} on {}", word(a), b == nullptr ? "wall" : word(*b));
    if (a == k_rubber || (b != nullptr && *b == k_rubber)) name += fmt::format(", rubber's nu = {}", poisson);
    all.push_back(
        {name, {a, b == nullptr ? a : *b, radius_of(a), b == nullptr ? 0.0 : radius_of(*b), k_overlap}, poisson});
  };
  const Material gravel = k_gravel, rubber = k_rubber;
  add(k_gravel, &gravel, 0.5);
  add(k_gravel, nullptr, 0.5);
  for (const double poisson : {0.5, 0.0}) {
    add(k_rubber, &rubber, poisson);
    add(k_gravel, &rubber, poisson);
    add(k_rubber, &gravel, poisson);
    add(k_rubber, nullptr, poisson);
  }
  return all;
}

double normal_force_after(const Simulation& start, const Vec3& by) {
  Simulation s = start;
  move_clump(s, 0, by);
  return led_forces(s, {1, 0, 0}).normal;
}

void check_pairing(Findings& f, const Pairing& p) {
  Scene scene = model_scene();
  scene.rubber.poisson_ratio = p.rubber_poisson;
  scene.gravel.friction = scene.rubber.friction = scene.walls.friction = 5.0;
  const Simulation s = led_pair(scene, p.pair);
  const auto settings = [&](Material m) { return m == k_gravel ? scene.gravel : scene.rubber; };
  const bool at_wall = p.pair.partner_radius == 0.0;
  const double r1 = p.pair.radius, r2 = p.pair.partner_radius;
  const Expected e = expected(settings(p.pair.first), at_wall ? scene.walls : settings(p.pair.second),
                              at_wall ? r1 : r1 * r2 / (r1 + r2));
  const double small = 1e-3 * k_overlap;
  const double slope = (normal_force_after(s, {small, 0, 0}) - normal_force_after(s, {-small, 0, 0})) / (2.0 * small);
  Simulation slid = s;
  move_clump(slid, 0, {0, 0.6 * small, 0.8 * small});
  f.relative(p.name + ": normal force at 20 um", "N", e.force, led_forces(s, {1, 0, 0}).normal, 1e-6, "Hertz (1882)");
  f.relative(p.name + ": slope of the normal force", "N/m", e.normal_stiffness, slope, 1e-6, "Hertz (1882)");
  if (at_wall) {
    f.relative(p.name + ": stiffness that the wall reports to its servo", "N/m", e.normal_stiffness,
               s.reactions[0].stiffness, 1e-6, "Hertz (1882)");
  }
  f.relative(p.name + ": shear force over displacement", "N/m", e.shear_stiffness,
             norm(led_forces(slid, {1, 0, 0}).shear) / small, 2e-6, "Mindlin (1949)");
}

/// Nine balls of a face of a bonded rubber grain, at rest, against a wall or against the face of a second grain.
void check_grain_face(Findings& f, bool at_wall) {
  Scene scene = model_scene();
  const double r = k_rubber_radius, face = k_grain_lattice * r + r;
  scene.grains = {{{0, 0, 0}, {}}};
  if (at_wall) {
    scene.wall_list = {make_wall("wall", {face - k_overlap, -1, -1}, {0, 0, 2}, {0, 2, 0})};
  } else {
    scene.grains.push_back({{2.0 * face - k_overlap, 0, 0}, {}});
  }
  Simulation s(scene);
  s.set_time_step(k_leading_time_step);
  s.step();
  double force = 0.0;
  for (std::size_t row = 0; row < s.contacts.n_rows(); ++row) force -= s.contacts.force(row).x;
  const double one = expected(scene.rubber, at_wall ? scene.walls : scene.rubber, at_wall ? r : 0.5 * r).force;
  f.relative(fmt::format("face of a rubber grain on {}: force of its nine balls", at_wall ? "wall" : "its like"), "N",
             9.0 * one, force, 1e-6, "Hertz (1882)");
}

void check_impact(Findings& f, const std::string& name, Simulation& s, double speed, const HertzImpact& h) {
  const Strike got = strike(s, h.duration, 4000);
  f.relative(name + ": largest overlap", "m", h.overlap, got.overlap, 1e-5, "Hertz (1882)");
  f.relative(name + ": largest force", "N", h.force, got.force, 1e-5, "Hertz (1882)");
  f.relative(name + ": duration", "s", h.duration, got.duration, 5e-4, "Hertz (1882)");
  f.relative(name + ": speed of parting", "m/s", speed, got.rebound, 1e-5, "conservation of energy");
}

void impacts(Findings& f) {
  const double r1 = k_gravel_radius, r2 = k_rubber_radius, speed = 0.5;
  const double m1 = sphere_mass(r1, 2710), m2 = sphere_mass(r2, 1610);
  // E*: gravel (90 MPa, 0.30), rubber (12 MPa, 0.50), wall (80 GPa, 0.25); 1/E* = (1-nu1)/(2 G1) + (1-nu2)/(2 G2).
  Scene scene = model_scene();
  add_sphere(scene, {0, 0, 0}, r1, k_gravel);
  add_sphere(scene, {(r1 + r2) * (1 + 1e-9), 0, 0}, r2, k_rubber);
  Simulation pair(scene);
  set_motion(pair, 0, {speed, 0, 0});
  check_impact(f, "gravel strikes rubber", pair, speed,
               hertz_impact(m1 * m2 / (m1 + m2), 1.0 / (0.35 / 90e6 + 0.25 / 12e6), r1 * r2 / (r1 + r2), speed));

  Scene on_wall = model_scene();
  on_wall.wall_list = {make_wall("wall", {-1, -1, 0}, {2, 0, 0}, {0, 2, 0})};
  add_sphere(on_wall, {0, 0, r2 * (1 + 1e-9)}, r2, k_rubber);
  Simulation wall(on_wall);
  set_motion(wall, 0, {0, 0, -speed});
  check_impact(f, "rubber strikes wall", wall, speed, hertz_impact(m2, 1.0 / (0.25 / 12e6 + 0.375 / 80e9), r2, speed));
}

void mixing(Findings& f) {
  for (const Pairing& p : pairings()) check_pairing(f, p);
  check_grain_face(f, true);
  check_grain_face(f, false);
  impacts(f);
}

}  // namespace

void add_mixing_cases(std::vector<VerificationCase>& cases) {
  cases.push_back(
      {"mixing", "Contacts of unlike materials",
       "Gravel (90 MPa, nu 0.30, R = 2.5 mm), rubber balls (12 MPa, nu 0.50 or 0, R = 0.63 mm) and walls (80 "
       "GPa, nu 0.25) in every pairing, each led to an overlap d of 20 um by the engine's own steps. The "
       "expected values do not use the mixing rule but Hertz and Mindlin for two bodies:\n\n"
       "    F_n = (4/3) E* a d,  k_n = 2 E* a,  k_s = 8 G* a,  a = sqrt(R* d)\n"
       "    1/E* = (1 - nu1^2)/E1 + (1 - nu2^2)/E2,  1/G* = (2 - nu1)/G1 + (2 - nu2)/G2\n\n"
       "with E = 2 G (1 + nu) (Pa), contact radius a (m), 1/R* = 1/R1 + 1/R2 (a plane has 1/R2 = 0). Force "
       "and slope of the force (0.02 um to either side) depend on E* and R*, the shear force after 0.02 um "
       "of tangential motion on G*. The face of a whole rubber grain and impacts of the pairings follow.",
       Extent::quick, mixing});
}

}  // namespace dem::verify
