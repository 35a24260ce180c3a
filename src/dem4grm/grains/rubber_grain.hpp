// SPDX-License-Identifier: BSD-3-Clause
// Topology of the rubber grain: 35 equal balls on 2x2x2 body-centred cubic cells.
//
//   slots 0 to 26   corners (i, j, k) a with i, j, k in {-1, 0, 1}; slot = (i+1) + 3 (j+1) + 9 (k+1)
//   slots 27 to 34  cell centres (+-a/2, +-a/2, +-a/2); slot - 27 has bit 0 set for +x, bit 1 for +y, bit 2 for +z
//   a = 4 r / sqrt(3): a centre touches the eight corners of its cell (64 bonds, at distance 2 r);
//   corner-corner and centre-centre neighbours at distance a (54 + 12 = 66) meet when squeezed by 13.4 %.
// Source: Chew et al. (2022), section on the rubber grain.
#pragma once

#include <array>
#include <cstdint>

#include "dem4grm/core/vec3.hpp"

namespace dem {

inline constexpr int k_grain_balls = 35;
inline constexpr int k_grain_bonds = 64;
inline constexpr int k_grain_second_neighbours = 66;
inline constexpr int k_grain_corners = 27;
inline constexpr int k_grain_centres = 8;

/// a / r.
inline constexpr double k_grain_lattice = 2.3094010767585030580;  // 4 / sqrt(3)

/// Two slots of one grain.
struct SlotPair {
  std::uint8_t i = 0, j = 0;
};

/// Position of a slot in the undeformed grain, in units of a.
constexpr Vec3 grain_site(int slot) {
  if (slot < k_grain_corners) {
    const int i = slot % 3, j = slot / 3 % 3, k = slot / 9;
    return {i - 1.0, j - 1.0, k - 1.0};
  }
  const int c = slot - k_grain_corners;
  return {(c & 1) != 0 ? 0.5 : -0.5, (c & 2) != 0 ? 0.5 : -0.5, (c & 4) != 0 ? 0.5 : -0.5};
}

/// The corner slot at octant o (bits as for the centres) of cell centre c.
constexpr int grain_corner_of(int c, int o) {
  const int i = (c & 1) + (o & 1), j = (c >> 1 & 1) + (o >> 1 & 1), k = (c >> 2 & 1) + (o >> 2 & 1);
  return i + 3 * j + 9 * k;
}

/// Bonds: i is a centre, j a corner; bond 8 c + o joins centre c with its corner at octant o.
constexpr std::array<SlotPair, k_grain_bonds> make_grain_bonds() {
  std::array<SlotPair, k_grain_bonds> bonds{};
  for (int c = 0; c < k_grain_centres; ++c) {
    for (int o = 0; o < 8; ++o) {
      bonds[static_cast<std::size_t>(8 * c + o)] = {static_cast<std::uint8_t>(k_grain_corners + c),
                                                    static_cast<std::uint8_t>(grain_corner_of(c, o))};
    }
  }
  return bonds;
}

/// Second neighbours: the 54 corner pairs and 12 centre pairs one lattice constant apart, i < j.
constexpr std::array<SlotPair, k_grain_second_neighbours> make_grain_second_neighbours() {
  std::array<SlotPair, k_grain_second_neighbours> pairs{};
  std::size_t n = 0;
  for (int i = 0; i < k_grain_balls; ++i) {
    for (int j = i + 1; j < k_grain_balls; ++j) {
      const bool corners = j < k_grain_corners, centres = i >= k_grain_corners;
      const Vec3 d = grain_site(j) - grain_site(i);
      if ((corners || centres) && dot(d, d) == 1.0) {
        pairs[n++] = {static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(j)};
      }
    }
  }
  return pairs;
}

inline constexpr auto k_bonds_of_grain = make_grain_bonds();
inline constexpr auto k_second_neighbours_of_grain = make_grain_second_neighbours();
static_assert(k_second_neighbours_of_grain.back().i == 33 && k_second_neighbours_of_grain.back().j == 34);

}  // namespace dem
