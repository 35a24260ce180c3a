// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/engine/wall_touches.hpp"

namespace dem {

void resolve_touches(const std::vector<Wall>& walls, double radius, Touches& t, int n) {
  const double tolerance = 1e-6 * radius;
  for (int a = 0; a < n; ++a) {
    Touch& edge = t[static_cast<std::size_t>(a)];
    edge.counts = touches(edge.view, radius);
    if (!edge.counts) continue;
    for (int b = 0; b < n && edge.counts; ++b) {
      const Touch& other = t[static_cast<std::size_t>(b)];
      const bool other_touches = other.view.distance < radius;
      if (a == b || !other_touches) continue;
      if (edge.view.on_face) {
        // A centre exactly over a seam projects into both pieces of the flat wall.
        edge.counts = !(b < a && other.counts && other.view.on_face && dot(edge.view.away, other.view.away) > 0.5 &&
                        norm(edge.view.nearest - other.view.nearest) <= tolerance);
      } else if (other.view.on_face) {
        edge.counts = !lies_on(walls[static_cast<std::size_t>(other.wall)], edge.view.nearest, tolerance);
      } else if (b < a && other.counts) {
        edge.counts = norm(edge.view.nearest - other.view.nearest) > tolerance;
      }
    }
  }
}

void hand_over_shear(ContactTable& c, const Touches& t, int n) {
  for (int a = 0; a < n; ++a) {
    const Touch& to = t[static_cast<std::size_t>(a)];
    if (!to.counts || !to.view.on_face || dot(c.shear(to.row), c.shear(to.row)) > 0.0) continue;
    for (int b = 0; b < n; ++b) {
      const Touch& from = t[static_cast<std::size_t>(b)];
      if (from.counts || dot(from.view.away, to.view.away) < 0.0) continue;
      const Vec3 f = c.shear(from.row);
      if (!(dot(f, f) > 0.0)) continue;
      c.state[to.row].shear = f;
      break;
    }
  }
}

}  // namespace dem
