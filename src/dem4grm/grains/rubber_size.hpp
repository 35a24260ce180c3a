// SPDX-License-Identifier: BSD-3-Clause
// Size and solid volume of the rubber grain of 35 balls, from the radius of its balls and back.
//
//   V_balls = 35 * 4/3 * pi * r^3            the balls, which touch but do not overlap
//   V_s     = V_balls * ball_density / solid_density
//   size    = cube root of V_s
//
// r ball radius, m; V_s solid volume, m3: the grain with its internal voids filled, mass / density of solid rubber. It
// counts for rubber content and void ratio. Size, m: edge of the cube of that volume, taken as the sieve size.
// At 1610 and 1150 kg/m3: V_s = 205.25 r^3, size = 5.899 r. Only the ratio of the densities matters, so scaling both
// for a larger time step changes nothing.
// Source: Chew et al. (2022) for the 35 balls, the densities and D50 of the rubber; that D50 is the edge of the cube of
// the solid volume is our reading: with it the published 5769 grains fill the box to 52 of 53 mm at the published void
// ratio, while D50 as the outer width of the grain would fill 37 mm.
#pragma once

namespace dem {

/// V_s in m3. Arguments are positive: m, kg/m3, kg/m3.
double rubber_solid_volume(double ball_radius, double ball_density, double solid_density);

/// Size in m of a grain with balls of that radius.
double rubber_grain_size(double ball_radius, double ball_density, double solid_density);

/// Ball radius in m of a grain of that size; inverse of rubber_grain_size.
double rubber_ball_radius(double grain_size, double ball_density, double solid_density);

}  // namespace dem
