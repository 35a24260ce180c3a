// SPDX-License-Identifier: BSD-3-Clause
// Four or eight doubles in one register, for the few moves of data that a lane loop cannot say well. Processors with
// narrower registers use several.
#pragma once

#include <cstddef>

#include "dem4grm/core/lanes.hpp"

namespace dem {

using Four = double __attribute__((vector_size(4 * sizeof(double))));
using Eight = double __attribute__((vector_size(8 * sizeof(double))));

DEM_INLINE Four load_four(const double* from) {
  Four v;
  __builtin_memcpy(&v, from, sizeof v);
  return v;
}

DEM_INLINE void add_four(double* to, const Four& v) {
  const Four sum = load_four(to) + v;
  __builtin_memcpy(to, &sum, sizeof sum);
}

/// Cross product of the first three numbers; the fourth is a[3] b[3] - a[3] b[3].
DEM_INLINE Four cross(const Four& a, const Four& b) {
  return __builtin_shufflevector(a, a, 1, 2, 0, 3) * __builtin_shufflevector(b, b, 2, 0, 1, 3) -
         __builtin_shufflevector(a, a, 2, 0, 1, 3) * __builtin_shufflevector(b, b, 1, 2, 0, 3);
}

DEM_INLINE Eight load_eight(const double* from) {
  Eight v;
  __builtin_memcpy(&v, from, sizeof v);
  return v;
}

DEM_INLINE void store_eight(double* to, const Eight& v) { __builtin_memcpy(to, &v, sizeof v); }

/// Transposes eight rows of eight in place, by pairs, then by twos of pairs, then by halves.
DEM_INLINE void transpose(Eight (&r)[8]) {
  Eight a[8], b[8];
  for (std::size_t k = 0; k < 8; k += 2) {
    a[k] = __builtin_shufflevector(r[k], r[k + 1], 0, 8, 2, 10, 4, 12, 6, 14);
    a[k + 1] = __builtin_shufflevector(r[k], r[k + 1], 1, 9, 3, 11, 5, 13, 7, 15);
  }
  for (std::size_t k = 0; k < 8; k += 4) {
    for (std::size_t h = 0; h < 2; ++h) {
      b[k + h] = __builtin_shufflevector(a[k + h], a[k + h + 2], 0, 1, 8, 9, 4, 5, 12, 13);
      b[k + h + 2] = __builtin_shufflevector(a[k + h], a[k + h + 2], 2, 3, 10, 11, 6, 7, 14, 15);
    }
  }
  for (std::size_t k = 0; k < 4; ++k) {
    r[k] = __builtin_shufflevector(b[k], b[k + 4], 0, 1, 2, 3, 8, 9, 10, 11);
    r[k + 4] = __builtin_shufflevector(b[k], b[k + 4], 4, 5, 6, 7, 12, 13, 14, 15);
  }
}

}  // namespace dem
