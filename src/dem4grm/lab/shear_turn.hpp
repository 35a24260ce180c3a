// SPDX-License-Identifier: BSD-3-Clause
// Where a test left the course of the one that it was branched from: another stress, velocity or record from there on.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "dem4grm/core/state_archive.hpp"
#include "dem4grm/specimen/rest.hpp"

namespace dem {

/// The default is a test that was sheared in one go.
struct ShearTurn {
  double ramp_begin = 0.0;     ///< m, displacement from which the halves take up their velocity
  double ramp_velocity = 0.0;  ///< m/s, that they had there
  /// The halves stand still until the specimen has come to rest under another normal stress.
  bool is_consolidating = false;
  RestState rest;
  /// Rows before these belong to another stress, velocity or interval: averages and windows do not reach back to them.
  double course_begin = 0.0;     ///< m
  std::int64_t course_rows = 0;  ///< number of rows before it
  std::int64_t row_shift = 0;    ///< the next row is number rows + row_shift on the grid of recording.interval
  /// Of another record: so many states and micro-mechanical rows were there, and the marks beyond a displacement follow.
  std::int64_t old_frames = 0, old_micro_rows = 0;
  double frames_after = -1.0, micro_after = -1.0;  ///< m; negative: the marks of the case are those of the whole test

  bool operator==(const ShearTurn& other) const;
};

void exchange(StateArchive& archive, ShearTurn& turn);

/// The displacements that were recorded, then the marks of the case beyond `after`; all marks where that is negative.
std::vector<double> marks_of_turn(std::span<const double> recorded, const std::vector<double>& of_case, double after);

}  // namespace dem
