// SPDX-License-Identifier: BSD-3-Clause
// The contacts of a specimen as plain lists, from a simulation or from a stored state alike.
//
// A network holds every contact of two balls of different bodies that carries force. Bonds, contacts within one rubber
// grain and contacts with walls are no part of it; those with walls stand in a list of their own. Normals point from i
// to j, forces are those on i: the force on i is shear_force - normal_force * normal.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "dem4grm/engine/simulation.hpp"

namespace dem {

enum class PairKind : std::uint8_t { gravel_gravel, gravel_rubber, rubber_rubber };
inline constexpr std::size_t k_pair_kinds = 3;
/// Their names in the order of the enumerators.
inline constexpr std::array<const char*, k_pair_kinds> k_pair_names{"g-g", "g-r", "r-r"};

/// Kind of the contact of two bodies by their materials (engine/scene.hpp).
constexpr PairKind kind_of(int material_i, int material_j) {
  return static_cast<PairKind>((material_i == k_rubber ? 1 : 0) + (material_j == k_rubber ? 1 : 0));
}

/// Contact of two balls of different bodies.
struct Contact {
  int ball_i = 0, ball_j = 0;
  int body_i = 0, body_j = 0;
  PairKind kind = PairKind::gravel_gravel;
  bool is_sliding = false;    ///< the shear force is at its Coulomb limit
  Vec3 point;                 ///< m
  Vec3 normal;                ///< unit vector from i to j
  double normal_force = 0.0;  ///< N, compression positive
  Vec3 shear_force;           ///< N, on i, perpendicular to the normal
  Vec3 branch;                ///< m, from the centre of body i to that of body j
  double friction = 0.0;      ///< friction coefficient of the pair
};

/// Contact of a ball and a wall.
struct WallContact {
  int ball = 0, body = 0, wall = 0;
  bool is_sliding = false;
  Vec3 point;                 ///< m
  Vec3 normal;                ///< unit vector from the ball to the wall
  double normal_force = 0.0;  ///< N, compression positive
  Vec3 shear_force;           ///< N, on the ball
  Vec3 branch;                ///< m, from the centre of the body to the contact point
  double friction = 0.0;
};

/// Force of i on j (of the ball on the wall), N.
inline Vec3 force_on_second(const Contact& c) { return c.normal * c.normal_force - c.shear_force; }
inline Vec3 force_on_second(const WallContact& c) { return c.normal * c.normal_force - c.shear_force; }

/// Where the specimen stands: between two plates. All zero or -1 when there are none of these names.
struct SampleBox {
  int bottom_plate = -1, top_plate = -1;  ///< rows of walls
  double area = 0.0;                      ///< m2, of the bottom plate
  double height = 0.0;                    ///< m, between the plates
  std::vector<int> plate_of_rib{};        ///< [n_walls] row of the plate that a wall is a rib of, its own row otherwise
  /// The plate that a wall belongs to, or the wall itself.
  [[nodiscard]] int plate_of(int wall) const {
    return plate_of_rib.empty() ? wall : plate_of_rib[static_cast<std::size_t>(wall)];
  }
  [[nodiscard]] double volume() const { return area * height; }
};

/// The contacts of a state and its bodies: rubber grains first, then clumps.
struct ContactNetwork {
  std::vector<Contact> contacts;  ///< pairs of rubber balls first, then the others, each by ball ids
  std::vector<WallContact> wall_contacts;
  std::vector<Vec3> body_position;           ///< [n_bodies] m, mean of the balls or centroid
  std::vector<unsigned char> body_material;  ///< [n_bodies] engine/scene.hpp
  SampleBox box;
};

/// The network of the last evaluation of forces; normals and points from the present positions.
ContactNetwork contact_network_of(const Simulation& s);

/// The plates among the walls, by their names "bottom plate" and "top plate", and their ribs, whose names go on from there.
SampleBox find_sample_box(std::span<const Wall> walls);

/// One contact for each pair of bodies, in the order of their ids, i the smaller one.
///   force   sum of the forces of its contacts
///   normal  direction of the sum of normal_force * normal, so strong contacts count more; the force is split anew on it
///   point   mean, weighted by normal forces;  friction  the same
///   sliding when every contact of the pair slides
/// Contacts whose weighted normals cancel keep the normal of the first one.
std::vector<Contact> merge_pairs(std::span<const Contact> contacts);

/// Their normals, in their order.
std::vector<Vec3> normals_of(std::span<const Contact> contacts);

/// The contacts of one kind, in their order.
std::vector<Contact> contacts_of_kind(std::span<const Contact> contacts, PairKind kind);

}  // namespace dem
