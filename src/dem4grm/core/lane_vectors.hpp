// SPDX-License-Identifier: BSD-3-Clause
// Vectors of several lanes, component by component: component c of lane k at v[c][k], as registers want them.
#pragma once

#include <cstddef>

#include "dem4grm/core/lanes.hpp"
#include "dem4grm/core/vec3.hpp"

namespace dem {

template <std::size_t n>
using LaneVectors = double[3][n];

template <std::size_t n>
DEM_INLINE Vec3 taken(const LaneVectors<n>& from, std::size_t lane) {
  return {from[0][lane], from[1][lane], from[2][lane]};
}

template <std::size_t n>
DEM_INLINE void put(LaneVectors<n>& to, std::size_t lane, const Vec3& v) {
  to[0][lane] = v.x;
  to[1][lane] = v.y;
  to[2][lane] = v.z;
}

}  // namespace dem
