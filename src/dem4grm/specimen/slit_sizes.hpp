// SPDX-License-Identifier: BSD-3-Clause
// Which slit between the halves of the box lets the grains of a case out.
//
//   gravel  rigid: it passes only a slit that is wider than its thickest pebble, whatever way it turns, since that pebble must
//           pass; a thinner pebble may get into a narrower slit
//   rubber  soft: it is squeezed through a slit about as wide as its sieve size (at 1.02 of it the second neighbours of the
//           squeezed grain touch); single balls get into slits wider than they are
// Necessary for a way out, not sufficient: a slit below `passes` is safe for rigid grains.
#pragma once

#include <string>

#include "dem4grm/specimen/settings.hpp"

namespace dem {

struct SlitSizes {
  double passes = 0.0;  ///< m, smallest slit that may let a grain out; infinite without grains
  double enters = 0.0;  ///< m, smallest slit that a pebble or ball gets into
  std::string grain;    ///< which grain passes first, in words
};

/// Of the smallest grains of both gradings, over all shapes that are used. Densities in kg/m3, of the balls of a rubber
/// grain and of solid rubber. Gradings and shapes must be good.
SlitSizes slit_sizes(const SpecimenSettings& settings, double ball_density, double solid_density);

}  // namespace dem
