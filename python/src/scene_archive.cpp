// SPDX-License-Identifier: BSD-3-Clause
// A user's own test as named arrays: its scene, its plates and motions, its state.
#include <algorithm>
#include <string>
#include <vector>

#include "dem4grm/core/error.hpp"
#include "dem4grm/engine/simulation_state.hpp"
#include "dem4grm/runs/checkpoint_file.hpp"
#include "own_test.hpp"

namespace dem {
namespace {

/// A list of things as one array: visit(thing, take) calls take(number) for each of the `width` numbers of a thing, which it may
/// change.
template <class Thing, class Visit>
void exchange_rows(StateArchive& archive, std::string_view name, std::vector<Thing>& things, std::size_t width,
                   const Visit& visit) {
  std::vector<double> numbers;
  if (!archive.is_loading()) {
    numbers.reserve(things.size() * width);
    for (Thing& thing : things) visit(thing, [&](auto& number) { numbers.push_back(static_cast<double>(number)); });
  }
  archive.exchange(name, numbers);
  if (!archive.is_loading()) return;
  if (numbers.size() % width != 0) throw IoError("the saved list '" + std::string(name) + "' is not whole");
  things.resize(numbers.size() / width);
  const double* next = numbers.data();
  for (Thing& thing : things) {
    visit(thing, [&](auto& number) { number = static_cast<std::decay_t<decltype(number)>>(*next++); });
  }
}

template <class Take>
void visit_vector(Vec3& v, const Take& take) {
  take(v.x), take(v.y), take(v.z);
}

template <class Take>
void visit_pose(Pose& pose, const Take& take) {
  visit_vector(pose.position, take);
  Quaternion& q = pose.orientation;
  take(q.w), take(q.x), take(q.y), take(q.z);
}

void exchange_material(StateArchive& archive, std::string_view name, MaterialSettings& m) {
  archive.group(name, [&] {
    archive.exchange("density", m.density);
    archive.exchange("friction", m.friction);
    archive.exchange("shear_modulus", m.shear_modulus);
    archive.exchange("poisson_ratio", m.poisson_ratio);
  });
}

template <class Enumeration>
void exchange_choice(StateArchive& archive, std::string_view name, Enumeration& value) {
  int number = static_cast<int>(value);
  archive.exchange(name, number);
  value = static_cast<Enumeration>(number);
}

void exchange_bond(StateArchive& archive, BondSettings& b) {
  archive.exchange("modulus", b.modulus);
  archive.exchange("stiffness_ratio", b.stiffness_ratio);
  archive.exchange("radius_multiplier", b.radius_multiplier);
  archive.exchange("moment_scale", b.moment_scale);
  archive.exchange("damping_ratio", b.damping_ratio);
  archive.exchange("tensile_strength", b.tensile_strength);
  archive.exchange("shear_strength", b.shear_strength);
  archive.exchange("linear_spring", b.linear_spring);
  archive.exchange("spring_friction", b.spring_friction);
  archive.exchange("hertz_contact", b.hertz_contact);
  exchange_choice(archive, "form", b.form);
}

void exchange_settings(StateArchive& archive, Scene& scene) {
  exchange_material(archive, "gravel", scene.gravel);
  exchange_material(archive, "rubber", scene.rubber);
  exchange_material(archive, "wall_material", scene.walls);
  archive.group("bond", [&] { exchange_bond(archive, scene.bond); });
  archive.group("contact", [&] {
    archive.exchange("hz_mode", scene.contact.hz_mode);
    archive.exchange("normal_damping_ratio", scene.contact.normal_damping_ratio);
    archive.exchange("shear_damping_ratio", scene.contact.shear_damping_ratio);
    archive.exchange("dashpot_mode", scene.contact.dashpot_mode);
  });
  archive.exchange("local_damping", scene.integration.local_damping);
  exchange_choice(archive, "time_step_rule", scene.integration.time_step_rule);
  archive.exchange("time_step_safety", scene.integration.time_step_safety);
  archive.exchange("gravity", scene.gravity);
}

/// A list whose things need groups of their own, since their lengths differ.
template <class Thing, class Content>
void exchange_groups(StateArchive& archive, std::string_view name, std::vector<Thing>& things, const Content& content) {
  archive.group(name, [&] {
    auto n = static_cast<int>(things.size());
    archive.exchange("count", n);
    things.resize(static_cast<std::size_t>(n));
    for (std::size_t k = 0; k < things.size(); ++k) {
      archive.group(std::to_string(k), [&] { content(things[k]); });
    }
  });
}

void exchange_wall(StateArchive& archive, Wall& w) {
  archive.exchange("name", w.name);
  archive.exchange("corner", w.corner);
  archive.exchange("u", w.u);
  archive.exchange("v", w.v);
  archive.exchange("normal", w.normal);
  archive.exchange("length_u", w.length_u);
  archive.exchange("length_v", w.length_v);
  archive.exchange("friction", w.friction);
  archive.exchange("velocity", w.velocity);
}

void exchange_shape(StateArchive& archive, ClumpTemplate& shape) {
  archive.exchange("name", shape.name);
  exchange_rows(archive, "pebbles", shape.pebbles, 4, [](Pebble& p, const auto& take) {
    visit_vector(p.position, take);
    take(p.radius);
  });
  archive.exchange("volume", shape.volume);
  archive.exchange("moment_of_inertia", shape.moment_of_inertia);
  archive.exchange("bounding_radius", shape.bounding_radius);
}

}  // namespace

void exchange(StateArchive& archive, Scene& scene) {
  exchange_settings(archive, scene);
  archive.exchange("rubber_ball_radius", scene.rubber_ball_radius);
  archive.exchange("rubber_ball_radii", scene.rubber_ball_radii);
  exchange_rows(archive, "grains", scene.grains, 7, [](Pose& pose, const auto& take) { visit_pose(pose, take); });
  exchange_groups(archive, "shapes", scene.shapes, [&](ClumpTemplate& shape) { exchange_shape(archive, shape); });
  exchange_rows(archive, "clumps", scene.clumps, 10, [](PlacedClump& c, const auto& take) {
    take(c.shape), take(c.size);
    visit_pose(c.pose, take);
    take(c.material);
  });
  exchange_groups(archive, "walls", scene.wall_list, [&](Wall& wall) { exchange_wall(archive, wall); });
}

void OwnTest::exchange_all(StateArchive& archive) {
  archive.group("own_test", [&] {
    archive.group("scene", [&] { exchange(archive, scene); });
    archive.exchange("fixed_step", fixed_step_);
    archive.exchange("longest_step", longest_step_);
    exchange_rows(archive, "plates", plates, 9, [](LoadedPlate& p, const auto& take) {
      take(p.servo.wall), take(p.servo.target_force), take(p.servo.gain), take(p.servo.speed_cap), take(p.stress);
      for (int& side : p.sides) take(side);
    });
    exchange_groups(archive, "motions", motions, [&](WallMotion& motion) {
      archive.exchange("wall", motion.wall);
      archive.exchange("times", motion.times);
      exchange_rows(archive, "velocities", motion.velocities, 3,
                    [](Vec3& v, const auto& take) { visit_vector(v, take); });
    });
  });
  if (archive.is_loading()) build();
  archive.group("state", [&] { exchange(archive, *simulation_); });
}

void OwnTest::save(const std::filesystem::path& path) {
  build();
  StateArchive archive;
  exchange_all(archive);
  write_checkpoint(path, archive, {});
}

std::unique_ptr<OwnTest> OwnTest::load(const std::filesystem::path& path) {
  StoredCheckpoint stored = read_checkpoint(path);
  if (!stored.state.has_group("own_test")) {
    throw IoError(path.string() +
                  ": this is the checkpoint of a case, which dem4grm.run goes on with, and no test of "
                  "one's own");
  }
  auto test = std::make_unique<OwnTest>();
  test->exchange_all(stored.state);
  return test;
}

}  // namespace dem
