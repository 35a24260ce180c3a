// SPDX-License-Identifier: BSD-3-Clause
// Head-on impacts: peak overlap, peak force, duration and rebound, and restitution against the damping ratio.
#include <fmt/format.h>

#include <vector>

#include "dem4grm/verify/impact_scenes.hpp"

namespace dem {
namespace {

using namespace verify;

constexpr int k_steps_per_contact = 4000;
const char* const k_hertz = "Hertz (1882), closed form";

const BenchmarkMaterial k_glass{"glass", 48e9, 0.20, 2800}, k_limestone{"limestone", 20e9, 0.25, 2500},
    k_aluminium{"aluminium alloy", 70e9, 0.30, 2699}, k_magnesium{"magnesium alloy", 40e9, 0.35, 1800},
    k_oxide{"aluminium oxide", 380e9, 0.23, 4000}, k_iron{"cast iron", 100e9, 0.25, 7000};

/// Holds an undamped strike against its closed form.
void check_strike(Findings& f, const std::string& name, const Strike& got, const HertzImpact& h, double speed) {
  f.relative(name + ": largest overlap", "m", h.overlap, got.overlap, 1e-5, k_hertz);
  f.relative(name + ": largest force", "N", h.force, got.force, 1e-5, k_hertz);
  f.relative(name + ": duration", "s", h.duration, got.duration, 5e-4, k_hertz);
  f.relative(name + ": speed of parting", "m/s", speed, got.rebound, 1e-5, "conservation of energy");
}

void two_equal_spheres(Findings& f) {
  const double radius = 0.01, speed = 20.0;
  Picture picture{
      "hertz-impact-spheres", "Force against overlap, two spheres at 20 m/s", "overlap (um)", "force (kN)", {}};
  for (const BenchmarkMaterial& m : {k_glass, k_limestone}) {
    const double modulus = 0.5 * modulus_on_rigid(m), mass = 0.5 * sphere_mass(radius, m.density);
    const HertzImpact h = hertz_impact(mass, modulus, 0.5 * radius, speed);
    Simulation s = two_spheres(m.settings(), radius, speed);
    Series line{m.name, false, {}, {}}, points{m.name + ", Hertz", true, {}, {}};
    int k = 0;
    const Strike got = strike(s, h.duration, k_steps_per_contact, [&](const ImpactMoment& now) {
      if (k++ % 80 != 0) return;
      line.x.push_back(1e6 * now.overlap);
      line.y.push_back(1e-3 * now.force);
    });
    for (const double part : {0.2, 0.4, 0.6, 0.8, 1.0}) {
      points.x.push_back(1e6 * part * h.overlap);
      points.y.push_back(1e-3 * std::pow(part, 1.5) * h.force);
    }
    check_strike(f, m.name, got, h, speed);
    picture.series.push_back(line);
    picture.series.push_back(points);
  }
  f.picture(picture);
}

/// Gravel of 3 mm against a rubber ball of 1 mm: nothing is equal. E* by Hertz from the two Young's moduli.
void two_unlike_spheres(Findings& f) {
  Scene scene = model_scene();
  const double r1 = 3e-3, r2 = 1e-3, speed = 1.0;
  add_sphere(scene, {0, 0, 0}, r1, k_gravel);
  add_sphere(scene, {(r1 + r2) * (1 + 1e-9), 0, 0}, r2, k_rubber);
  Simulation s(scene);
  set_motion(s, 1, {-speed, 0, 0});
  const double m1 = sphere_mass(r1, 2710), m2 = sphere_mass(r2, 1610);
  const double young1 = 2 * 90e6 * 1.30, young2 = 2 * 12e6 * 1.50;
  const double modulus = 1.0 / ((1 - 0.09) / young1 + (1 - 0.25) / young2);
  const HertzImpact h = hertz_impact(m1 * m2 / (m1 + m2), modulus, r1 * r2 / (r1 + r2), speed);
  check_strike(f, "gravel 3 mm on rubber 1 mm", strike(s, h.duration, k_steps_per_contact), h, speed);
}

void impact_of_spheres(Findings& f) {
  two_equal_spheres(f);
  two_unlike_spheres(f);
  f.remark(
      "The largest force of limestone, 7.1082 kN, also stands in the reference files of the benchmark in Kratos "
      "Multiphysics (7108 N).");
}

void impact_on_plane(Findings& f) {
  struct Row {
    const BenchmarkMaterial& material;
    double radius, speed;
  };
  for (const Row& row :
       {Row{k_aluminium, 0.1, 0.2}, Row{k_magnesium, 0.1, 0.2}, Row{k_oxide, 2.5e-3, 3.9}, Row{k_iron, 2.5e-3, 3.9}}) {
    const double mass = sphere_mass(row.radius, row.material.density);
    const HertzImpact h = hertz_impact(mass, modulus_on_rigid(row.material), row.radius, row.speed);
    Simulation s = sphere_on_plane({row.material.settings(), row.radius, 0.0, {}}, {0, 0, -row.speed});
    check_strike(f, row.material.name, strike(s, h.duration, k_steps_per_contact), h, row.speed);
  }
}

double restitution_on_plane(double b, double speed) {
  const double radius = 2.5e-3;
  ContactSettings contact;
  contact.normal_damping_ratio = b;
  Simulation s = sphere_on_plane({k_iron.settings(), radius, 0.0, contact}, {0, 0, -speed});
  const HertzImpact h = hertz_impact(sphere_mass(radius, k_iron.density), modulus_on_rigid(k_iron), radius, speed);
  return strike(s, h.duration, k_steps_per_contact).rebound / speed;
}

/// Of an iron sphere on one of 2 r and the density of rubber here: unlike masses, so that the reduced mass counts.
double restitution_of_pair(double b, double speed) {
  Scene scene = model_scene();
  scene.gravel = scene.rubber = k_iron.settings();
  scene.rubber.density = 1000.0;
  scene.contact.normal_damping_ratio = b;
  const double r1 = 2.5e-3, r2 = 5e-3;
  add_sphere(scene, {0, 0, 0}, r1, k_gravel);
  add_sphere(scene, {(r1 + r2) * (1 + 1e-9), 0, 0}, r2, k_rubber);
  Simulation s(scene);
  set_motion(s, 0, {speed, 0, 0});
  const double m1 = sphere_mass(r1, 7000), m2 = sphere_mass(r2, 1000);
  const HertzImpact h = hertz_impact(m1 * m2 / (m1 + m2), 0.5 * modulus_on_rigid(k_iron), r1 * r2 / (r1 + r2), speed);
  return strike(s, h.duration, k_steps_per_contact).rebound / speed;
}

void restitution(Findings& f) {
  const char* source = "Tsuji et al. (1992); Antypov & Elliott (2011)";
  Series plane{"sphere on plane", false, {}, {}}, pair{"unlike spheres", false, {}, {}},
      closed{"closed form", true, {}, {}};
  for (const double b : {0.02, 0.05, 0.10, 0.20, 0.25, 0.35, 0.50}) {
    const double e = std::exp(-k_pi * b / std::sqrt(5.0 / 6.0 - b * b));
    // The rebound falls with b as fast as the closed form says; what the time step leaves is a few parts in ten
    // thousand of the speed of impact.
    const double on_plane = restitution_on_plane(b, 3.9), of_pair = restitution_of_pair(b, 3.9);
    f.absolute(fmt::format("sphere on plane, 3.9 m/s, b = {}: restitution", b), "1", e, on_plane, 5e-4, source);
    f.absolute(fmt::format("unlike spheres, 3.9 m/s, b = {}: restitution", b), "1", e, of_pair, 5e-4, source);
    plane.x.push_back(b), plane.y.push_back(on_plane);
    pair.x.push_back(b), pair.y.push_back(of_pair);
    closed.x.push_back(b), closed.y.push_back(e);
  }
  const double e = std::exp(-k_pi * 0.2 / std::sqrt(5.0 / 6.0 - 0.04));
  f.absolute("sphere on plane, 0.039 m/s, b = 0.2: restitution", "1", e, restitution_on_plane(0.2, 0.039), 5e-4,
             source);
  f.absolute("unlike spheres, 0.039 m/s, b = 0.2: restitution", "1", e, restitution_of_pair(0.2, 0.039), 5e-4, source);
  f.picture({"restitution",
             "Restitution against the damping ratio",
             "damping ratio b",
             "restitution e",
             {plane, pair, closed}});
}

}  // namespace

void add_impact_cases(std::vector<VerificationCase>& cases) {
  cases.push_back(
      {"hertz-impact-spheres", "Head-on impact of two spheres",
       "Two equal spheres of 10 mm radius meet at 20 m/s (Chung & Ooi 2011, test 1), and a gravel sphere of "
       "3 mm is met by a rubber ball of 1 mm at 1 m/s, no damping.\n\n"
       "    d_max = (15 m v^2 / (16 E* sqrt(R*)))^(2/5)\n"
       "    F_max = (4/3) E* sqrt(R*) d_max^(3/2)\n"
       "    t_c   = 2.94328 d_max / v\n\n"
       "with m = m1 m2/(m1 + m2) (kg), R* = R1 R2/(R1 + R2) (m), 1/E* = (1 - nu1^2)/E1 + (1 - nu2^2)/E2 "
       "(1/Pa), closing speed v (m/s), overlap d (m), force F (N), duration t_c (s). The overlap depends on "
       "stiffness and mass together, the force on the exponent too, the duration on mass and stiffness the "
       "other way round; the speed of parting shows whether the scheme keeps the energy.",
       Extent::quick, impact_of_spheres});
  cases.push_back(
      {"hertz-impact-plane", "Head-on impact of a sphere on a rigid plane",
       "Chung & Ooi (2011), tests 2 and 3 without damping: spheres of 0.1 m radius at 0.2 m/s and of 2.5 mm "
       "at 3.9 m/s fall on a wall 1e9 times stiffer than they are. Formulas as for two spheres, with m and R "
       "of the sphere and E* = E/(1 - nu^2).",
       Extent::quick, impact_on_plane});
  cases.push_back(
      {"restitution", "Restitution against the damping ratio",
       "The iron sphere of Chung & Ooi (2011), test 3, with a normal dashpot 2 b sqrt(m k_n) v_n, where k_n "
       "(N/m) is the tangent stiffness: on a rigid plane, and against a lighter and larger sphere, where m "
       "is the reduced mass. The ratio b (1) alone fixes the restitution, at any speed:\n\n"
       "    e = exp(-pi b / sqrt(5/6 - b^2))\n\n"
       "Each value depends on b, on the mass in the dashpot and on the tangent stiffness in it.",
       Extent::quick, restitution});
  add_dashpot_cases(cases);
}

}  // namespace dem
