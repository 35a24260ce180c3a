// SPDX-License-Identifier: BSD-3-Clause
// A ball of a rubber grain is predicted from three balls before it,
//
//     x_k = x_a + x_b - x_c   where the undeformed grain has X_k = X_a + X_b - X_c,
//
// which is exact for a grain that is turned, moved and squeezed evenly: only small differences are left to write.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "dem4grm/grains/rubber_grain.hpp"

namespace dem {

/// For each ball of a grain the balls a, b, c that predict it. {-1, -1, -1}: the first one, from the first ball of the grain
/// before. {0, -1, -1}: from the first ball of its own grain.
using GrainPrediction = std::array<std::array<int, 3>, k_grain_balls>;
GrainPrediction grain_prediction();

/// Differences to the predictions, in the order of the balls. places: [35 n] whole numbers of one coordinate.
std::vector<std::int32_t> prediction_residuals(const std::vector<std::int32_t>& places,
                                               const GrainPrediction& prediction);

}  // namespace dem
