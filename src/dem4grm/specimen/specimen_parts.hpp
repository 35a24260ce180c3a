// SPDX-License-Identifier: BSD-3-Clause
// The parts that a preparation is put together from: what the grains are, their numbering, the scene of a fill.
#pragma once

#include <vector>

#include "dem4grm/specimen/specimen.hpp"

namespace dem {

/// Rubber content, volume-weighted mean size and density of the solids, into the report.
void describe(const GrainList& grains, const SpecimenOrder& order, SpecimenReport& report);

/// Puts the gravel into the order that was saved; order[k]: the drawn grain that becomes gravel grain k. Throws IoError
/// when it is no permutation of the grains.
void renumber_gravel(GrainList& grains, const std::vector<int>& order);

/// Puts the grains of each kind in the order of a curve through the box, so that neighbours lie side by side in memory
/// for the whole test. Returns the order for renumber_gravel.
std::vector<int> number_along_curve(GrainList& grains, Fill& fill);

/// The grains of a fill in the shear box.
Scene scene_of(const SpecimenOrder& order, const GrainList& grains, const Fill& fill);

/// A fill of the right make with every grain at the origin, for a scene whose state is loaded afterwards.
Fill fill_of_nowhere(const SpecimenOrder& order, const GrainList& grains);

/// One friction between all grains and against the plates, which cap it with their own.
FrictionTable preparation_friction(double friction);

}  // namespace dem
