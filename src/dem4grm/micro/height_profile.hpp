// SPDX-License-Identifier: BSD-3-Clause
// What a sheared specimen is like at each height: how far grains moved and turned, how dense it is, what carries the load.
#pragma once

#include <span>
#include <vector>

#include "dem4grm/core/quaternion.hpp"
#include "dem4grm/micro/analysis.hpp"
#include "dem4grm/micro/shear_band.hpp"
#include "dem4grm/specimen/packing.hpp"

namespace dem {

/// The grains of a state. Bodies: rubber grains first, then clumps.
struct ProfileState {
  double displacement = 0.0;  ///< m, of the halves against each other
  Packing packing;
  ContactNetwork network;
  std::vector<Quaternion> orientation;  ///< [n_bodies], rubber: grain_orientation
};

/// Rotation of a deformed rubber grain: the orthogonal part R of its deformation F = R U (rubber_strain.hpp).
Quaternion grain_orientation(std::span<const Vec3> balls, double rest_length);

/// The turn from one orientation to another as a vector along its axis with the angle (rad, at most pi) as its length.
Vec3 rotation_between(const Quaternion& from, const Quaternion& to);

struct ProfileOptions {
  int layers = 0;            ///< 0: about one for each mean grain size, at least four
  double mean_size = 0.0;    ///< m, volume-weighted
  double rubber_fill = 1.0;  ///< solid volume of a rubber grain over the volume of its balls
};
/// Finer layers than this show single balls.
inline constexpr int k_most_profile_layers = 200;

/// One layer of equal thickness between the plates. Grains belong to it by the height of their centre now, contacts by that
/// of their point; solid is cut at its borders. Means over grains by number; not a number where there are none.
struct ProfileLayer {
  double low = 0.0, high = 0.0;  ///< m
  double grains = 0.0;           ///< centres
  double displacement_x = 0.0;   ///< m, mean since shear began, along the shear direction
  double displacement_z = 0.0;   ///< m, mean, up positive
  double rotation = 0.0;  ///< rad, mean turn about y; positive takes z to x, the shear of a test turns the other way
  double rotation_size = 0.0;    ///< rad, mean angle of the whole turn
  double rotation_gravel = 0.0;  ///< rad, rotation of the gravel alone
  double rotation_rubber = 0.0;  ///< rad, of the rubber alone
  double void_ratio = 0.0;       ///< nominal area times thickness over the solid in it, less 1
  double rubber_content = 0.0;   ///< of the solid volume
  double contacts = 0.0;         ///< between grains
  double strong_share = 0.0;     ///< of them, with more than the mean normal force of all contacts
};

struct StateProfile {
  double displacement = 0.0;  ///< m
  std::vector<ProfileLayer> layers;
  ShearBand band;
};

/// The profile of `now` against `start`, the state before shear; both hold the same grains. The first layer is the lowest.
StateProfile height_profile(const ProfileState& start, const ProfileState& now, const ProfileOptions& options);

}  // namespace dem
