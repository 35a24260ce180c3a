// SPDX-License-Identifier: BSD-3-Clause
// A thousand spheres in a closed box under a lid that moves down slowly.
#include "dem4grm/core/random.hpp"
#include "peer_cases.hpp"

namespace dem::peers {

namespace {

constexpr std::size_t k_lid = 5;  // index in closed_box

struct Packing {
  Vec3 size;  ///< m, of the box
  std::vector<Vec3> at;
  std::vector<double> radius;
};

Scene scene_of(const Json& p, const Packing& packing, double friction) {
  Scene scene = model_scene();
  scene.gravel = material_of(p);
  scene.gravel.friction = friction;
  scene.walls = scene.gravel;
  scene.wall_list = closed_box(packing.size, friction);
  for (std::size_t k = 0; k < packing.at.size(); ++k) add_sphere(scene, packing.at[k], packing.radius[k]);
  return scene;
}

Packing loose_packing(const Json& p) {
  const double cell = p.at("cell");
  const auto range = p.at("radius").get<std::vector<double>>();
  const int across = p.at("cells_across"), count = p.at("count");
  Packing out;
  for (int k = 0; k < count; ++k) {
    RandomSequence random(p.at("seed"), RandomStream::test, static_cast<std::uint64_t>(k));
    const double r = random.uniform(range.at(0), range.at(1)), play = 0.5 * cell - r;
    const Vec3 corner{static_cast<double>(k % across), static_cast<double>(k / across % across),
                      static_cast<double>(k / (across * across))};
    const Vec3 shift{random.uniform(-play, play), random.uniform(-play, play), random.uniform(-play, play)};
    out.at.push_back((corner + Vec3{0.5, 0.5, 0.5}) * cell + shift);
    out.radius.push_back(r);
  }
  const int layers = (count - 1) / (across * across) + 1;
  out.size = {across * cell, across * cell, layers * cell};
  return out;
}

double lid_force(const Simulation& s) { return s.reactions[k_lid].force.z; }

/// Presses the loose spheres together until the lid carries the packing force, lets them come to rest, and takes them
/// apart again by stretching all distances a little, so that no contact has a history at the start.
Packing dense_packing(const Json& p) {
  Packing packing = loose_packing(p);
  Scene scene = scene_of(p, packing, p.at("packing_friction"));
  scene.integration.local_damping = 0.5;
  Simulation s(scene);
  s.set_time_step(2.0 * p.at("time_step").get<double>());
  s.servo = {static_cast<int>(k_lid), p.at("packing_force"), 0.3, p.at("packing_speed")};
  run_until(s, 200000, [&] { return s.steps > 1000 && lid_force(s) > p.at("packing_force").get<double>(); });
  s.servo.speed_cap *= 0.02;
  run_steps(s, 10000);
  const double stretch = 1.0 + p.at("opened_by").get<double>();
  packing.size = Vec3{packing.size.x, packing.size.y, s.walls[k_lid].corner.z} * stretch;
  for (std::size_t k = 0; k < packing.at.size(); ++k) packing.at[k] = clump(s, k).position * stretch;
  return packing;
}

int steps_per_sample(const Json& p, const Packing& packing) {
  const double path = packing.size.z * p.at("strain").get<double>();
  const double per_step = p.at("lid_speed").get<double>() * p.at("time_step").get<double>();
  return static_cast<int>(std::lround(path / per_step / p.at("samples").get<double>()));
}

/// Moves the lid down and writes the forces on the walls, compression positive, after equal steps of displacement.
void compress(const Json& p, const Packing& packing, double damping_ratio, const Folder& result_path) {
  Scene scene = scene_of(p, packing, p.at("friction"));
  scene.contact.normal_damping_ratio = damping_ratio;
  Simulation s(scene);
  s.set_time_step(p.at("time_step"));
  const double speed = p.at("lid_speed");
  const int samples = p.at("samples"), every = steps_per_sample(p, packing);
  s.walls[k_lid].velocity = {0, 0, -speed};
  Table result(result_path, "displacement,lid,floor,x_low,x_high,y_low,y_high");
  for (int k = 1; k <= samples; ++k) {
    run_steps(s, k == 1 ? every + 1 : every);  // the forces of step n + 1 belong to the positions after n steps
    const auto& r = s.reactions;
    result.row(speed * s.time_step() * every * k, r[5].force.z, -r[0].force.z, -r[1].force.x, r[2].force.x,
               -r[3].force.y, r[4].force.y);
  }
}

}  // namespace

void run_compression(const Json& parameters, const Folder& folder) {
  const Packing packing = dense_packing(parameters);
  // The same with every sphere moved by a trifle: how far the answer itself is determined.
  Packing disturbed = packing;
  double solid = 0.0;
  for (std::size_t k = 0; k < packing.at.size(); ++k) {
    RandomSequence random(1, RandomStream::test, k);
    const double d = parameters.at("disturbance"), r = packing.radius[k];
    disturbed.at[k] += Vec3{random.uniform(-d, d), random.uniform(-d, d), random.uniform(-d, d)};
    solid += 4.0 / 3.0 * k_pi * r * r * r;
  }
  const double restitution = parameters.at("restitution_of_tsuji");
  for (const bool damped : {false, true}) {
    const std::string name = damped ? "compression-damped" : "compression-elastic";
    const double damping_ratio = damped ? damping_ratio_of_tsuji(restitution) : 0.0;
    write_json(folder / (name + ".json"), {{"size", {packing.size.x, packing.size.y, packing.size.z}},
                                           {"every", steps_per_sample(parameters, packing)},
                                           {"solid_volume", solid},
                                           {"rule", damped ? "damped" : "kept"},
                                           {"restitution_of_tsuji", restitution},
                                           {"damping_ratio", damping_ratio}});
    Table start(folder / (name + ".start.csv"), "radius,x,y,z,vx,vy,vz");
    for (std::size_t k = 0; k < packing.at.size(); ++k) {
      const Vec3& a = packing.at[k];
      start.row(packing.radius[k], a.x, a.y, a.z, 0.0, 0.0, 0.0);
    }
    compress(parameters, packing, damping_ratio, folder / (name + ".ours.csv"));
    compress(parameters, disturbed, damping_ratio, folder / (name + ".disturbed.csv"));
  }
}

}  // namespace dem::peers
