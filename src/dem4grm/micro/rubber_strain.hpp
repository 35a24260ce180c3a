// SPDX-License-Identifier: BSD-3-Clause
// How far the rubber grains are squeezed: bonds, volume, shape, second neighbours.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "dem4grm/engine/simulation.hpp"
#include "dem4grm/grains/rubber_grain.hpp"
#include "dem4grm/micro/contact_network.hpp"
#include "dem4grm/micro/tensor.hpp"

namespace dem {

/// The inside of the rubber grains as plain lists, grain by grain.
struct RubberState {
  std::vector<double> rest_length;        ///< [n_grains] m, of the bonds of the grain
  std::vector<Vec3> ball_position;        ///< [n_grains * 35] m
  std::vector<double> bond_length;        ///< [n_grains * 64] m
  std::vector<double> bond_normal_force;  ///< [n_grains * 64] N, without the dashpot, compression positive
  std::vector<double> bond_shear_force;   ///< [n_grains * 64] N, magnitude
  std::vector<double> bond_moment;        ///< [n_grains * 64] N m, magnitude
  std::vector<unsigned char> is_broken;   ///< [n_grains * 64]

  [[nodiscard]] std::size_t n_grains() const { return ball_position.size() / k_grain_balls; }
};
RubberState rubber_state_of(const Simulation& s);

/// Of a list of numbers; not a number when it is empty.
struct Distribution {
  double mean = 0.0;
  double deviation = 0.0;  ///< standard deviation of the list
  double p05 = 0.0, p50 = 0.0, p95 = 0.0;
};
/// p05 is the value below which 5 % of the list lie: number floor(0.05 (n - 1)) of the sorted list, the others likewise.
Distribution distribution_of(std::vector<double> values);

struct RubberReport {
  /// (L0 - L) / L0 of the bonds that are not broken, compression positive. Source: Chew et al. (2022).
  Distribution bond_strain;
  double bond_strain_compressed = 0.0;    ///< mean over those of them that are shorter than at rest
  double bonds_compressed = 0.0;          ///< their share
  std::vector<double> grain_bond_strain;  ///< [n_grains] mean over the bonds of a grain that are not broken
  double bond_force = 0.0;                ///< N, mean normal force of the bonds, compression positive
  double bond_force_size = 0.0;           ///< N, mean of its magnitude
  double bond_moment = 0.0;               ///< N m, mean of the magnitudes
  Distribution volume_strain;             ///< (V0 - V) / V0 of the grains, compression positive
  Distribution aspect_ratio;              ///< of the grains, 1 at rest
  double closed_second_neighbours = 0.0;  ///< mean number in a grain, of 66
};

/// Not a number where there is no rubber.
RubberReport rubber_report(const RubberState& state);

/// Mean bond strain of the rubber as its neighbours meet it: each pair of a rubber grain and a body that it touches counts
/// once, with the grain's mean bond strain. Not a number without such a pair.
struct NeighbourStrain {
  double at_gravel = 0.0, at_rubber = 0.0;
};
/// grain_bond_strain [n_grains], of the bodies 0 ... n_grains - 1 of the network.
NeighbourStrain strain_by_neighbour(std::span<const double> grain_bond_strain, const ContactNetwork& network);

/// Homogeneous part of the deformation of a grain.
///   formula:  F = sum (x - x_mean) X^T / (sum X X^T),  the least squares of x = x_mean + F X over its 35 balls
///   x, X      places now and at rest, m; at rest the spread sum X X^T of a cubic grain is a multiple of 1
/// balls: the 35 of one grain, m.
Tensor3 deformation_of(std::span<const Vec3> balls, double rest_length);

/// Compressive strain of the line of the grain that now lies along the unit vector m: 1 - 1 / |F^-1 m|.
double strain_along(const Tensor3& deformation, const Vec3& m);

/// Mean of it over the grains; not a number without rubber.
double mean_strain_along(const RubberState& state, const Vec3& m);

/// Volume inside the 24 outer faces of the eight cells, corners at the 27 corner balls; m3.
///   formula:  V = (1/6) sum r_1 . (r_2 x r_3) over triangles, each face as the mean of its two ways into triangles,
///             which is the volume of the trilinear cells. Undeformed: (2 a)^3, a = 2 L0 / sqrt(3).
/// balls: the 35 of one grain, m.
double grain_volume(std::span<const Vec3> balls);

/// Longest over shortest axis of the grain: sqrt of the quotient of the largest and smallest principal value of
/// sum (x - x_mean)(x - x_mean)^T over its 35 balls.
double grain_aspect_ratio(std::span<const Vec3> balls);

/// Number of the 66 second-neighbour pairs closer than the rest length of a bond, at which two balls touch.
int closed_second_neighbours(std::span<const Vec3> balls, double rest_length);

}  // namespace dem
