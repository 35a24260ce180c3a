// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/lab/shear_turn.hpp"

#include <tuple>

#include "dem4grm/specimen/specimen.hpp"

namespace dem {
namespace {

auto parts_of(const ShearTurn& t) {
  return std::tie(t.ramp_begin, t.ramp_velocity, t.is_consolidating, t.course_begin, t.course_rows, t.row_shift,
                  t.old_frames, t.old_micro_rows, t.frames_after, t.micro_after);
}

}  // namespace

bool ShearTurn::operator==(const ShearTurn& other) const { return parts_of(*this) == parts_of(other); }

void exchange(StateArchive& archive, ShearTurn& t) {
  archive.exchange("ramp_begin", t.ramp_begin);
  archive.exchange("ramp_velocity", t.ramp_velocity);
  archive.exchange("is_consolidating", t.is_consolidating);
  archive.group("rest", [&] { exchange(archive, t.rest); });
  archive.exchange("course_begin", t.course_begin);
  archive.exchange("course_rows", t.course_rows);
  archive.exchange("row_shift", t.row_shift);
  archive.exchange("old_frames", t.old_frames);
  archive.exchange("old_micro_rows", t.old_micro_rows);
  archive.exchange("frames_after", t.frames_after);
  archive.exchange("micro_after", t.micro_after);
}

std::vector<double> marks_of_turn(std::span<const double> recorded, const std::vector<double>& of_case, double after) {
  if (after < 0.0) return of_case;
  std::vector<double> marks(recorded.begin(), recorded.end());
  for (const double mark : of_case) {
    if (mark > after) marks.push_back(mark);
  }
  return marks;
}

}  // namespace dem
