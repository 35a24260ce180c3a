// SPDX-License-Identifier: BSD-3-Clause
// For which kind of processor the hot loops in force were compiled. All kinds give the same bits.
//
//   x86-64   v4: AVX-512 (F, BW, CD, DQ, VL);  v3: AVX2;  v2: SSE4.2, which every processor since 2009 has
//   others   plain: what the compiler takes for granted
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace dem {

/// Targets that this program was compiled for and that this processor can run, the best first.
std::vector<std::string_view> usable_kernel_targets();

/// The target in force; at the start the best one.
std::string_view kernel_target();

/// Puts another target in force; not while a step is under way. Throws InputError with the names that can be chosen.
void choose_kernel_target(std::string_view name);

}  // namespace dem
