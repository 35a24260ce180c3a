// SPDX-License-Identifier: BSD-3-Clause
// Oblique impacts of a sphere on a plane and on an equal sphere, one impact for each angle, side by side in one scene.
#include "peer_cases.hpp"

namespace dem::peers {

namespace {

constexpr double k_apart = 0.05;  // m between impacts

struct ImpactScene {
  bool at_wall = true;
  double speed = 0.0;  // m/s, relative
  std::string rule;    // kept: hz_mode 0; rescaled: hz_mode 1; damped: hz_mode 0 with a normal dashpot
};

std::string name_of(const ImpactScene& c) {
  return std::string("impact-") + (c.at_wall ? "wall" : "pair") + "-" + (c.speed > 1.0 ? "fast" : "slow") + "-" +
         c.rule;
}

Scene scene_of(const Json& p, const ImpactScene& c) {
  Scene scene = model_scene();
  scene.gravel = material_of(p);
  scene.walls = scene.gravel;
  scene.contact.hz_mode = c.rule == "rescaled" ? 1 : 0;
  if (c.rule == "damped") scene.contact.normal_damping_ratio = damping_ratio_of_tsuji(p.at("restitution_of_tsuji"));
  const double r = p.at("radius"), touching = r * (1 + 1e-9);
  const std::size_t n = p.at("angles_deg").size();
  if (c.at_wall) {
    scene.wall_list = {make_wall("plane", {-1, -1, 0}, {3, 0, 0}, {0, 2, 0})};
    scene.wall_list[0].friction = p.at("friction");
  }
  for (std::size_t k = 0; k < n; ++k) {
    const double x = k_apart * static_cast<double>(k);
    add_sphere(scene, {x, 0, c.at_wall ? touching : 2 * r + 2 * touching}, r);
    if (!c.at_wall) add_sphere(scene, {x, 0, 2 * r}, r);
  }
  return scene;
}

/// Longest Hertz contact of the scene over that of the head-on impact, and the head-on one (s): t = 2.943 d_max / v.
double head_on_duration(const Json& p, const ImpactScene& c) {
  const double r = p.at("radius"), nu = p.at("poisson"), young = p.at("young"), density = p.at("density");
  const double modulus = young / (2 * (1 - nu * nu)), whole = density * 4.0 / 3.0 * k_pi * r * r * r;
  const double mass = c.at_wall ? whole : 0.5 * whole, radius = c.at_wall ? r : 0.5 * r;
  return 2.943 / c.speed * std::pow(15.0 * mass * c.speed * c.speed / (16.0 * modulus * std::sqrt(radius)), 0.4);
}

void run_one(const Json& p, const ImpactScene& c, const Folder& folder) {
  const std::string name = name_of(c);
  Simulation s(scene_of(p, c));
  const auto angles = p.at("angles_deg").get<std::vector<double>>();
  const std::size_t each = c.at_wall ? 1 : 2;
  double slowest = 1.0;
  for (std::size_t k = 0; k < angles.size(); ++k) {
    const double angle = angles[k] * k_pi / 180.0, share = c.at_wall ? 1.0 : 0.5;
    const Vec3 v{c.speed * std::sin(angle), 0, -c.speed * std::cos(angle)};
    slowest = std::min(slowest, std::cos(angle));
    set_motion(s, each * k, v * share);
    if (!c.at_wall) set_motion(s, each * k + 1, v * -share);
  }
  const double duration = head_on_duration(p, c), per_contact = p.at("steps_per_contact");
  s.set_time_step(duration / per_contact);
  // Time of contact grows as v_n^(-1/5); dashpots lengthen it a little.
  const int steps = static_cast<int>(1.3 * per_contact * std::pow(slowest, -0.2));

  write_json(folder / (name + ".json"),
             {{"time_step", s.time_step()},
              {"steps", steps},
              {"at_wall", c.at_wall},
              {"rule", c.rule},
              {"restitution_of_tsuji", c.rule == "damped" ? p.at("restitution_of_tsuji") : Json(1.0)},
              {"damping_ratio", s.scene.contact.normal_damping_ratio}});
  Table start(folder / (name + ".start.csv"), "radius,x,y,z,vx,vy,vz");
  for (const Clump& b : s.clumps.clumps) {
    start.row(0.5 * b.size, b.position.x, b.position.y, b.position.z, b.velocity.x, b.velocity.y, b.velocity.z);
  }
  run_steps(s, steps);
  Table result(folder / (name + ".ours.csv"), "vx,vy,vz,wx,wy,wz");
  for (const Clump& b : s.clumps.clumps) {
    result.row(b.velocity.x, b.velocity.y, b.velocity.z, b.spin.x, b.spin.y, b.spin.z);
  }
}

}  // namespace

void run_impacts(const Json& parameters, const Folder& folder) {
  for (const bool at_wall : {true, false}) {
    for (const double speed : parameters.at("speeds")) {
      for (const char* rule : {"kept", "rescaled", "damped"}) run_one(parameters, {at_wall, speed, rule}, folder);
    }
  }
}

}  // namespace dem::peers
