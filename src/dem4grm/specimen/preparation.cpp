// SPDX-License-Identifier: BSD-3-Clause
// The stages of a preparation in order; each begins where the one before or a saved state left it.
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "dem4grm/core/error.hpp"
#include "dem4grm/engine/simulation_state.hpp"
#include "dem4grm/specimen/branch_words.hpp"
#include "dem4grm/specimen/draw_grains.hpp"
#include "dem4grm/specimen/specimen.hpp"
#include "dem4grm/specimen/specimen_parts.hpp"
#include "dem4grm/specimen/stage_names.hpp"
#include "dem4grm/specimen/void_ratio_defaults.hpp"
#include "dem4grm/walls/shear_box.hpp"

namespace dem {
namespace {

using stage_name::k_branch, stage_name::k_compression, stage_name::k_fill, stage_name::k_final_friction;

// For the forecast only: steps from the first load to rest, and trials until the density is met.
constexpr double k_usual_rest = 6000.0;
constexpr int k_usual_branches = 4;

class Preparation {
 public:
  Preparation(const SpecimenOrder& order, const PreparationHooks& hooks) : order_(order), hooks_(hooks) {
    out_.grains =
        draw_grains(order.specimen, order.box, order.materials.rubber.density, order.solid_density, order.seed);
    check_fills_box(out_.grains, order.specimen, order.box);
    describe(out_.grains, order, out_.report);
    out_.report.void_ratio_generated = generation_void_ratio(order.specimen);
    out_.load = {ShearBox::k_top_plate, order.box.length * order.box.width,
                 order.normal_stress,   order.specimen.approach_speed,
                 order.servo.gain,      out_.grains.solid_volume()};
    layer_ = {out_.load.solid_volume * (1.0 + out_.report.void_ratio_generated) / out_.load.area, out_.report.mean_size,
              out_.report.mean_density};
    target_ = {order.specimen.relative_density.value_or(k_default_relative_density),
               order.specimen.relative_density_tolerance, order.specimen.smallest_friction,
               order.specimen.largest_friction};
  }

  Specimen run() {
    if (hooks_.resumed != nullptr) {
      hooks_.resumed->exchange("stage", stage_);
      if (stage_ != k_fill) load(*hooks_.resumed);
    }
    if (stage_ == k_fill) {
      if (!fetch_fill()) make_new_fill();
      order_.specimen.preparation_friction ? begin_compression_of_fill(*order_.specimen.preparation_friction)
                                           : begin_branch(target_.smallest_friction);
    }
    while (stage_ == k_branch) {
      run_stations();
      finish_branch();
    }
    if (stage_ == k_compression) {
      run_stations();
      begin_final_friction();
    }
    if (stage_ == k_final_friction) {
      rest(order_.equilibrium);
      finish();
    }
    return std::move(out_);
  }

  Specimen load_only() {
    hooks_.resumed->exchange("stage", stage_);
    if (stage_ == k_fill) throw IoError("the saved state is from the fill, which has no specimen yet");
    load(*hooks_.resumed);
    return std::move(out_);
  }

 private:
  // ---- the fill

  void make_new_fill() {
    FillSettings settings;
    settings.void_ratio = out_.report.void_ratio_generated;
    settings.friction = order_.specimen.generation_friction;
    settings.generation = order_.specimen.generation;
    settings.seed = order_.seed;
    FillHooks hooks;
    hooks.restore = [&](FillState& state, Simulation& s) {
      if (hooks_.resumed != nullptr) exchange_fill(*hooks_.resumed, state, s);
    };
    hooks.between = [&](double share, FillState& state, Simulation& s) {
      if (!hooks_.watch || state.is_relaxed) return;
      PreparationState now{k_fill, share, {}, 0.0, -1.0, false};
      now.rest.steps = state.steps;
      hooks_.watch(now, [&](StateArchive& archive) {
        archive.exchange("stage", stage_);
        exchange_fill(archive, state, s);
      });
    };
    fill_ = make_fill(out_.grains, order_.box, order_.materials, settings, hooks);
    if (fill_.caught > 0) {
      throw PhysicsError(
          fmt::format("the random fill caught {} ball centres inside other grains; choose another seed, a "
                      "larger generation_void_ratio or generation = \"grown\"",
                      fill_.caught));
    }
    out_.gravel_order = number_along_curve(out_.grains, fill_);
    if (hooks_.keep) {
      StateArchive archive;
      archive.exchange("gravel_order", out_.gravel_order);
      exchange(archive, fill_);
      hooks_.keep(k_fill, archive);
    }
    report_fill();
  }

