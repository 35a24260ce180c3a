// SPDX-License-Identifier: BSD-3-Clause
// A box along the axes.
#pragma once

#include "dem4grm/core/vec3.hpp"

namespace dem {

struct Bounds {
  Vec3 low, high;  ///< m
};

constexpr bool is_inside(const Vec3& p, const Bounds& b) {
  return p.x >= b.low.x && p.x <= b.high.x && p.y >= b.low.y && p.y <= b.high.y && p.z >= b.low.z && p.z <= b.high.z;
}

}  // namespace dem
