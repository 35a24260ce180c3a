// SPDX-License-Identifier: BSD-3-Clause
// The width of the lane loops, and the promise that pure formulas are inlined into them.
//
// A lane loop does the same arithmetic for several grains that lie side by side in memory, one grain in each lane of a vector
// register. The results of a lane are those of a loop over single grains, bit for bit.
#pragma once

#include <cstddef>

/// Number of rubber grains that lie side by side in memory. A build with 1 is the scalar reference.
#ifndef DEM_LANES
#define DEM_LANES 8
#endif

/// A law called from a lane loop must be inlined or the loop is not vectorised.
#define DEM_INLINE [[gnu::always_inline]] inline

/// In front of a short loop over an array of registers. As a loop it would index that array, and for that the compiler would
/// put the registers into memory; written out in full they stay where they are.
#ifdef __clang__
#define DEM_UNROLL _Pragma("clang loop unroll(full)")
#else
#define DEM_UNROLL _Pragma("GCC unroll 9")
#endif

namespace dem {

inline constexpr std::size_t k_lanes = DEM_LANES;

/// Contacts are evaluated eight at a time whatever the width of the grain blocks, so that sums over them keep their
/// order.
inline constexpr std::size_t k_contact_batch = 8;

}  // namespace dem
