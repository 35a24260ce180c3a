// SPDX-License-Identifier: BSD-3-Clause
// The shear box: two halves with wings, and the plate on top.
//
//        upper half (walls from the split plane up)        plate, moves in z only within the upper half
//          |==================================|
//          |                                  |  upper wing
//   _______|                                  |_________     split plane, BoxSettings::split_plane
//   lower wing |                                  |
//              |                                  |
//              |__________________________________|
//              lower half, moved in +x against the upper one
//
// Axes: x shear direction, y width, z up; corner of the closed box at the origin. The wings close the openings that the
// halves leave when they part. All lateral walls and wings are frictionless; the plates get their friction for the
// test.
#pragma once

#include <array>
#include <vector>

#include "dem4grm/core/bounds.hpp"
#include "dem4grm/walls/box_settings.hpp"
#include "dem4grm/walls/wall.hpp"

namespace dem {

enum class BoxHalf : unsigned char { lower, upper };

/// The walls of a shear box and how they move. Wall indices are fixed: see the constants.
///
/// Rough plates have ribs across the shear direction, of triangular section: two flanks for each of round(length / pitch) ribs,
/// from valley to crest and down again. The plate itself is then the mean plane of its ribs, half a rib's height from crests and
/// valleys; grains do not see it, but it carries the ribs, whose forces count as its own. So the height between the plates times the
/// area is the volume between them, rough or smooth. Ribs stand behind the twelve walls, those of the bottom plate first.
class ShearBox {
 public:
  static constexpr int k_bottom_plate = 0;
  static constexpr int k_top_plate = 6;
  static constexpr int k_walls = 12;
  /// Of the lower half; those of the upper half stand k_top_plate later.
  static constexpr int k_side_x_min = 1, k_side_x_max = 2, k_side_y_min = 3, k_side_y_max = 4;

  /// plate_height: z of the top plate, m. The halves part at half of settings.height.
  ShearBox(const BoxSettings& settings, double plate_height);
  /// They part at split_height, m.
  ShearBox(const BoxSettings& settings, double plate_height, double split_height);

  /// Walls 0 to 5: bottom plate, four sides and wing of the lower half; 6 to 11: top plate, sides and wing of the
  /// upper.
  [[nodiscard]] const std::vector<Wall>& walls() const { return walls_; }
  [[nodiscard]] std::vector<Wall>& walls() { return walls_; }
  static BoxHalf half_of(int wall) { return wall < k_top_plate ? BoxHalf::lower : BoxHalf::upper; }

  /// Where the centre of a ball may be: the lower half and the upper half, each with the gap between them, as they stand.
  /// A centre that lies in neither has passed a wall or is on its way out through the gap.
  static std::array<Bounds, 2> rooms_of(const std::vector<Wall>& walls);

  /// Half the height of the ribs: how far grains reach beyond a plate, m.
  static double reach_beyond_plates(const BoxSettings& settings) { return 0.5 * settings.plate_roughness; }

  /// Friction of both plates with all their ribs.
  static void set_plate_friction(std::vector<Wall>& walls, double friction);

  /// Height of the plane at which the halves part, in the middle of the gap, m.
  static double split_height(const std::vector<Wall>& walls);

  /// Moves the plane at which the halves part, before they have moved against each other. Walls that touch a grain keep
  /// pushing it alike: the sides are frictionless planes through both halves. height: of the plane, m.
  static void part_at(std::vector<Wall>& walls, const BoxSettings& settings, double height);

  /// Velocities of all walls for a relative shear velocity (lower against upper, in +x) and a plate velocity (up), m/s.
  static void set_velocities(std::vector<Wall>& walls, MovingHalf moving, double shear_velocity, double plate_velocity);

  [[nodiscard]] double nominal_area() const { return settings_.length * settings_.width; }

 private:
  BoxSettings settings_;
  std::vector<Wall> walls_;
};

}  // namespace dem
