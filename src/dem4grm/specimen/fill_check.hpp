// SPDX-License-Identifier: BSD-3-Clause
// What a random fill must not hold: grains caught in one another, grains outside the box.
#pragma once

#include "dem4grm/core/vec3.hpp"
#include "dem4grm/engine/simulation.hpp"

namespace dem {

/// Balls and pebbles that lie inside a rubber grain, found among the touching ones. The fill's rubber grains are rigid clumps whose centres of
/// balls span a cube of half side L = 4/sqrt(3) r; a ball of the same size that rests on a face has its centre 1.15 r
/// above it, larger ones more. Inside is a centre less than r/2 outside that cube: such a ball has passed between the
/// outer balls, and the two grains cannot part again. The test of overlaps does not see it, since inner balls leave room.
int interlocked_balls(const Simulation& s, int rubber_shape);

/// Number of the first grain whose centre lies outside the box of this size (m) with a corner at the origin, or -1.
int first_outside(const Simulation& s, const Vec3& size);

}  // namespace dem
