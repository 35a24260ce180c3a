// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/lab/shear_stage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "dem4grm/core/error.hpp"
#include "dem4grm/core/quantity.hpp"
#include "dem4grm/engine/simulation_state.hpp"
#include "dem4grm/engine/time_step.hpp"
#include "dem4grm/lab/direct_shear.hpp"
#include "dem4grm/lab/record_state.hpp"
#include "dem4grm/lab/shear_curve.hpp"
#include "dem4grm/lab/shear_velocity.hpp"
#include "dem4grm/lab/shear_watch.hpp"
#include "dem4grm/specimen/stage_names.hpp"
#include "dem4grm/walls/shear_box.hpp"

namespace dem {
namespace {

constexpr int k_numbers_interval = 100;  // between two quick ones, for values that are no number
/// The halves reach their velocity over this displacement, so that the start is no blow.
constexpr double k_start_ramp = 2e-5;  // m

void exchange_forces(StateArchive& archive, std::array<Vec3, ShearBox::k_walls>& forces) {
  std::vector<double> numbers;
  for (const Vec3& f : forces) numbers.insert(numbers.end(), {f.x, f.y, f.z});
  archive.exchange("on_wall", numbers);
  if (numbers.size() != 3 * forces.size()) throw IoError("the saved forces on the walls are not those of a shear box");
  for (std::size_t w = 0; w < forces.size(); ++w) forces[w] = {numbers[3 * w], numbers[3 * w + 1], numbers[3 * w + 2]};
}

}  // namespace

ShearStage::ShearStage(const DirectShearCase& test, Specimen& specimen, BeforeShear& before, LabObserver& observer)
    : test_(test),
      specimen_(specimen),
      s_(*specimen.simulation),
      before_(before),
      observer_(observer),
      frames_(state_displacements(test)),
      micro_(micro_displacements(test)),
      velocity_(shear_velocity(test.shear, specimen.report)) {
  s_.servo.speed_cap = plate_speed_cap(test, velocity_);
  start_height_ = plate_height();
  start_energy_ = s_.energy();
}

void ShearStage::run(StateArchive* from) {
  if (from == nullptr) {
    write_frame();
    observer_.specimen_ready(specimen_state(), specimen_.report);
    record_micro();
    keep(true);
  } else {
    from->group("shear", [&] { exchange_all(*from); });
    observer_.resumed({rows_, written_frames_, micro_rows_, start_energy_});
  }
  if (!observer_.wants_shear()) return;
  if (turn_.is_consolidating) consolidate();
  tell_velocity();
  while (displacement_ < test_.shear.displacement * (1.0 - 1e-12)) {
    advance();
    const bool is_watched = ++shear_steps_ % k_watch_interval == 0;
    if (is_watched || (shear_steps_ % k_numbers_interval == 0 && !has_only_numbers(s_))) watch();
    if (displacement_ >= next_row_at() * (1.0 - 1e-12)) {
      finish_row();
      if (has_reached(frames_, next_frame_)) write_frame();
      if (has_reached(micro_, micro_rows_.size())) record_micro();
    }
    if (is_watched) keep(false);
  }
  if (observer_.wants_end_state()) observer_.end_state(complete_state());
}

void ShearStage::tell_velocity() {
  if (test_.shear.velocity) return;
  observer_.note(fmt::format("shears with {}, chosen for an inertial number of {:g}; the plate with at most {}",
                             format_quantity(velocity_, Dimension::speed),
                             test_.shear.inertial_number.value_or(k_default_inertial_number),
                             format_quantity(s_.servo.speed_cap, Dimension::speed)));
}

double ShearStage::plate_height() const { return s_.walls[ShearBox::k_top_plate].corner.z; }

double ShearStage::next_row_at() const {
  const auto row = static_cast<std::int64_t>(rows_.size()) + 1 + turn_.row_shift;
  return std::min(static_cast<double>(row) * test_.recording.interval, test_.shear.displacement);
}

bool ShearStage::has_reached(const std::vector<double>& at, std::size_t number) const {
  return number < at.size() && displacement_ >= at[number] - 0.5 * test_.recording.interval;
}

double ShearStage::halves_velocity() const {
  const double way = displacement_ - turn_.ramp_begin, v0 = turn_.ramp_velocity;
  const double ramp = std::min(1.0, std::max(0.02, std::sqrt(way / k_start_ramp)));
  return v0 + (velocity_ - v0) * ramp;
}

void ShearStage::advance() {
  const double v = halves_velocity();
  ShearBox::set_velocities(s_.walls, test_.shear.moving_half, v, s_.walls[ShearBox::k_top_plate].velocity.z);
  s_.step();
  displacement_ += v * s_.dt;
  review_time_step(s_, longest_time_step());
  for (int w = 0; w < ShearBox::k_walls; ++w) {
    const Vec3& force = s_.reactions[static_cast<std::size_t>(w)].force;
    (ShearBox::half_of(w) == BoxHalf::lower ? sums_.lower : sums_.upper) += force.x;
    sums_.on_wall[static_cast<std::size_t>(w)] += force;
  }
  sums_.bottom_plate += s_.reactions[ShearBox::k_bottom_plate].force.x;
  const double normal = plate_stress(s_, specimen_.load), target = test_.shear.normal_stress;
  sums_.normal += normal;
  if (sums_.steps == 0 || std::fabs(normal - target) > std::fabs(sums_.worst_normal - target)) {
    sums_.worst_normal = normal;
  }
  ++sums_.steps;
}

void ShearStage::finish_row() {
  const double area = specimen_.load.area, n = sums_.steps;
  ShearRow row;
  row.displacement = displacement_;
  // The lower half moves to +x against the grains, which push it back: its shear stress is minus their force.
  row.shear_stress = -sums_.lower / n / area;
  const double of_nominal_area = test_.box.length / (test_.box.length - displacement_);
  row.shear_stress_corrected = row.shear_stress * of_nominal_area;
  row.half_force_difference = -(sums_.lower + sums_.upper) / n / area;
  row.plate_shear_stress = -sums_.bottom_plate / n / area;
  row.normal_stress = sums_.normal / n;
  row.normal_stress_corrected = row.normal_stress * of_nominal_area;
  row.normal_stress_worst = sums_.worst_normal;
  row.vertical_displacement = plate_height() - start_height_;
  row.void_ratio = plate_void_ratio(s_, specimen_.load);
  row.inertial_number = inertial_number_at(velocity_, specimen_.report, row.normal_stress);
  row.unbalanced_ratio = balance(s_).ratio();
  row.time_step = s_.dt;
  row.energy = since_start(s_.energy());
  for (std::size_t w = 0; w < sums_.on_wall.size(); ++w) row.wall_force[w] = sums_.on_wall[w] * (1.0 / n);
  rows_.push_back(row);
  rows_.back().dilatancy = last_dilatancy(course());
  sums_ = {};
  observer_.shear_row(rows_.back());
  report();
}

EnergyReport ShearStage::since_start(EnergyReport e) const {
  e.boundary_work -= start_energy_.boundary_work;
  e.slip -= start_energy_.slip;
  e.dashpot -= start_energy_.dashpot;
  e.local_damping -= start_energy_.local_damping;
  e.breakage -= start_energy_.breakage;
  return e;
}

void ShearStage::report() {
  const ShearRow& r = rows_.back();
  Progress p;
  p.stage = "shear";
  p.fraction = displacement_ / test_.shear.displacement;
  p.displacement = displacement_;
  p.shear_stress = r.shear_stress;
  p.normal_stress = r.normal_stress;
  p.void_ratio = r.void_ratio;
  p.inertial_number = r.inertial_number;
  p.shear_velocity = velocity_;
  p.unbalanced_ratio = r.unbalanced_ratio;
  p.steps = shear_steps_;
  p.time_step = s_.dt;
  observer_.progress(p);
}

void ShearStage::watch() {
  const Trouble trouble = find_trouble(s_, ShearBox::rooms_of(s_.walls), k_overlap_limit);
  if (trouble.kind == TroubleKind::none) {
    check_books();
    if (!rows_.empty()) report();
    return;
  }
  const std::string advice = advice_for(trouble, test_.box, s_.walls);
  throw PhysicsError(
      fmt::format("{} (stage shear, {:.3f} mm){}", trouble.text, displacement_ * 1e3,
                  advice.empty() ? ". Try a smaller integration.time_step_safety or a slower shear.velocity" : advice));
}

void ShearStage::check_books() const {
  const EnergyReport now = s_.energy();
  const double given = now.boundary_work - start_energy_.boundary_work + start_energy_.kinetic +
                       start_energy_.contact_strain + start_energy_.bond_strain;
  check_kinetic_energy(now.kinetic, given, displacement_);
  check_plate_stress(course(), displacement_, test_.shear.normal_stress, turn_.course_begin);
}

void ShearStage::write_frame() {
  written_frames_.push_back({static_cast<int>(next_frame_), displacement_, s_.state_hash()});
  observer_.frame(s_, written_frames_.back());
  ++next_frame_;
}

void ShearStage::record_micro() {
  micro_rows_.push_back({displacement_, analyse(micro_state_of(s_), {}).numbers});
  observer_.micro_row(micro_rows_.back());
}

StateArchive ShearStage::specimen_state() {
  StateArchive archive;
  std::string stage = stage_name::k_shear;
  archive.exchange("stage", stage);
  exchange(archive, specimen_);
  return archive;
}

void ShearStage::keep(bool is_new_stage) {
  if (observer_.wants_checkpoint(is_new_stage)) observer_.checkpoint(complete_state());
}

StateArchive ShearStage::complete_state() {
  StateArchive archive = specimen_state();
  archive.group("shear", [&] { exchange_all(archive); });
  return archive;
}

void ShearStage::exchange_all(StateArchive& archive) {
  archive.exchange("displacement", displacement_);
  archive.exchange("start_height", start_height_);
  archive.group("start_energy", [&] { exchange(archive, start_energy_); });
  archive.exchange("steps", shear_steps_);
  archive.group("before", [&] { exchange(archive, before_); });
  archive.group("sums", [&] {
    archive.exchange("lower", sums_.lower);
    archive.exchange("upper", sums_.upper);
    archive.exchange("normal", sums_.normal);
    archive.exchange("bottom_plate", sums_.bottom_plate);
    archive.exchange("worst_normal", sums_.worst_normal);
    exchange_forces(archive, sums_.on_wall);
    archive.exchange("steps", sums_.steps);
  });
  exchange(archive, written_frames_);
  next_frame_ = written_frames_.size();
  exchange(archive, rows_);
  exchange(archive, micro_rows_);
  exchange_turn(archive);
}

void ShearStage::exchange_turn(StateArchive& archive) {
  if (archive.is_loading() ? !archive.has_group("turn") : turn_ == ShearTurn{}) return;
  archive.group("turn", [&] { exchange(archive, turn_); });
  if (!archive.is_loading()) return;
  if (turn_.course_rows < 0 || turn_.course_rows > static_cast<std::int64_t>(rows_.size())) {
    throw IoError("the saved course of shear does not fit its rows");
  }
  const auto recorded = [](const auto& list, std::int64_t count) {
    std::vector<double> out;
    out.reserve(list.size());
    for (const auto& one : list) out.push_back(one.displacement);
    out.resize(std::min(out.size(), static_cast<std::size_t>(std::max<std::int64_t>(0, count))));
    return out;
  };
  frames_ = marks_of_turn(recorded(written_frames_, turn_.old_frames), state_displacements(test_), turn_.frames_after);
  micro_ = marks_of_turn(recorded(micro_rows_, turn_.old_micro_rows), micro_displacements(test_), turn_.micro_after);
}

}  // namespace dem
