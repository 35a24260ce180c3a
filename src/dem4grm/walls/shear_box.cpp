// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/walls/shear_box.hpp"

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

}  // namespace

ShearBox::ShearBox(const BoxSettings& settings, double plate_height)
    : ShearBox(settings, plate_height, 0.5 * settings.height) {}

ShearBox::ShearBox(const BoxSettings& settings, double plate_height, double split) : settings_(settings) {
  const double l = settings.length, w = settings.width;
  const double lower_top = split - 0.5 * settings.gap, upper_bottom = split + 0.5 * settings.gap;
  walls_.push_back(make_wall("bottom plate", {0, 0, 0}, {l, 0, 0}, {0, w, 0}));
  add_sides(walls_, "lower", settings, 0.0, lower_top);
  walls_.push_back(make_wall("lower wing", {-settings.wing, 0, lower_top}, {settings.wing, 0, 0}, {0, w, 0}));
  walls_.push_back(make_wall("top plate", {0, 0, plate_height}, {0, w, 0}, {l, 0, 0}));
  add_sides(walls_, "upper", settings, upper_bottom, settings.upper_height);
  walls_.push_back(make_wall("upper wing", {l, 0, upper_bottom}, {0, w, 0}, {settings.wing, 0, 0}));
}

std::array<Bounds, 2> ShearBox::rooms_of(const std::vector<Wall>& walls) {
  const Wall &bottom = walls[k_bottom_plate], &top = walls[k_top_plate];
  const Wall &lower_side = walls[k_side_x_min], &upper_side = walls[k_top_plate + k_side_x_min];
  const double length = bottom.length_u, width = bottom.length_v;
  const double lower_top = lower_side.corner.z + lower_side.length_v, upper_bottom = upper_side.corner.z;
  const Vec3 low = lower_side.corner, high = upper_side.corner;
  return {Bounds{{low.x, low.y, bottom.corner.z}, {low.x + length, low.y + width, upper_bottom}},
          Bounds{{high.x, high.y, lower_top}, {high.x + length, high.y + width, top.corner.z}}};
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
}

}  // namespace dem
