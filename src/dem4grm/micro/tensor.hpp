// SPDX-License-Identifier: BSD-3-Clause
// Tensors of second rank in space and the few numbers that are read off them.
#pragma once

#include <array>
#include <cstddef>

#include "dem4grm/core/vec3.hpp"

namespace dem {

/// Components row by row: xx, xy, xz, yx, ... Unit given by whoever holds it.
struct Tensor3 {
  std::array<double, 9> value{};

  [[nodiscard]] double operator()(std::size_t row, std::size_t column) const { return value[3 * row + column]; }
  [[nodiscard]] double xx() const { return value[0]; }
  [[nodiscard]] double xz() const { return value[2]; }
  [[nodiscard]] double yy() const { return value[4]; }
  [[nodiscard]] double zx() const { return value[6]; }
  [[nodiscard]] double zz() const { return value[8]; }
};

/// a_i b_j.
constexpr Tensor3 outer(const Vec3& a, const Vec3& b) {
  return {{a.x * b.x, a.x * b.y, a.x * b.z, a.y * b.x, a.y * b.y, a.y * b.z, a.z * b.x, a.z * b.y, a.z * b.z}};
}

constexpr Tensor3& operator+=(Tensor3& a, const Tensor3& b) {
  for (std::size_t k = 0; k < 9; ++k) a.value[k] += b.value[k];
  return a;
}
constexpr Tensor3 operator*(Tensor3 a, double s) {
  for (double& v : a.value) v *= s;
  return a;
}
constexpr Tensor3 operator+(Tensor3 a, const Tensor3& b) { return a += b; }
constexpr Tensor3 operator-(const Tensor3& a, const Tensor3& b) { return a + b * -1.0; }

constexpr double trace(const Tensor3& a) { return a.value[0] + a.value[4] + a.value[8]; }

/// The tensor without its mean: a - (tr a / 3) 1.
constexpr Tensor3 deviator(Tensor3 a) {
  const double mean = trace(a) / 3.0;
  for (const std::size_t k : {0U, 4U, 8U}) a.value[k] -= mean;
  return a;
}

/// (a + a^T) / 2.
Tensor3 symmetric_part(const Tensor3& a);

/// n . a n.
double along(const Tensor3& a, const Vec3& n);

/// x of a x = b; not a number when the rows of a lie in one plane.
Vec3 solve(const Tensor3& a, const Vec3& b);

/// formula:  q = sqrt(3/2 s : s),  s the symmetric part of the deviator. Unit of the tensor.
double deviator_size(const Tensor3& a);

/// Eigenvalues of the symmetric part, ascending.
std::array<double, 3> principal_values(const Tensor3& a);

/// Angle of the major axis of the xz components of the symmetric part from x, rad in [0, pi).
///   formula:  theta = atan2(a_xz + a_zx, a_xx - a_zz) / 2
double major_axis_in_shear_plane(const Tensor3& a);

}  // namespace dem
