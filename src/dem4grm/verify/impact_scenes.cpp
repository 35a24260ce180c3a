// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/verify/impact_scenes.hpp"

#include <algorithm>

namespace dem::verify {

HertzImpact hertz_impact(double mass, double modulus, double radius, double speed) {
  HertzImpact h;
  h.overlap = std::pow(15.0 * mass * speed * speed / (16.0 * modulus * std::sqrt(radius)), 0.4);
  h.force = 4.0 / 3.0 * modulus * std::sqrt(radius) * std::pow(h.overlap, 1.5);
  // 2 times the integral of dx / sqrt(1 - x^(5/2)) from 0 to 1 = 2.9432751.
  h.duration = 0.8 * std::sqrt(k_pi) * std::tgamma(0.4) / std::tgamma(0.9) * h.overlap / speed;
  return h;
}

Simulation sphere_on_plane(const PlaneImpact& impact, const Vec3& velocity, const Vec3& spin) {
  Scene scene = model_scene();
  scene.gravel = impact.material;
  scene.gravel.friction = 10.0;  // the plane decides
  scene.contact = impact.contact;
  scene.walls.shear_modulus = 1e9 * impact.material.shear_modulus;
  scene.wall_list = {make_wall("plane", {-5, -5, 0}, {10, 0, 0}, {0, 10, 0})};
  scene.wall_list[0].friction = impact.friction;
  add_sphere(scene, {0, 0, impact.radius * (1 + 1e-9)}, impact.radius);
  Simulation s(scene);
  set_motion(s, 0, velocity, spin);
  return s;
}

Simulation two_spheres(const MaterialSettings& m, double radius, double speed, const ContactSettings& contact) {
  Scene scene = model_scene();
  scene.gravel = m;
  scene.contact = contact;
  add_sphere(scene, {0, 0, 0}, radius);
  add_sphere(scene, {2.0 * radius * (1 + 1e-9), 0, 0}, radius);
  Simulation s(scene);
  set_motion(s, 0, {0.5 * speed, 0, 0});
  set_motion(s, 1, {-0.5 * speed, 0, 0});
  return s;
}

Strike strike(Simulation& s, double expected_duration, int steps_per_contact,
              const std::function<void(const ImpactMoment&)>& watch) {
  const bool at_wall = !s.walls.empty();
  const auto radius = [&](int c) { return s.balls.radius_of_id(c); };
  const double reach = at_wall ? radius(0) : radius(0) + radius(1);
  const auto distance = [&] {
    return at_wall ? clump(s, 0).position.z : norm(clump(s, 1).position - clump(s, 0).position);
  };
  s.set_time_step(expected_duration / steps_per_contact);
  Strike out;
  int touching = 0;
  for (int k = 0; k < 4 * steps_per_contact && !out.is_over; ++k) {
    const double overlap = reach - distance();
    s.step();
    const std::ptrdiff_t row = at_wall ? wall_row(s, 0, 0) : pair_row(s, 0, 1);
    const double force = row < 0 ? 0.0 : norm(s.contacts.force(static_cast<std::size_t>(row)));
    out.overlap = std::max(out.overlap, overlap);
    out.force = std::max(out.force, force);
    if (overlap > 0.0) ++touching;
    if (overlap > 0.0 && watch) watch({touching * s.time_step(), overlap, force});
    out.is_over = touching > 0 && overlap < 0.0;
  }
  out.duration = touching * s.time_step();
  const Vec3 along = at_wall ? Vec3{0, 0, 1} : Vec3{1, 0, 0};
  out.rebound = dot(at_wall ? clump(s, 0).velocity : clump(s, 1).velocity - clump(s, 0).velocity, along);
  return out;
}

}  // namespace dem::verify
