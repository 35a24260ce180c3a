// SPDX-License-Identifier: BSD-3-Clause
// What is saved of a preparation.
#include "dem4grm/specimen/specimen.hpp"

#include <span>
#include <string_view>

#include "dem4grm/core/error.hpp"
#include "dem4grm/engine/simulation_state.hpp"

namespace dem {
namespace {

void exchange(StateArchive& archive, SpecimenReport& r) {
  archive.exchange("void_ratio_generated", r.void_ratio_generated);
  archive.exchange("preparation_friction", r.preparation_friction);
  archive.exchange("void_ratio_prepared", r.void_ratio_prepared);
  archive.exchange("void_ratio_before_shear", r.void_ratio_before_shear);
  archive.exchange("height", r.height);
  archive.exchange("split_height", r.split_height);
  archive.exchange("alignment_generated", r.alignment_generated);
  archive.exchange("alignment_before_shear", r.alignment_before_shear);
  archive.exchange("fill_overlap", r.fill_overlap);
  archive.exchange("caught", r.caught);
  archive.exchange("time_step_limit", r.time_step.seconds);
  archive.exchange("time_step_limited_by", r.time_step.limited_by);
  archive.exchange("fill_steps", r.fill_steps);
  archive.exchange("branch_steps", r.branch_steps);
  archive.exchange("compression_steps", r.compression_steps);
  archive.exchange("friction_steps", r.friction_steps);
  archive.group("branches", [&] { dem::exchange(archive, r.branches); });
}

/// Seven numbers for each pose: position (m), orientation.
void exchange(StateArchive& archive, std::string_view name, std::vector<Pose>& poses) {
  std::vector<double> numbers;
  for (const Pose& p : poses) {
    const Quaternion& q = p.orientation;
    numbers.insert(numbers.end(), {p.position.x, p.position.y, p.position.z, q.w, q.x, q.y, q.z});
  }
  archive.exchange(name, numbers);
  if (numbers.size() % 7 != 0) throw IoError("the saved poses are cut off");
  poses.resize(numbers.size() / 7);
  for (std::size_t k = 0; k < poses.size(); ++k) {
    const std::span<const double, 7> v(numbers.data() + 7 * k, 7);
    poses[k] = {{v[0], v[1], v[2]}, {v[3], v[4], v[5], v[6]}};
  }
}

}  // namespace

std::optional<double> SpecimenReport::relative_density_reached() const {
  if (branches.size() < 2) return std::nullopt;
  return relative_density(branches[0].void_ratio, branches[1].void_ratio, branches.back().void_ratio);
}

void exchange(StateArchive& archive, std::vector<Branch>& branches) {
  std::vector<double> numbers;
  std::vector<std::int64_t> steps;
  for (const Branch& b : branches) {
    numbers.insert(numbers.end(), {b.friction, b.stress, b.void_ratio});
    steps.push_back(b.steps);
  }
  archive.exchange("numbers", numbers);
  archive.exchange("steps", steps);
  if (numbers.size() != 3 * steps.size()) throw IoError("the saved branches are cut off");
  branches.resize(steps.size());
  for (std::size_t k = 0; k < steps.size(); ++k) {
    branches[k] = {numbers[3 * k], numbers[3 * k + 1], numbers[3 * k + 2], steps[k]};
  }
}

void exchange(StateArchive& archive, RestState& r) {
  archive.exchange("steps", r.steps);
  archive.exchange("held", r.held);
  archive.exchange("stress", r.stress);
  archive.exchange("plate_speed", r.plate_speed);
  archive.exchange("unbalanced_ratio", r.unbalanced_ratio);
  archive.exchange("void_ratio", r.void_ratio);
}

void exchange(StateArchive& archive, FillState& f) {
  archive.exchange("growth_steps", f.growth_steps);
  archive.exchange("relaxation_steps", f.relaxation_steps);
  archive.exchange("steps", f.steps);
}

void exchange(StateArchive& archive, Fill& f) {
  exchange(archive, "gravel", f.gravel);
  exchange(archive, "rubber", f.rubber);
  archive.exchange("height", f.height);
  archive.exchange("largest_overlap", f.largest_overlap);
  archive.exchange("caught", f.caught);
  archive.exchange("alignment", f.alignment);
  archive.exchange("steps", f.steps);
}

void exchange(StateArchive& archive, Specimen& specimen) {
  archive.exchange("gravel_order", specimen.gravel_order);
  archive.group("report", [&] { exchange(archive, specimen.report); });
  archive.group("simulation", [&] { exchange(archive, *specimen.simulation); });
}

}  // namespace dem
