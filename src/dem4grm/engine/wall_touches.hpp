// SPDX-License-Identifier: BSD-3-Clause
// Which of the rectangles that a ball touches push it, so that an edge shared by two rectangles counts once.
//
// A ball may see several rectangles. Contacts on a face count, once where two pieces of a flat wall meet. A contact at
// an edge or corner counts only if its point does not lie on a rectangle that the ball touches on its face (there it is
// no edge at all: a flat wall made of two pieces pushes like one), nor coincides with an edge contact already counted
// (a convex edge belongs to two rectangles).
#pragma once

#include <array>
#include <vector>

#include "dem4grm/engine/simulation.hpp"

namespace dem {

/// One rectangle as the present ball sees it.
struct Touch {
  std::size_t row = 0;  ///< of the contact table
  int wall = 0;
  WallView view;
  bool counts = false;
};

using Touches = std::array<Touch, k_most_walls_per_ball>;

/// Whether a ball of this radius, m, and the rectangle touch; from behind only while the ball is not through.
inline bool touches(const WallView& view, double radius) {
  return view.distance < radius && (!view.on_face || view.distance > -radius);
}

/// Decides which of the n touches of one ball of this radius, m, count.
void resolve_touches(const std::vector<Wall>& walls, double radius, Touches& t, int n);

/// A ball that rolls from one piece of a flat wall to the next takes its shear force along.
void hand_over_shear(ContactTable& c, const Touches& t, int n);

}  // namespace dem
