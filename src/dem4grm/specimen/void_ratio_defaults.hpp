// SPDX-License-Identifier: BSD-3-Clause
// Void ratios that are used when the case does not name any.
#pragma once

#include "dem4grm/specimen/settings.hpp"

namespace dem {

/// Void ratio of the laboratory, dimensionless, at a relative density D of its mixtures:
///   e = e_max - D (e_max - e_min),
/// e_max and e_min linear between the rubber contents (fraction of the solid volume) that were measured: loosest 0.725
/// 0.778 0.818 0.912 1.272, densest 0.545 0.561 0.577 0.590 0.787 at 0 10 25 40 100 %. Source: Chew et al. (2022),
/// Table 1. D may lie outside 0 to 1. Throws InputError when rubber_content does.
double laboratory_void_ratio(double rubber_content, double relative_density);

/// Void ratio of the random fill, dimensionless: the case's own, or the laboratory's at the case's
/// generation_relative_density. Spheres jam before clumps do, so gravel of spheres alone adds what takes a fill without
/// rubber to 0.9 at least, in proportion to its share. Throws InputError when the rubber content is outside 0 to 1.
double generation_void_ratio(const SpecimenSettings& settings);

/// Void ratio after compression that the number of grains is made for, dimensionless: linear in rubber content from
/// 0.534 (gravel) to 0.782 (rubber), the published values at 30 kPa. Source: Chew et al. (2022), Table 3. Throws
/// InputError outside 0 to 1.
double expected_void_ratio(double rubber_content);

}  // namespace dem
