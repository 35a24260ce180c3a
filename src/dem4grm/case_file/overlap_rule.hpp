// SPDX-License-Identifier: BSD-3-Clause
// Overlaps that follow from stress and modulus, and so can be foretold before a run.
#pragma once

#include "dem4grm/case_file/box_rules.hpp"

namespace dem {

/// Overlap over the radius of equal balls that stand on each other in a square array under the normal stress.
///
/// formula:  F = sigma (2 r)^2 = 4/3 E* sqrt(r/2) d^(3/2),  so  d / r = (3 sqrt(2) sigma / E*)^(2/3),  E* = G / (1 - nu)
///   sigma  normal stress, Pa;  G, nu  shear modulus (Pa) and Poisson's ratio of the balls
/// Source: Hertz. In prepared specimens of gravel the largest overlap is twice this at 0.2 and as large at 1.
double foreseen_overlap(double normal_stress, double shear_modulus, double poisson_ratio);

/// Refuses moduli so low that grains would pass through each other, and warns where the law of small overlaps ends.
void check_overlap(const DirectShearCase& test, Rules& rules);

}  // namespace dem