  bool fetch_fill() {
    // A preparation that was stopped in its fill goes on with that.
    if (!hooks_.fetch || hooks_.resumed != nullptr) return false;
    std::optional<StateArchive> archive = hooks_.fetch(k_fill);
    if (!archive) return false;
    archive->exchange("gravel_order", out_.gravel_order);
    renumber_gravel(out_.grains, out_.gravel_order);
    exchange(*archive, fill_);
    report_fill();
    return true;
  }

  void report_fill() {
    out_.report.fill_steps = fill_.steps;
    out_.report.alignment_generated = fill_.alignment;
    out_.report.fill_overlap = fill_.largest_overlap;
    out_.report.caught = fill_.caught;
  }

  static void exchange_fill(StateArchive& archive, FillState& state, Simulation& s) {
    archive.group("fill", [&] {
      exchange(archive, state);
      archive.group("simulation", [&] { exchange(archive, s); });
    });
  }

  // ---- branches of the search

  void begin_branch(double friction) {
    stage_ = k_branch;
    build(friction);
    if (!fetch_branch()) begin_station(0);
    watch(true);
  }

  void finish_branch() {
    SpecimenReport& r = out_.report;
    r.branches.push_back({r.preparation_friction, out_.load.stress, rest_.void_ratio, station_steps_});
    r.branch_steps += station_steps_;
    const std::optional<double> next = next_friction(r.branches, target_);
    if (hooks_.note) hooks_.note(branch_note(r, is_fetched_));
    if (next) {
      begin_branch(*next);
    } else {
      stage_ = k_compression;
      begin_station(0);
      watch(true);
    }
  }

  [[nodiscard]] std::string state_name(std::size_t station) const {
    return branch_state_name(out_.report.preparation_friction, stations(), station);
  }

  /// The branch at rest under the largest stress for which it was kept.
  bool fetch_branch() {
    if (!hooks_.fetch) return false;
    for (std::size_t station = stations().size(); station-- > 0;) {
      std::optional<StateArchive> archive = hooks_.fetch(state_name(station));
      if (!archive) continue;
      exchange_branch(*archive);
      aim_at(stations()[station_]);
      is_fetched_ = true;
      return true;
    }
    return false;
  }

  void exchange_branch(StateArchive& archive) {
    archive.exchange("station", station_);
    archive.exchange("station_steps", station_steps_);
    archive.exchange("time_step_limit", out_.report.time_step.seconds);
    archive.exchange("time_step_limited_by", out_.report.time_step.limited_by);
    archive.group("rest", [&] { exchange(archive, rest_); });
    archive.group("simulation", [&] { exchange(archive, *out_.simulation); });
  }

  // ---- stresses on the way

  /// Stresses at which the present stage comes to rest, Pa. A branch that was chosen has been at the smaller ones.
  [[nodiscard]] std::vector<double> stations() const {
    if (stage_ == k_branch) return rest_stresses(order_, order_.specimen.branch_stress_ratio);
    return order_.specimen.preparation_friction ? rest_stresses(order_, 1.0) : std::vector{order_.normal_stress};
  }

  /// In a branch only the void ratio counts, so the plate may go as fast as inertia does not matter.
  void aim_at(double stress) {
    const SpecimenSettings& specimen = order_.specimen;
    out_.load.stress = stress;
    out_.load.speed_cap = specimen.approach_speed;
    out_.load.speed_of_stress =
        stage_ == k_branch ? plate_speed_at(specimen.approach_inertial_number, layer_, 1.0) : 0.0;
  }

