// SPDX-License-Identifier: BSD-3-Clause
// Our side of the comparison of speed with other codes (bench/peers/compare.py starts it).
//
//   bench_peer_scenes make FOLDER              writes SCENE.csv (body, radius, x, y, z) and SCENE.box for every scene
//   bench_peer_scenes run FOLDER SCENE STEPS   steps it and prints: balls, touching pairs, seconds
//
// Scenes: 20,000 spheres at rest under an isotropic pressure; 5,200 clumps of three balls, 1,000 and 6,000 clusters of
// 35 bonded balls as dense assemblies. Nothing moves noticeably while it is timed: no list of neighbours is built anew.
#include <cmath>
#include <fstream>
#include <sstream>

#include "../support.hpp"
#include "dem4grm/core/random.hpp"
#include "dem4grm/core/space_curve.hpp"
#include "dem4grm/engine/observe.hpp"
#include "dem4grm/verify/scenes.hpp"

namespace {

using namespace dem;
namespace fs = std::filesystem;

constexpr int k_spheres = 20000, k_clumps = 5200;
constexpr double k_friction = 0.5;

Scene materials() {
  Scene s = verify::model_scene();
  s.gravel.friction = s.rubber.friction = k_friction;
  s.walls = s.gravel;
  return s;
}

// ---- making

struct Row {
  int body = 0;
  double radius = 0.0;
  Vec3 position;
};

void write(const fs::path& folder, const std::string& scene, const std::vector<Row>& rows, const Vec3& size) {
  std::ofstream table(folder / (scene + ".csv"));
  table << "body,radius,x,y,z\n";
  for (const Row& r : rows) {
    table << fmt::format("{},{},{},{},{}\n", r.body, r.radius, r.position.x, r.position.y, r.position.z);
  }
  std::ofstream(folder / (scene + ".box")) << fmt::format("{} {} {}\n", size.x, size.y, size.z);
}

std::vector<Row> rows_of(const Simulation& s) {
  std::vector<Row> rows;
  rows.reserve(static_cast<std::size_t>(s.balls.n_balls()));
  for (int id = 0; id < s.balls.n_balls(); ++id) {
    rows.push_back({s.body_of_ball(id), s.balls.radius_of_id(id), s.balls.position(s.balls.index_of_id(id))});
  }
  return rows;
}

/// Loose spheres of 1.9 to 2.1 mm are pressed together by a lid until they are at rest at 100 kPa. Little friction
/// while that goes on: a solid fraction near 0.62.
void make_spheres(const fs::path& folder) {
  constexpr double k_cell = 4.6e-3;
  constexpr int k_across = 26;
  Scene scene = materials();
  scene.gravel.friction = 0.05;
  scene.integration.local_damping = 0.5;
  double solid = 0.0;
  for (int k = 0; k < k_spheres; ++k) {
    RandomSequence random(1, RandomStream::test, static_cast<std::uint64_t>(k));
    const double r = random.uniform(1.9e-3, 2.1e-3), play = 0.5 * k_cell - r;
    const int layer = k / (k_across * k_across), row = k / k_across % k_across, column = k % k_across;
    const Vec3 cell{column + 0.5, row + 0.5, layer + 0.5};
    verify::add_sphere(
        scene,
        cell * k_cell + Vec3{random.uniform(-play, play), random.uniform(-play, play), random.uniform(-play, play)}, r);
    solid += 4.0 / 3.0 * verify::k_pi * r * r * r;
  }
  const int layers = (k_spheres - 1) / (k_across * k_across) + 1;
  const Vec3 size{k_across * k_cell, k_across * k_cell, layers * k_cell};
  scene.wall_list = verify::closed_box(size);
  Simulation s(scene);
  constexpr std::size_t k_lid = 5;
  s.set_time_step(2e-6);
  s.servo = {static_cast<int>(k_lid), 100e3 * size.x * size.y, 0.3, 2.0};
  for (int k = 0; k < 60000; ++k) s.step();
  const double height = s.walls[k_lid].corner.z;
  std::fprintf(stderr, "spheres: solid fraction %.4f, %.2f contacts per sphere\n", solid / (size.x * size.y * height),
               static_cast<double>(balance(s).active_contacts) / k_spheres);
  write(folder, "spheres", rows_of(s), {size.x, size.y, height});
}

/// Three equal balls in a bent row, each 0.6 diameters from the next.
ClumpTemplate three_balls() {
  return make_clump_template("three", {{{-1.2, 0, 0}, 1}, {{0, 0, 0}, 1}, {{0.6, 1.04, 0}, 1}});
}

Scene assembly_scene(const GrainList& grains, Vec3& size) {
  const double n = static_cast<double>(grains.gravel.size()) + grains.rubber_count;
  const double across = std::floor(std::cbrt(n)) * std::cbrt(k_dense_cell_volume * grains.solid_volume() / n);
  DenseAssembly assembly = make_dense_assembly(grains, materials(), across, across, 1);
  size = {across, across, assembly.height};
  assembly.scene.wall_list = verify::closed_box(size, k_friction);
  return std::move(assembly.scene);
}

Scene clump_scene(Vec3& size) {
  constexpr double k_size = 5e-3;
  GrainList grains;
  grains.shapes = {three_balls()};
  grains.gravel.assign(k_clumps, {0, k_size});
  grains.gravel_volume = k_clumps * grains.shapes[0].volume * k_size * k_size * k_size;
  return assembly_scene(grains, size);
}

Scene cluster_scene(int n, Vec3& size) {
  GrainList grains;
  grains.rubber_count = n;
  grains.rubber_ball_radius = 0.627e-3;
  grains.rubber_volume = n * 5.06e-8;  // solid volume of a grain of 3.7 mm
  return assembly_scene(grains, size);
}

Scene sphere_scene(const fs::path& folder, Vec3& size) {
  std::ifstream box(folder / "spheres.box"), table(folder / "spheres.csv");
  if (!(box >> size.x >> size.y >> size.z)) throw IoError("spheres.box is not there; make the scenes first");
  Scene scene = materials();
  std::string line;
  std::getline(table, line);
  while (std::getline(table, line)) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream numbers(line);
    int body = 0;
    double radius = 0.0;
    Vec3 position;
    numbers >> body >> radius >> position.x >> position.y >> position.z;
    verify::add_sphere(scene, position, radius);
  }
  sort_along_curve(scene.clumps, [](const PlacedClump& c) { return c.pose.position; });
  scene.wall_list = verify::closed_box(size, k_friction);
  return scene;
}

