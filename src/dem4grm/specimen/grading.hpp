// SPDX-License-Identifier: BSD-3-Clause
// Reading a grading curve: sizes at a share of mass, shares at a size, and the usual key figures.
//
// Between the rows of the table the curve is linear in size (not in its logarithm). So the sizes of grains depend on no
// logarithm, whose last bits differ from one mathematical library to the next. Between rows whose sizes are a factor of
// 1.2 apart the two rules differ by less than half a per cent of the size.
#pragma once

#include <string>
#include <vector>

#include "dem4grm/specimen/settings.hpp"

namespace dem {

/// Everything that is wrong with a grading, one sentence each; empty when it can be used. It needs two rows or more,
/// sizes that are positive and rise, shares that start at 0, never fall and end at 1.
std::vector<std::string> grading_problems(const Grading& grading);

/// Sieve size in m that the given fraction of the mass passes. Fractions outside 0 to 1 are taken as 0 and 1. The
/// smallest size where the curve is flat. This and the functions below need a grading without problems.
double size_at_passing(const Grading& grading, double fraction);

/// Fraction of the mass that passes a square opening of that size in m: 0 below the table, 1 above it.
double passing_at_size(const Grading& grading, double size);

/// Smallest and largest grain in m: where the curve leaves 0 and reaches 1.
double smallest_size(const Grading& grading);
double largest_size(const Grading& grading);

/// Sizes in m that 10, 50 and 60 % of the mass pass.
double d10(const Grading& grading);
double d50(const Grading& grading);
double d60(const Grading& grading);

/// Coefficient of uniformity D60 / D10, dimensionless.
double uniformity_coefficient(const Grading& grading);

/// m; the finest sieve that everything passes. The grading must be free of faults.
double largest_grain(const Grading& grading);
/// m; the coarsest sieve that nothing passes. The grading must be free of faults.
double smallest_grain(const Grading& grading);

}  // namespace dem