  void begin_station(std::size_t station) {
    station_ = station;
    if (station == 0) station_steps_ = 0;
    rest_ = {};
    is_fetched_ = false;
    Simulation& s = *out_.simulation;
    aim_at(stations()[station]);
    out_.report.time_step = choose_time_step(s, out_.load.stress);
    if (s.steps == 0) {
      s.set_time_step(out_.report.time_step.seconds);
    } else {
      s.change_time_step(out_.report.time_step.seconds);
    }
  }

  void run_stations() {
    const std::size_t n = stations().size();
    for (;;) {
      const bool is_strict = stage_ == k_compression && station_ + 1 == n;
      rest(is_strict ? order_.equilibrium : branch_equilibrium());
      if (stage_ == k_branch && !is_fetched_ && hooks_.keep) {
        StateArchive archive;
        exchange_branch(archive);
        hooks_.keep(state_name(station_), archive);
      }
      station_steps_ += rest_.steps;
      if (station_ + 1 == n) return;
      begin_station(station_ + 1);
    }
  }

  [[nodiscard]] EquilibriumSettings branch_equilibrium() const {
    EquilibriumSettings e = order_.equilibrium;
    e.force_ratio = std::max(e.force_ratio, e.branch_force_ratio);
    e.plate_speed = std::max(e.plate_speed, plate_speed_at(e.branch_inertial_number, layer_, out_.load.stress));
    e.hold_steps = std::min(e.hold_steps, e.branch_hold_steps);
    return e;
  }

  // ---- compression and final friction

  void begin_compression_of_fill(double friction) {
    stage_ = k_compression;
    build(friction);
    begin_station(0);
    watch(true);
  }

  void build(double friction) {
    out_.report.preparation_friction = friction;
    out_.simulation = std::make_unique<Simulation>(scene_of(order_, out_.grains, fill_));
    set_plate_friction(order_.specimen.preparation_plate_friction);
    out_.simulation->set_friction(preparation_friction(friction));
  }

  void set_plate_friction(double friction) { ShearBox::set_plate_friction(out_.simulation->walls, friction); }

  void begin_final_friction() {
    out_.report.void_ratio_prepared = rest_.void_ratio;
    out_.report.compression_steps = station_steps_;
    stage_ = k_final_friction;
    station_steps_ = 0;
    rest_ = {};
    set_plate_friction(order_.materials.walls.friction);
    Simulation& s = *out_.simulation;
    if (order_.box.split_plane == SplitPlane::specimen) part_at_half_of_specimen();
    s.set_friction(s.material_friction());
    watch(true);
  }

  void part_at_half_of_specimen() {
    Simulation& s = *out_.simulation;
    ShearBox::part_at(s.walls, order_.box, 0.5 * s.walls[ShearBox::k_top_plate].corner.z);
    s.near.is_valid = false;  // found for other walls
    s.invalidate_candidates();
  }

  void finish() {
    const Simulation& s = *out_.simulation;
    out_.report.split_height = ShearBox::split_height(s.walls);
    out_.report.void_ratio_before_shear = rest_.void_ratio;
    out_.report.friction_steps = rest_.steps;
    out_.report.height = s.walls[ShearBox::k_top_plate].corner.z;
    out_.report.alignment_before_shear = rubber_alignment(s);
  }

  void rest(const EquilibriumSettings& equilibrium) {
    Simulation& s = *out_.simulation;
    bring_to_rest(s, out_.load, equilibrium, rest_, [&] {
      static_assert(k_review_interval % k_rest_interval == 0 && k_review_interval_with_rubber % k_rest_interval == 0);
      review_time_step(s, out_.report.time_step.seconds);
      if (rest_.steps % (5 * k_rest_interval) == 0 || !has_only_numbers(s)) {
        const Trouble trouble = find_trouble(s, ShearBox::rooms_of(s.walls), k_overlap_limit);
        if (trouble.kind != TroubleKind::none) {
          throw PhysicsError(fmt::format("{} (stage {}, step {}){}", trouble.text, label(), rest_.steps,
                                         advice_for(trouble, order_.box, s.walls)));
        }
      }
      watch(false);
    });
  }

  // ---- what the outside sees

