// SPDX-License-Identifier: BSD-3-Clause
// A stored state as the pictures that ParaView draws of it: balls, clumps, rubber grains, contacts, bonds, walls.
//
// Lengths are in mm, so that coordinates, radii and displacements fit each other without factors; every other unit is part
// of the array's name (docs/how-to/paraview.md lists them all). Compression is positive.
#pragma once

#include <array>

#include "dem4grm/export/stored_state.hpp"
#include "dem4grm/export/vtk_poly_data.hpp"

namespace dem {

/// What a picture shows: a state against the first one of its file, with what follows from both.
struct ShownState {
  const StoredState& now;
  std::vector<Vec3> displacement;       ///< [n_bodies] m, of the centres since the first state
  std::vector<Vec3> ball_displacement;  ///< [n_balls] m
  std::vector<Vec3> rotation;           ///< [n_bodies] rad, along the axis, at most pi long
  std::vector<double> bond_strain;      ///< [n_rubber] mean of the bonds that are not broken, compression positive
  BodyLoads loads;
};

/// Throws IoError when the states do not hold the same grains.
ShownState shown_state(const StoredState& first, const StoredState& now, const GrainDensities& densities);

/// Numbers of the array `kind` of contacts; the first three are those of PairKind.
inline constexpr std::int32_t k_wall_contact = 3;

VtkPolyData balls_of(const ShownState& state);
VtkPolyData clumps_of(const ShownState& state);
VtkPolyData rubber_grains_of(const ShownState& state);
/// Lines between the centres of the two bodies, or from the centre of the body to the contact point on a wall.
VtkPolyData contacts_of(const ShownState& state);
/// Lines between the two balls of each bond.
VtkPolyData bonds_of(const ShownState& state);
VtkPolyData walls_of(const ShownState& state);

/// A series of files, one for each state.
struct SeriesKind {
  const char* name;
  VtkPolyData (*make)(const ShownState& state);
};
inline constexpr std::array<SeriesKind, 6> k_series{{
    {"balls", balls_of},
    {"clumps", clumps_of},
    {"rubber_grains", rubber_grains_of},
    {"contacts", contacts_of},
    {"bonds", bonds_of},
    {"walls", walls_of},
}};

}  // namespace dem
