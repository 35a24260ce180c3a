// SPDX-License-Identifier: BSD-3-Clause
// Moves of doubles into and between registers: numbers collected from many places, and transposes. g++ makes poor code of a
// plain loop that does the same.
//
// Both are written for the width of the registers that the file at hand is compiled for. A vector wider than the
// registers would be put together in memory by g++, by stores of eight bytes and a load of the whole that has to wait
// for them (docs/decisions/0017-processor-targets.md).
#pragma once

#include <cstddef>

#include "dem4grm/core/lanes.hpp"

namespace dem {

using Two = double __attribute__((vector_size(2 * sizeof(double))));
using Four = double __attribute__((vector_size(4 * sizeof(double))));
using Eight = double __attribute__((vector_size(8 * sizeof(double))));

/// Doubles in a register of the processor that this file is compiled for.
#if defined(__AVX512F__)
inline constexpr std::size_t k_register = 8;
#elif defined(__AVX__)
inline constexpr std::size_t k_register = 4;
#else
inline constexpr std::size_t k_register = 2;
#endif

template <class Vector>
DEM_INLINE Vector load(const double* from) {
  Vector v;
  __builtin_memcpy(&v, from, sizeof v);
  return v;
}

template <class Vector>
DEM_INLINE void store(double* to, const Vector& v) {
  __builtin_memcpy(to, &v, sizeof v);
}

DEM_INLINE void add_four(double* to, const Four& v) { store(to, load<Four>(to) + v); }

DEM_INLINE void copy_eight(double* to, const double* from) { __builtin_memcpy(to, from, sizeof(Eight)); }

/// Cross product of the first three numbers; the fourth is a[3] b[3] - a[3] b[3].
DEM_INLINE Four cross(const Four& a, const Four& b) {
  return __builtin_shufflevector(a, a, 1, 2, 0, 3) * __builtin_shufflevector(b, b, 2, 0, 1, 3) -
         __builtin_shufflevector(a, a, 2, 0, 1, 3) * __builtin_shufflevector(b, b, 1, 2, 0, 3);
}

/// to[k] = from[k][at] for as many places as a register holds. Loads put together in a register are faster than a gather
/// instruction (docs/performance.md).
DEM_INLINE void collect(const double* const (&from)[k_register], std::size_t at, double* to) {
#if defined(__AVX512F__)
  store(to,
        Eight{from[0][at], from[1][at], from[2][at], from[3][at], from[4][at], from[5][at], from[6][at], from[7][at]});
#elif defined(__AVX__)
  store(to, Four{from[0][at], from[1][at], from[2][at], from[3][at]});
#else
  store(to, Two{from[0][at], from[1][at]});
#endif
}

namespace detail {

DEM_INLINE void transpose(Two (&r)[2]) {
  const Two a = r[0], b = r[1];
  r[0] = __builtin_shufflevector(a, b, 0, 2);
  r[1] = __builtin_shufflevector(a, b, 1, 3);
}

/// By pairs, then by halves.
DEM_INLINE void transpose(Four (&r)[4]) {
  const Four a = __builtin_shufflevector(r[0], r[1], 0, 4, 2, 6), b = __builtin_shufflevector(r[0], r[1], 1, 5, 3, 7);
  const Four c = __builtin_shufflevector(r[2], r[3], 0, 4, 2, 6), d = __builtin_shufflevector(r[2], r[3], 1, 5, 3, 7);
  r[0] = __builtin_shufflevector(a, c, 0, 1, 4, 5);
  r[1] = __builtin_shufflevector(b, d, 0, 1, 4, 5);
  r[2] = __builtin_shufflevector(a, c, 2, 3, 6, 7);
  r[3] = __builtin_shufflevector(b, d, 2, 3, 6, 7);
}

/// By pairs, then by twos of pairs, then by halves.
DEM_INLINE void transpose(Eight (&r)[8]) {
  Eight a[8], b[8];
  DEM_UNROLL
  for (std::size_t k = 0; k < 8; k += 2) {
    a[k] = __builtin_shufflevector(r[k], r[k + 1], 0, 8, 2, 10, 4, 12, 6, 14);
    a[k + 1] = __builtin_shufflevector(r[k], r[k + 1], 1, 9, 3, 11, 5, 13, 7, 15);
  }
  DEM_UNROLL
  for (std::size_t k = 0; k < 8; k += 4) {
    DEM_UNROLL
    for (std::size_t h = 0; h < 2; ++h) {
      b[k + h] = __builtin_shufflevector(a[k + h], a[k + h + 2], 0, 1, 8, 9, 4, 5, 12, 13);
      b[k + h + 2] = __builtin_shufflevector(a[k + h], a[k + h + 2], 2, 3, 10, 11, 6, 7, 14, 15);
    }
  }
  DEM_UNROLL
  for (std::size_t k = 0; k < 4; ++k) {
    r[k] = __builtin_shufflevector(b[k], b[k + 4], 0, 1, 2, 3, 8, 9, 10, 11);
    r[k + 4] = __builtin_shufflevector(b[k], b[k + 4], 4, 5, 6, 7, 12, 13, 14, 15);
  }
}

/// Eight rows of eight by squares of n rows and columns, each transposed in registers.
template <class Vector>
DEM_INLINE void transpose_by_squares(const double* const (&from)[8], double* const (&to)[8]) {
  constexpr std::size_t n = sizeof(Vector) / sizeof(double);
  DEM_UNROLL
  for (std::size_t row = 0; row < 8; row += n) {
    DEM_UNROLL
    for (std::size_t column = 0; column < 8; column += n) {
      Vector square[n];
      DEM_UNROLL
      for (std::size_t k = 0; k < n; ++k) square[k] = load<Vector>(from[row + k] + column);
      transpose(square);
      DEM_UNROLL
      for (std::size_t k = 0; k < n; ++k) store(to[column + k] + row, square[k]);
    }
  }
}

}  // namespace detail

/// to[column][row] = from[row][column] for eight rows of eight numbers that do not overlap those they go to.
DEM_INLINE void transpose_eight(const double* const (&from)[8], double* const (&to)[8]) {
  if constexpr (k_register == 8) {
    detail::transpose_by_squares<Eight>(from, to);
  } else if constexpr (k_register == 4) {
    detail::transpose_by_squares<Four>(from, to);
  } else {
    detail::transpose_by_squares<Two>(from, to);
  }
}

/// Pointers to eight rows of numbers that lie `stride` numbers apart.
template <class Number>
struct EightRows {
  Number* at[8];
  DEM_INLINE EightRows(Number* first, std::size_t stride)
      : at{first,
           first + stride,
           first + 2 * stride,
           first + 3 * stride,
           first + 4 * stride,
           first + 5 * stride,
           first + 6 * stride,
           first + 7 * stride} {}
};

}  // namespace dem