  [[nodiscard]] std::string label() const {
    return stage_ == k_branch ? branch_label(out_.report.branches.size(), out_.report.preparation_friction) : stage_;
  }

  /// Estimate of the steps until shear.
  [[nodiscard]] double steps_left() const {
    const Simulation& s = *out_.simulation;
    const SpecimenSettings& specimen = order_.specimen;
    const double final_rest = order_.equilibrium.hold_steps + 1000.0;
    if (stage_ == k_final_friction) return std::max(0.0, final_rest - static_cast<double>(rest_.steps));
    const double e = specimen.expected_void_ratio.value_or(expected_void_ratio(specimen.rubber_content));
    const auto way = [&](double height) {
      const double goal = out_.load.solid_volume * (1.0 + e) / out_.load.area;
      return std::max(0.0, height - goal) / (speed_cap_at(out_.load, 0.5 * out_.load.stress) * s.time_step());
    };
    const double stations_left = static_cast<double>(stations().size() - station_);
    double left = way(s.walls[ShearBox::k_top_plate].corner.z) + k_usual_rest * stations_left;
    left = std::max(left - 0.5 * static_cast<double>(rest_.steps), 0.1 * left) + final_rest;
    if (stage_ == k_compression) return left;
    const SpecimenReport& r = out_.report;
    const double rested = static_cast<double>(r.branches.size());
    const double each = r.branches.empty() ? way(fill_.height) + k_usual_rest * static_cast<double>(stations().size())
                                           : static_cast<double>(r.branch_steps) / rested;
    return left + each * std::max(0.0, k_usual_branches - 1.0 - rested) + k_usual_rest;
  }

  void watch(bool is_new_stage) {
    if (!hooks_.watch) return;
    PreparationState now{label(), -1.0, rest_, out_.simulation->time_step(), steps_left(), is_new_stage};
    now.rest.steps += station_steps_;
    hooks_.watch(now, [&](StateArchive& archive) { save(archive); });
  }

  // ---- saving

  void save(StateArchive& archive) {
    archive.exchange("stage", stage_);
    exchange(archive, out_);
    exchange_place(archive);
  }

  void exchange_place(StateArchive& archive) {
    archive.exchange("station", station_);
    archive.exchange("station_steps", station_steps_);
    archive.group("rest", [&] { exchange(archive, rest_); });
    if (stage_ == k_branch) archive.group("fill", [&] { exchange(archive, fill_); });
  }

  /// A specimen of the right make, with every grain still at the origin, then its state.
  void load(StateArchive& archive) {
    archive.exchange("gravel_order", out_.gravel_order);
    renumber_gravel(out_.grains, out_.gravel_order);
    out_.simulation = std::make_unique<Simulation>(scene_of(order_, out_.grains, fill_of_nowhere(order_, out_.grains)));
    exchange(archive, out_);
    if (!archive.has_group("rest")) return;  // in shear
    exchange_place(archive);
    // Under another stress than before there may be fewer stations.
    if (stage_ == k_compression) station_ = std::min(station_, stations().size() - 1);
    aim_at(stage_ == k_final_friction ? order_.normal_stress : stations().at(station_));
  }

  const SpecimenOrder& order_;
  const PreparationHooks& hooks_;
  DensityTarget target_;
  Layer layer_;  ///< the fill
  Specimen out_;
  std::string stage_ = k_fill;
  Fill fill_;                       ///< grains in the order of their final numbers
  std::size_t station_ = 0;         ///< number of the present one in stations()
  std::int64_t station_steps_ = 0;  ///< of the stations before it in this stage or branch
  RestState rest_;                  ///< at the present station
  bool is_fetched_ = false;         ///< the state at this station was kept by an earlier preparation
};

}  // namespace

Specimen prepare_specimen(const SpecimenOrder& order, const PreparationHooks& hooks) {
  return Preparation(order, hooks).run();
}

Specimen load_specimen(const SpecimenOrder& order, StateArchive& state) {
  PreparationHooks hooks;
  hooks.resumed = &state;
  return Preparation(order, hooks).load_only();
}

}  // namespace dem
