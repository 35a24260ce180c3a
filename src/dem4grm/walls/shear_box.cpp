// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/walls/shear_box.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace dem {

namespace {

/// Four sides of a half between two heights, normals inward.
void add_sides(std::vector<Wall>& walls, const char* half, const BoxSettings& s, double bottom, double top) {
  const std::string name = half;
  const double l = s.length, w = s.width, h = top - bottom;
  walls.push_back(make_wall(name + " wall -x", {0, 0, bottom}, {0, w, 0}, {0, 0, h}));
  walls.push_back(make_wall(name + " wall +x", {l, 0, bottom}, {0, 0, h}, {0, w, 0}));
  walls.push_back(make_wall(name + " wall -y", {0, 0, bottom}, {0, 0, h}, {l, 0, 0}));
  walls.push_back(make_wall(name + " wall +y", {0, w, bottom}, {l, 0, 0}, {0, 0, h}));
}

/// The flanks of one plate at the height z of its mean plane; up: the grains lie above it.
void add_ribs(std::vector<Wall>& walls, const BoxSettings& s, int plate, double z, bool up) {
  const double pitch = s.plate_roughness_pitch > 0.0 ? s.plate_roughness_pitch : 2.0 * s.plate_roughness;
  const int ribs = std::max(1, static_cast<int>(std::lround(s.length / pitch)));
  const double half = 0.5 * s.length / ribs, height = up ? s.plate_roughness : -s.plate_roughness;
  for (int k = 0; k < 2 * ribs; ++k) {
    const bool to_crest = k % 2 == 0;
    const Vec3 begin{k * half, 0, z + (to_crest ? -0.5 : 0.5) * height};
    const Vec3 flank{half, 0, to_crest ? height : -height}, across{0, s.width, 0};
    const std::string name = walls[static_cast<std::size_t>(plate)].name + " rib " + std::to_string(k / 2);
    walls.push_back(up ? make_wall(name, begin, flank, across) : make_wall(name, begin, across, flank));
    walls.back().carrier = plate;
  }
  walls[static_cast<std::size_t>(plate)].is_solid = false;
}

}  // namespace

ShearBox::ShearBox(const BoxSettings& settings, double plate_height)
    : ShearBox(settings, plate_height, 0.5 * settings.height) {}

ShearBox::ShearBox(const BoxSettings& settings, double plate_height, double split) : settings_(settings) {
  const double l = settings.length, w = settings.width;
  const double lower_top = split - 0.5 * settings.gap, upper_bottom = split + 0.5 * settings.gap;
  walls_.push_back(make_wall("bottom plate", {0, 0, 0}, {l, 0, 0}, {0, w, 0}));
  add_sides(walls_, "lower", settings, -reach_beyond_plates(settings), lower_top);
  walls_.push_back(make_wall("lower wing", {-settings.wing, 0, lower_top}, {settings.wing, 0, 0}, {0, w, 0}));
  walls_.push_back(make_wall("top plate", {0, 0, plate_height}, {0, w, 0}, {l, 0, 0}));
  add_sides(walls_, "upper", settings, upper_bottom, settings.upper_height);
  walls_.push_back(make_wall("upper wing", {l, 0, upper_bottom}, {0, w, 0}, {settings.wing, 0, 0}));
  if (settings.plate_roughness == 0.0) return;
  add_ribs(walls_, settings, k_bottom_plate, 0.0, true);
  add_ribs(walls_, settings, k_top_plate, plate_height, false);
}

void ShearBox::set_plate_friction(std::vector<Wall>& walls, double friction) {
  for (std::size_t w = 0; w < walls.size(); ++w) {
    const int plate = walls[w].carrier >= 0 ? walls[w].carrier : static_cast<int>(w);
    if (plate == k_bottom_plate || plate == k_top_plate) walls[w].friction = friction;
  }
}

std::array<Bounds, 2> ShearBox::rooms_of(const std::vector<Wall>& walls) {
  const Wall &bottom = walls[k_bottom_plate], &top = walls[k_top_plate];
  const Wall &lower_side = walls[k_side_x_min], &upper_side = walls[k_top_plate + k_side_x_min];
  const double length = bottom.length_u, width = bottom.length_v;
  const double lower_top = lower_side.corner.z + lower_side.length_v, upper_bottom = upper_side.corner.z;
  const Vec3 low = lower_side.corner, high = upper_side.corner;
  const double beyond = bottom.corner.z - low.z;  // the plates, into the valleys of their ribs
  return {Bounds{{low.x, low.y, low.z}, {low.x + length, low.y + width, upper_bottom}},
          Bounds{{high.x, high.y, lower_top}, {high.x + length, high.y + width, top.corner.z + beyond}}};
}

double ShearBox::split_height(const std::vector<Wall>& walls) {
  const auto [lower, upper] = rooms_of(walls);
  return 0.5 * (lower.high.z + upper.low.z);
}

void ShearBox::part_at(std::vector<Wall>& walls, const BoxSettings& settings, double height) {
  const ShearBox other(settings, walls[k_top_plate].corner.z, height);
  for (std::size_t w = 0; w < walls.size(); ++w) {
    walls[w].corner = other.walls()[w].corner;
    walls[w].length_u = other.walls()[w].length_u;
    walls[w].length_v = other.walls()[w].length_v;
  }
}

void ShearBox::set_velocities(std::vector<Wall>& walls, MovingHalf moving, double shear_velocity,
                              double plate_velocity) {
  double lower = 0.0, upper = 0.0;
  switch (moving) {
    case MovingHalf::lower:
      lower = shear_velocity;
      break;
    case MovingHalf::upper:
      upper = -shear_velocity;
      break;
    case MovingHalf::both:
      lower = 0.5 * shear_velocity;
      upper = -0.5 * shear_velocity;
      break;
  }
  for (int i = 0; i < k_walls; ++i) {
    walls[static_cast<std::size_t>(i)].velocity = {half_of(i) == BoxHalf::lower ? lower : upper, 0, 0};
  }
  walls[k_top_plate].velocity.z = plate_velocity;
  for (Wall& wall : walls) {
    if (wall.carrier >= 0) wall.velocity = walls[static_cast<std::size_t>(wall.carrier)].velocity;
  }
}

}  // namespace dem
