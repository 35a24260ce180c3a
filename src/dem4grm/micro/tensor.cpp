// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/micro/tensor.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>

namespace dem {

Tensor3 symmetric_part(const Tensor3& a) {
  Tensor3 out;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) out.value[3 * i + j] = 0.5 * (a(i, j) + a(j, i));
  }
  return out;
}

double along(const Tensor3& a, const Vec3& n) {
  const auto& v = a.value;
  const Vec3 an{v[0] * n.x + v[1] * n.y + v[2] * n.z, v[3] * n.x + v[4] * n.y + v[5] * n.z,
                v[6] * n.x + v[7] * n.y + v[8] * n.z};
  return dot(n, an);
}

Vec3 solve(const Tensor3& a, const Vec3& b) {
  const auto& v = a.value;
  const Vec3 first{v[0], v[3], v[6]}, second{v[1], v[4], v[7]}, third{v[2], v[5], v[8]};  // columns
  const double determinant = dot(first, cross(second, third));
  return Vec3{dot(b, cross(second, third)), dot(first, cross(b, third)), dot(first, cross(second, b))} *
         (1.0 / determinant);
}

double deviator_size(const Tensor3& a) {
  double sum = 0.0;
  for (const double v : deviator(symmetric_part(a)).value) sum += v * v;
  return std::sqrt(1.5 * sum);
}

std::array<double, 3> principal_values(const Tensor3& a) {
  const Tensor3 s = symmetric_part(a);
  Eigen::Matrix3d m;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) m(i, j) = s(static_cast<std::size_t>(i), static_cast<std::size_t>(j));
  }
  const Eigen::Vector3d values =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(m, Eigen::EigenvaluesOnly).eigenvalues();
  return {values[0], values[1], values[2]};
}

double major_axis_in_shear_plane(const Tensor3& a) {
  const double angle = 0.5 * std::atan2(a.xz() + a.zx(), a.xx() - a.zz());
  return angle < 0.0 ? angle + std::numbers::pi : angle;
}

}  // namespace dem
