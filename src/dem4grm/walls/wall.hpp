// SPDX-License-Identifier: BSD-3-Clause
// Rectangular walls and how a ball meets one: on its face, or at its edge or corner.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "dem4grm/core/lanes.hpp"
#include "dem4grm/core/vec3.hpp"

namespace dem {

/// A flat rectangle; grains are on the side to which the normal u x v points.
struct Wall {
  std::string name;
  Vec3 corner;                            ///< m
  Vec3 u{1, 0, 0}, v{0, 1, 0};            ///< unit vectors along the sides
  Vec3 normal{0, 0, 1};                   ///< u x v
  double length_u = 0.0, length_v = 0.0;  ///< m
  double friction = 0.0;
  Vec3 velocity;         ///< m/s
  bool is_solid = true;  ///< false: grains do not see it, it only carries others
  int carrier = -1;  ///< index of the wall that this one is a part of, a smaller one: it moves with it and its forces
                     ///< count there; -1: none
};

/// What a ball centre sees of a rectangle.
struct WallView {
  Vec3 nearest;           ///< point of the rectangle next to the ball centre
  double distance = 0.0;  ///< m; on the face signed (negative behind the wall), at an edge >= 0
  Vec3 away;              ///< unit vector from the rectangle to the ball
  bool on_face = false;   ///< the centre projects into the rectangle
};

/// The rectangle with sides along u and v from a corner; normal = u x v. Lengths in m.
inline Wall make_wall(std::string name, const Vec3& corner, const Vec3& side_u, const Vec3& side_v) {
  Wall w;
  w.name = std::move(name);
  w.corner = corner;
  w.length_u = norm(side_u);
  w.length_v = norm(side_v);
  w.u = side_u * (1.0 / w.length_u);
  w.v = side_v * (1.0 / w.length_v);
  w.normal = cross(w.u, w.v);
  return w;
}

DEM_INLINE WallView look_at(const Wall& w, const Vec3& centre) {
  const Vec3 r = centre - w.corner;
  const double a = dot(r, w.u), b = dot(r, w.v);
  const double ac = a < 0.0 ? 0.0 : (a > w.length_u ? w.length_u : a);
  const double bc = b < 0.0 ? 0.0 : (b > w.length_v ? w.length_v : b);
  WallView view;
  view.nearest = w.corner + w.u * ac + w.v * bc;
  view.on_face = ac == a && bc == b;
  if (view.on_face) {
    view.distance = dot(r, w.normal);
    view.away = w.normal;
  } else {
    const Vec3 d = centre - view.nearest;
    view.distance = norm(d);
    view.away = view.distance > 0.0 ? d * (1.0 / view.distance) : w.normal;
  }
  return view;
}

/// True when the rectangle is nearer to the ball centre than the reach (m), from either side.
inline bool comes_within(const Wall& w, const Vec3& centre, double reach) {
  return std::fabs(dot(centre - w.corner, w.normal)) <= reach && look_at(w, centre).distance < reach;
}

/// True when the point lies on the rectangle, borders included, within the tolerance (m).
inline bool lies_on(const Wall& w, const Vec3& point, double tolerance) {
  const Vec3 r = point - w.corner;
  const double a = dot(r, w.u), b = dot(r, w.v), h = dot(r, w.normal);
  return h >= -tolerance && h <= tolerance && a >= -tolerance && a <= w.length_u + tolerance && b >= -tolerance &&
         b <= w.length_v + tolerance;
}

}  // namespace dem
