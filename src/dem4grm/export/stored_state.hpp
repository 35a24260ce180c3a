// SPDX-License-Identifier: BSD-3-Clause
// One stored state with everything that an export shows of it, read back from results.h5 or specimen.h5.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "dem4grm/core/quaternion.hpp"
#include "dem4grm/micro/analysis.hpp"
#include "dem4grm/results/hdf5_handle.hpp"
#include "dem4grm/specimen/packing.hpp"

namespace dem {

/// Densities of the case that a file was written for, kg/m3.
struct GrainDensities {
  double gravel = 0.0;        ///< of the solid
  double rubber_balls = 0.0;  ///< of the balls of a rubber grain
  double rubber_solid = 0.0;  ///< its mass over this is its solid volume
};

/// A wall as it is stored.
struct StoredWall {
  std::string name;
  Vec3 corner;                            ///< m
  Vec3 u, v;                              ///< unit vectors along the sides
  double length_u = 0.0, length_v = 0.0;  ///< m
  Vec3 force;                             ///< N, of the grains on the wall
  Vec3 velocity;                          ///< m/s
  double friction = 0.0;
  int carrier = -1;  ///< row of the plate that a rib belongs to
};

/// A state of any test. Bodies count rubber grains first, then clumps.
struct StoredState {
  std::string name;           ///< "0003"
  double displacement = 0.0;  ///< m, of the halves of the box or of the plates
  Packing packing;
  std::vector<Vec3> ball_velocity;  ///< [n_balls] m/s
  MicroState micro;
  std::vector<Quaternion> orientation;  ///< [n_bodies]; of a rubber grain the rotation of its deformation
  std::vector<Vec3> clump_velocity;     ///< [n_clumps] m/s
  std::vector<Vec3> clump_spin;         ///< [n_clumps] rad/s
  std::vector<double> clump_mass;       ///< [n_clumps] kg
  std::vector<double> clump_size;       ///< [n_clumps] m, smallest square opening
  std::vector<int> clump_shape;         ///< [n_clumps] row of the shapes
  std::vector<StoredWall> walls;

  [[nodiscard]] std::size_t n_bodies() const { return orientation.size(); }
  [[nodiscard]] std::size_t n_rubber() const { return static_cast<std::size_t>(packing.n_rubber_grains); }
};

/// Reads /frames/NAME. Throws IoError when it is damaged or its lists do not fit together.
StoredState read_stored_state(const hdf5::Handle& file, const std::string& name);

/// From the case in /meta. Of a grain compression, whose case does not say it, rubber_solid is the published one.
GrainDensities read_densities(const hdf5::Handle& file);

/// What each body bears: contacts with other bodies and walls, and its mean stress.
///   formula:  p = -1 / (3 V) sum f_c . (x_c - x_b),  compression positive
///   V         solid volume of the body, m3;  f_c  force on it at the contact point x_c;  x_b  its centre
/// Source: Love (1927), Weber (1966), for one body at rest.
struct BodyLoads {
  std::vector<int> contacts;        ///< [n_bodies]
  std::vector<double> mean_stress;  ///< [n_bodies] Pa
};
BodyLoads body_loads(const StoredState& state, const GrainDensities& densities);

}  // namespace dem
