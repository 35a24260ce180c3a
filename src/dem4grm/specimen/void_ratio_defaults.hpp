// SPDX-License-Identifier: BSD-3-Clause
// Void ratios that are used when the case does not name any.
#pragma once

namespace dem {

/// Laboratory void ratio at 50 % relative density before compression, dimensionless, for a rubber content (fraction of
/// the solid volume, 0 to 1): 0.63 0.65 0.70 0.74 1.01 at 0 10 25 40 100 %, linear in between. Default of the random
/// fill. Source: Chew et al. (2022), Table 1. Throws InputError outside 0 to 1.
double laboratory_void_ratio(double rubber_content);

/// Void ratio after compression that the number of grains is made for, dimensionless: linear in rubber content from
/// 0.534 (gravel) to 0.782 (rubber), the published values at 30 kPa. Source: Chew et al. (2022), Table 3. Throws
/// InputError outside 0 to 1.
double expected_void_ratio(double rubber_content);

}  // namespace dem
