// SPDX-License-Identifier: BSD-3-Clause
// Impacts for the verification suite: two spheres, or a sphere and a plane, brought together through the engine.
#pragma once

#include <cmath>
#include <functional>
#include <string>

#include "dem4grm/verify/cases.hpp"
#include "dem4grm/verify/scenes.hpp"

namespace dem::verify {

/// One material of a benchmark, as the literature states it.
struct BenchmarkMaterial {
  std::string name;
  double young = 0.0;    ///< Pa
  double poisson = 0.0;  ///< 1
  double density = 0.0;  ///< kg/m3

  [[nodiscard]] MaterialSettings settings(double friction = 0.0) const {
    return {density, friction, shear_modulus(young, poisson), poisson};
  }
};

inline double sphere_mass(double radius, double density) { return 4.0 / 3.0 * k_pi * std::pow(radius, 3) * density; }

/// Closed form of an undamped head-on impact, Hertz (1882).
struct HertzImpact {
  double overlap = 0.0;   ///< m, largest
  double force = 0.0;     ///< N, largest
  double duration = 0.0;  ///< s
};

/// mass: reduced mass, kg; modulus: E*, Pa; radius: R*, m; speed: of approach, m/s.
HertzImpact hertz_impact(double mass, double modulus, double radius, double speed);

/// E* of a sphere against a rigid body, Pa.
inline double modulus_on_rigid(const BenchmarkMaterial& m) { return m.young / (1.0 - m.poisson * m.poisson); }

/// The ratio of damping b expressed by the restitution e of the full dashpot (no cut of tension).
inline double damping_for_restitution(double e) {
  return std::sqrt(5.0 / 6.0) * -std::log(e) / std::sqrt(k_pi * k_pi + std::log(e) * std::log(e));
}

/// A sphere (k_gravel) just above a plane 1e9 times stiffer at z = 0; the sphere is clump 0, the plane wall 0.
struct PlaneImpact {
  MaterialSettings material;
  double radius = 0.0;  ///< m
  double friction = 0.0;
  ContactSettings contact;
};
Simulation sphere_on_plane(const PlaneImpact& impact, const Vec3& velocity, const Vec3& spin = {});

/// Two spheres of one material just apart on the x axis, closing head-on at `speed` (m/s) about rest.
Simulation two_spheres(const MaterialSettings& m, double radius, double speed, const ContactSettings& contact = {});

/// What one step of an impact looks like.
struct ImpactMoment {
  double time = 0.0;     ///< s since first touch
  double overlap = 0.0;  ///< m
  double force = 0.0;    ///< N, magnitude of the total contact force
};

struct Strike {
  double overlap = 0.0, force = 0.0;  ///< largest, m and N
  double duration = 0.0;              ///< s
  double rebound = 0.0;               ///< m/s, speed of parting
  bool is_over = false;
};

/// Steps through one impact with the given number of steps in the expected duration; `watch` sees every moment.
Strike strike(Simulation& s, double expected_duration, int steps_per_contact,
              const std::function<void(const ImpactMoment&)>& watch = {});

/// Cases of the dashpots; part of add_impact_cases.
void add_dashpot_cases(std::vector<VerificationCase>& cases);
/// Cases of spinning spheres; part of add_oblique_cases.
void add_spin_cases(std::vector<VerificationCase>& cases);
/// Cases of contacts that turn as a whole; part of add_contact_cases.
void add_turned_cases(std::vector<VerificationCase>& cases);
/// Cases of walls in several rectangles; part of add_contact_cases.
void add_edge_cases(std::vector<VerificationCase>& cases);
/// Cases of unlike materials; part of add_contact_cases.
void add_mixing_cases(std::vector<VerificationCase>& cases);

}  // namespace dem::verify
