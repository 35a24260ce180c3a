// SPDX-License-Identifier: BSD-3-Clause
// One rubber grain between two rigid plates.
#pragma once

#include <vector>

#include "dem4grm/engine/time_step.hpp"
#include "dem4grm/lab/case.hpp"
#include "dem4grm/lab/observer.hpp"

namespace dem {

/// Outcome of a grain compression, SI units.
struct GrainCompressionResult {
  std::vector<CompressionRow> rows;
  double grain_height = 0.0;  ///< m, outer height at rest
  double initial_stiffness =
      0.0;  ///< N/m, load over displacement between 2 % and 8 % strain; not a number with fewer than
            ///< two rows there, as are the next and poisson_ratio_initial
  double late_stiffness = 0.0;         ///< N/m, the same over the last quarter of the strain
  double knee_strain = 0.0;            ///< where the first second neighbours touch; 0 if never
  double poisson_ratio_initial = 0.0;  ///< mean between 2 % and 8 % strain
  double time_step = 0.0;              ///< s
  TimeStepLimit time_step_limit;
  std::int64_t steps = 0;
  std::string state_hash;
};

/// The grain of a case at the origin, square to the axes, without plates.
Scene lone_grain(const GrainCompressionCase& test);

/// Both plates approach at plate_velocity until the strain is reached. Throws PhysicsError when the grain breaks up.
GrainCompressionResult run_grain_compression(const GrainCompressionCase& test, LabObserver& observer);

}  // namespace dem
