// SPDX-License-Identifier: BSD-3-Clause
// From gradings, rubber content and box to the list of grains of a specimen.
#pragma once

#include <cstdint>

#include "dem4grm/specimen/grain_list.hpp"
#include "dem4grm/specimen/settings.hpp"
#include "dem4grm/walls/box_settings.hpp"

namespace dem {

/// Draws the grains of a specimen.
///
///   solid volume = length * width * height / (1 + expected void ratio)
///   rubber       a grading within 6 % of its D50: grains of that size, count = nearest integer of VRC * solid volume /
///                V_s. A wider one: walks along its mass axis as gravel does, with runs of eight grains of one size in
///                the place of single grains, since the engine takes rubber by the block; as many whole runs as come
///                nearest to the volume
///   gravel       walks along the mass axis of its grading: each grain covers its own share of the mass and has the
///                size at the middle of that share, so few grains follow the curve as well as many do; it stops where
///                the middle of the next share would lie beyond the end
///   shapes       their shares of volume (equal by default) at every size: drawn at random among those that lag behind
///
/// Explicit counts in the settings win over the rubber content. With an explicit number of clumps the walk is scaled
/// so that so many grains cover the mass axis exactly. The order of the gravel is shuffled at the end. The list depends
/// on the seed in shapes and order only, by the streams grain_shape and grain_order.
///
/// Densities in kg/m3, of the balls of a rubber grain and of solid rubber; only their ratio matters. Throws InputError
/// that lists every problem: contents or counts that contradict each other, unusable gradings, unknown shapes, shares that do not fit them, no grains or too many.
GrainList draw_grains(const SpecimenSettings& settings, const BoxSettings& box, double ball_density,
                      double solid_density, std::uint64_t seed);

/// Numbers of grains that the user gives must reach over the plane at which the halves part: a plate that sinks below it
/// never meets its load. Throws InputError when they do not.
void check_fills_box(const GrainList& list, const SpecimenSettings& settings, const BoxSettings& box);

}  // namespace dem
