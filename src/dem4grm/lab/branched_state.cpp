// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/lab/branched_state.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

#include "dem4grm/core/error.hpp"
#include "dem4grm/lab/direct_shear.hpp"
#include "dem4grm/lab/record_state.hpp"
#include "dem4grm/lab/shear_turn.hpp"
#include "dem4grm/lab/shear_velocity.hpp"
#include "dem4grm/specimen/specimen.hpp"
#include "dem4grm/specimen/stage_names.hpp"
#include "dem4grm/walls/shear_box.hpp"

namespace dem {
namespace {

/// What a state of shear says about its record.
struct ShearRecord {
  double displacement = 0.0;
  std::int64_t steps = 0;
  std::vector<FrameInfo> frames;
  std::vector<ShearRow> rows;
  std::vector<MicroRow> micro_rows;
  ShearTurn turn;
};

ShearRecord record_of(StateArchive& state) {
  ShearRecord out;
  state.group("shear", [&] {
    state.exchange("displacement", out.displacement);
    state.exchange("steps", out.steps);
    exchange(state, out.frames);
    exchange(state, out.rows);
    exchange(state, out.micro_rows);
    if (state.has_group("turn")) state.group("turn", [&] { exchange(state, out.turn); });
  });
  return out;
}

BranchStage stage_of_name(StateArchive& state) {
  std::string name;
  state.exchange("stage", name);
  if (name == stage_name::k_fill) return BranchStage::fill;
  if (name == stage_name::k_branch) return BranchStage::search;
  if (name == stage_name::k_compression) return BranchStage::compression;
  if (name == stage_name::k_final_friction) return BranchStage::final_friction;
  if (name == stage_name::k_shear) return BranchStage::shear;
  throw IoError("the saved state is from an unknown stage \"" + name + "\"");
}

/// Do the marks of a case go on where a record stands? Then its list serves as it is.
template <class Recorded>
bool are_continued(const std::vector<Recorded>& recorded, const std::vector<double>& marks, double displacement,
                   double interval) {
  if (recorded.size() > marks.size()) return false;
  for (std::size_t k = 0; k < recorded.size(); ++k) {
    // A mark is met at the end of the row that is nearest to it.
    if (std::fabs(recorded[k].displacement - marks[k]) > 0.501 * interval) return false;
  }
  return recorded.size() == marks.size() || marks[recorded.size()] > displacement - 0.5 * interval;
}

/// Beyond where the marks of another record count: not those that have just been met.
template <class Recorded>
double marks_begin(const std::vector<Recorded>& recorded, double displacement, double interval) {
  return recorded.empty() ? displacement : std::max(displacement, recorded.back().displacement + 0.5 * interval);
}

/// The record of `to` from here on; nothing changes where it is that of one longer test.
void turn_record(ShearTurn& turn, const ShearRecord& past, const DirectShearCase& to) {
  const double interval = to.recording.interval, d = past.displacement;
  const auto rows = static_cast<std::int64_t>(past.rows.size());
  const auto end_of = [&](std::int64_t row) { return static_cast<double>(row) * interval * (1.0 - 1e-12); };
  const std::int64_t next = rows + turn.row_shift;
  if (!(end_of(next) <= d && d < end_of(next + 1))) {
    turn.row_shift = static_cast<std::int64_t>(std::floor(d / interval * (1.0 + 1e-12))) - rows;
  }
  if (turn.frames_after >= 0.0 || !are_continued(past.frames, state_displacements(to), d, interval)) {
    turn.old_frames = static_cast<std::int64_t>(past.frames.size());
    turn.frames_after = marks_begin(past.frames, d, interval);
  }
  if (turn.micro_after >= 0.0 || !are_continued(past.micro_rows, micro_displacements(to), d, interval)) {
    turn.old_micro_rows = static_cast<std::int64_t>(past.micro_rows.size());
    turn.micro_after = marks_begin(past.micro_rows, d, interval);
  }
}

/// A new course: averages begin anew.
void begin_course(std::vector<StateEntry>& entries, ShearTurn& turn, const ShearRecord& past) {
  turn.course_begin = past.displacement;
  turn.course_rows = static_cast<std::int64_t>(past.rows.size());
  for (StateEntry& e : entries) {
    if (!e.name.starts_with("shear.sums.")) continue;
    std::visit([](auto& numbers) { std::fill(numbers.begin(), numbers.end(), 0); }, e.data);
  }
}

void put_turn(std::vector<StateEntry>& entries, ShearTurn turn) {
  std::erase_if(entries, [](const StateEntry& e) { return e.name.starts_with("shear.turn."); });
  if (turn == ShearTurn{}) return;
  StateArchive saved;
  saved.group("shear", [&] { saved.group("turn", [&] { exchange(saved, turn); }); });
  entries.insert(entries.end(), saved.entries().begin(), saved.entries().end());
}

}  // namespace

std::string stage_words(BranchStage stage) {
  switch (stage) {
    case BranchStage::fill:
      return "the fill";
    case BranchStage::search:
      return "the search for the density";
    case BranchStage::compression:
      return "the compression";
    case BranchStage::final_friction:
      return "the final friction";
    case BranchStage::specimen:
      return "the finished specimen";
    case BranchStage::shear:
      break;
  }
  return "shear";
}

BranchPoint branch_point_of(StateArchive& state, const DirectShearCase& test) {
  BranchPoint point;
  point.stage = stage_of_name(state);
  if (point.stage == BranchStage::fill) return point;
  const SpecimenOrder order = specimen_order(test);
  const Specimen specimen = load_specimen(order, state);
  const std::vector<Wall>& walls = specimen.simulation->walls;
  point.state_hash = specimen.simulation->state_hash();
  point.halves_velocity = walls[ShearBox::k_bottom_plate].velocity.x - walls[ShearBox::k_top_plate].velocity.x;
  point.shear_velocity = shear_velocity(test.shear, specimen.report);
  if (point.stage != BranchStage::shear) return point;
  ShearRecord record;
  if (state.has_group("shear")) record = record_of(state);
  if (record.steps == 0 && !record.turn.is_consolidating) point.stage = BranchStage::specimen;
  point.displacement = record.displacement;
  point.frames = std::move(record.frames);
  return point;
}

StateArchive branched_state(const StateArchive& state, const BranchPoint& point, const DirectShearCase& from,
                            const DirectShearCase& to) {
  std::vector<StateEntry> entries = state.entries();
  const bool has_other_stress = from.shear.normal_stress != to.shear.normal_stress;
  if (point.stage != BranchStage::shear) {
    // Before its first step shear has nothing that the specimen does not have, so it begins anew.
    std::erase_if(entries, [](const StateEntry& e) { return e.name.starts_with("shear."); });
    if (has_other_stress) rest_under_other_stress(entries);
    return StateArchive(std::move(entries));
  }
  StateArchive past_state(entries);
  const ShearRecord past = record_of(past_state);
  ShearTurn turn = past.turn;
  // A velocity that is chosen for an inertial number follows the stress, too.
  const double velocity = to.shear.velocity.value_or(0.0);
  const bool has_other_velocity = to.shear.velocity
                                      ? velocity != point.shear_velocity
                                      : from.shear.velocity || from.shear.inertial_number != to.shear.inertial_number;
  if (has_other_stress) {
    turn.is_consolidating = true;
    turn.rest = {};
  }
  if (has_other_stress || has_other_velocity) {
    turn.ramp_begin = past.displacement;
    turn.ramp_velocity = turn.is_consolidating ? 0.0 : point.halves_velocity;
  }
  if (has_other_stress || has_other_velocity || from.recording.interval != to.recording.interval) {
    begin_course(entries, turn, past);
  }
  turn_record(turn, past, to);
  put_turn(entries, turn);
  return StateArchive(std::move(entries));
}

}  // namespace dem
