// SPDX-License-Identifier: BSD-3-Clause
// The width of the lane loops, and the promise that pure formulas are inlined into them.
#pragma once

#include <cstddef>

/// Number of rubber grains that lie side by side in memory. A build with 1 is the scalar reference.
#ifndef DEM_LANES
#define DEM_LANES 8
#endif

/// A law called from a lane loop must be inlined or the loop is not vectorised.
#define DEM_INLINE [[gnu::always_inline]] inline

/// In front of a short loop over registers: rolled up, they would be indexed, and for that put into memory.
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
