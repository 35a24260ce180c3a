// SPDX-License-Identifier: BSD-3-Clause
// The direct shear test, from a case to its curve.
#pragma once

#include <vector>

#include "dem4grm/lab/before_shear.hpp"
#include "dem4grm/lab/case.hpp"
#include "dem4grm/lab/observer.hpp"
#include "dem4grm/lab/shear_curve.hpp"
#include "dem4grm/specimen/specimen.hpp"

namespace dem {

/// What is left of a test beside its rows and frames; SI units.
struct DirectShearResult {
  SpecimenReport specimen;
  BeforeShear before;
  ShearCurve curve;
  std::vector<ShearRow> rows;
  std::vector<MicroRow> micro_rows;
  double displacement = 0.0;
  /// Of a test that was branched from another one under another stress, velocity or interval: rows and displacement (m) before;
  /// curve and means below are those of what came after.
  std::size_t rows_before = 0;
  double displacement_before = 0.0;
  double shear_velocity = 0.0;             ///< m/s, as given or chosen
  double normal_stress_mean = 0.0;         ///< Pa, over the shear stage
  double normal_stress_max_error = 0.0;    ///< largest relative error of a row
  double normal_stress_worst_step = 0.0;   ///< largest relative error of a single step
  double half_force_imbalance_mean = 0.0;  ///< mean |lower - upper| over the peak shear force
  double inertial_number_max = 0.0;
  double unbalanced_ratio_mean = 0.0;
  int balls = 0, clumps = 0, rubber_grains = 0, bonds = 0, broken_bonds = 0, lost_grains = 0;
  std::int64_t steps = 0;  ///< of all stages
  double time_step = 0.0;  ///< s
  std::string state_hash;
};

/// Runs the whole test, from the beginning or from what an observer's checkpoint() was given. The observer hears of
/// everything as it happens and may throw to stop. Throws InputError and PhysicsError; a physics error names the worst
/// offender; IoError when the state to go on from does not fit the case.
DirectShearResult run_direct_shear(const DirectShearCase& test, LabObserver& observer, StateArchive* from = nullptr);

/// Displacements at which full states are recorded, m, ascending: the start, the extra ones, every frame_interval, the end.
std::vector<double> state_displacements(const DirectShearCase& test);

/// Displacements at which the micro-mechanics is recorded, m, ascending: the start, every micro_interval, the end.
std::vector<double> micro_displacements(const DirectShearCase& test);

/// The scene of a case without grains and walls.
Scene materials_of(const DirectShearCase& test);

/// What the preparation of a case needs.
SpecimenOrder specimen_order(const DirectShearCase& test);

}  // namespace dem
