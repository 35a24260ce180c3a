// SPDX-License-Identifier: BSD-3-Clause
// Settings of the shear box and of the plate servo, in SI units.
#pragma once

#include <cstdint>

namespace dem {

/// Where the halves part: at half of the nominal height, or at half of the specimen's height under its normal stress.
enum class SplitPlane : std::uint8_t { nominal, specimen };

struct BoxSettings {
  double length = 0.100;        ///< m, along x, the shear direction
  double width = 0.100;         ///< m, along y
  double height = 0.053;        ///< m, nominal height of the specimen
  double upper_height = 0.080;  ///< m, height of the upper walls
  double gap = 0.0;             ///< m, between the halves
  double wing = 0.020;          ///< m, length of the wings
  SplitPlane split_plane = SplitPlane::nominal;
  double plate_roughness = 0.0;        ///< m, height of the ribs of both plates; 0: smooth
  double plate_roughness_pitch = 0.0;  ///< m, from crest to crest; 0: twice the height
};

struct ServoSettings {
  double gain = 0.5;              ///< share of the force error removed per step
  double shear_speed_cap = 0.01;  ///< m/s; the larger of this and the shear velocity holds
};

enum class MovingHalf : std::uint8_t { lower, upper, both };

}  // namespace dem