Scene scene_of(const fs::path& folder, const std::string& name, Vec3& size) {
  if (name == "spheres") return sphere_scene(folder, size);
  if (name == "clumps") return clump_scene(size);
  if (name == "clusters-1000") return cluster_scene(1000, size);
  if (name == "clusters-6000") return cluster_scene(6000, size);
  throw InputError(name + ": no such scene");
}

void make_all(const fs::path& folder) {
  fs::create_directories(folder);
  if (!fs::exists(folder / "spheres.csv")) make_spheres(folder);
  for (const char* name : {"clumps", "clusters-1000", "clusters-6000"}) {
    Vec3 size;
    const Simulation s(scene_of(folder, name, size));
    write(folder, name, rows_of(s), size);
  }
}

void run(const fs::path& folder, const std::string& name, int steps) {
  Vec3 size;
  Simulation s(scene_of(folder, name, size));
  s.set_time_step(k_frozen_time_step);
  for (int k = 0; k < steps / 10 + 2; ++k) s.step();
  const double seconds = 1e-6 * bench::time_of([&] {
                           for (int k = 0; k < steps; ++k) s.step();
                         });
  fmt::print("{} {} {}\n", s.balls.n_balls(), balance(s).active_contacts, seconds);
}

}  // namespace

int main(int argc, char** argv) {
  return bench::run_benchmark(argc, "bench_peer_scenes make FOLDER | run FOLDER SCENE STEPS", [&] {
    const std::string verb = argv[1];
    if (verb == "make" && argc == 3) {
      make_all(argv[2]);
    } else if (verb == "run" && argc == 5) {
      run(argv[2], argv[3], std::atoi(argv[4]));
    } else {
      return 64;
    }
    return 0;
  });
}
