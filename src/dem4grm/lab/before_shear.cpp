// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/lab/before_shear.hpp"

#include <cmath>

#include "dem4grm/walls/shear_box.hpp"

namespace dem {

LateralStress measure_lateral_stress(const Simulation& s, const BoxSettings& box) {
  const auto force = [&](int wall) { return s.reactions[static_cast<std::size_t>(wall)].force; };
  // Walls of one side: that of the lower and that of the upper half.
  const auto on_side = [&](int side, double Vec3::*axis) {
    return std::fabs(force(side).*axis + force(side + ShearBox::k_top_plate).*axis);
  };
  const double height = s.walls[ShearBox::k_top_plate].corner.z;
  const double vertical = 0.5 *
                          (std::fabs(force(ShearBox::k_top_plate).z) + std::fabs(force(ShearBox::k_bottom_plate).z)) /
                          (box.length * box.width);
  const double along = on_side(ShearBox::k_side_x_min, &Vec3::x) + on_side(ShearBox::k_side_x_max, &Vec3::x);
  const double across = on_side(ShearBox::k_side_y_min, &Vec3::y) + on_side(ShearBox::k_side_y_max, &Vec3::y);
  return {along / (2.0 * box.width * height) / vertical, across / (2.0 * box.length * height) / vertical};
}

}  // namespace dem
