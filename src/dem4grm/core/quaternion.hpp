// SPDX-License-Identifier: BSD-3-Clause
// Unit quaternions: orientation of a ball or clump, body axes to space.
#pragma once

#include "dem4grm/core/vec3.hpp"

namespace dem {

/// q = w + xi + yj + zk with |q| = 1; rotate(q, v) carries a body vector v to space.
struct Quaternion {
  double w = 1.0, x = 0.0, y = 0.0, z = 0.0;
};

constexpr Quaternion operator*(const Quaternion& a, const Quaternion& b) {
  return {a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
          a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}
constexpr Quaternion conjugate(const Quaternion& q) { return {q.w, -q.x, -q.y, -q.z}; }

inline Quaternion normalized(const Quaternion& q) {
  const double inverse = 1.0 / std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
  return {q.w * inverse, q.x * inverse, q.y * inverse, q.z * inverse};
}

/// Rotation matrix in columns: the body axes seen from space.
struct Frame {
  Vec3 e1, e2, e3;
};

constexpr Frame frame_of(const Quaternion& q) {
  return {{1 - 2 * (q.y * q.y + q.z * q.z), 2 * (q.x * q.y + q.w * q.z), 2 * (q.x * q.z - q.w * q.y)},
          {2 * (q.x * q.y - q.w * q.z), 1 - 2 * (q.x * q.x + q.z * q.z), 2 * (q.y * q.z + q.w * q.x)},
          {2 * (q.x * q.z + q.w * q.y), 2 * (q.y * q.z - q.w * q.x), 1 - 2 * (q.x * q.x + q.y * q.y)}};
}
constexpr Vec3 to_space(const Frame& f, const Vec3& v) { return f.e1 * v.x + f.e2 * v.y + f.e3 * v.z; }
constexpr Vec3 to_body(const Frame& f, const Vec3& v) { return {dot(f.e1, v), dot(f.e2, v), dot(f.e3, v)}; }
constexpr Vec3 rotate(const Quaternion& q, const Vec3& v) { return to_space(frame_of(q), v); }

}  // namespace dem
