// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/lab/direct_shear.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "dem4grm/core/error.hpp"
#include "dem4grm/engine/simulation_state.hpp"
#include "dem4grm/engine/time_step.hpp"
#include "dem4grm/lab/record_state.hpp"
#include "dem4grm/walls/shear_box.hpp"

namespace dem {

Scene materials_of(const DirectShearCase& test) {
  Scene scene;
  scene.gravel = test.gravel;
  scene.rubber = test.rubber;
  scene.walls = test.walls;
  scene.bond = test.bond;
  scene.contact = test.contact;
  scene.integration = test.integration;
  return scene;
}

SpecimenOrder specimen_order(const DirectShearCase& test) {
  return {test.specimen,
          test.box,
          test.servo,
          test.equilibrium,
          materials_of(test),
          test.rubber_solid_density,
          test.shear.normal_stress,
          test.seed};
}

namespace {

/// The start, every `every`, the end, and `more`; ascending, each once.
std::vector<double> marks(const DirectShearCase& test, double every, std::vector<double> more) {
  const double end = test.shear.displacement;
  for (int k = 0; k * every < end; ++k) more.push_back(k * every);
  more.push_back(end);
  std::sort(more.begin(), more.end());
  const double near = 0.5 * test.recording.interval;
  more.erase(std::unique(more.begin(), more.end(), [&](double a, double b) { return b - a < near; }), more.end());
  std::erase_if(more, [&](double d) { return d > end + near; });
  return more;
}

}  // namespace

std::vector<double> state_displacements(const DirectShearCase& test) {
  return marks(test, test.recording.frame_interval, test.recording.extra_frames);
}

std::vector<double> micro_displacements(const DirectShearCase& test) {
  return marks(test, test.recording.micro_interval, {});
}

namespace {

constexpr int k_watch_interval = 500;  // steps between two looks of the watchdog
/// The halves reach their velocity over this displacement, so that the start is no blow.
constexpr double k_start_ramp = 2e-5;  // m
/// The time step may grow to so many times that of the preparation, however soft the specimen becomes.
constexpr double k_longest_over_prepared = 2.0;

/// Sums over one interval of the record.
struct IntervalSums {
  double lower = 0.0, upper = 0.0, normal = 0.0, bottom_plate = 0.0, worst_normal = 0.0;
  int steps = 0;
};

class ShearStage {
 public:
  ShearStage(const DirectShearCase& test, Specimen& specimen, Homogeneity& homogeneity, LabObserver& observer)
      : test_(test),
        specimen_(specimen),
        s_(*specimen.simulation),
        homogeneity_(homogeneity),
        observer_(observer),
        frames_(state_displacements(test)),
        micro_(micro_displacements(test)) {
    s_.servo.speed_cap = std::max(test.servo.shear_speed_cap, test.shear.velocity);
    start_height_ = plate_height();
    start_energy_ = s_.energy();
  }

  /// From the beginning when `from` is null, else from the state in it.
  void run(StateArchive* from) {
    if (from == nullptr) {
      write_frame();
      tell_specimen();
      record_micro();
      keep(true);
    } else {
      from->group("shear", [&] { exchange_all(*from); });
      observer_.resumed({rows_, written_frames_, micro_rows_, start_energy_});
    }
    if (!observer_.wants_shear()) return;
    while (displacement_ < test_.shear.displacement * (1.0 - 1e-12)) {
      advance();
      const bool is_watched = ++shear_steps_ % k_watch_interval == 0;
      if (is_watched) watch();
      if (displacement_ >= next_row_at() * (1.0 - 1e-12)) {
        finish_row();
        if (has_reached(frames_, next_frame_)) write_frame();
        if (has_reached(micro_, micro_rows_.size())) record_micro();
      }
      if (is_watched) keep(false);
    }
  }

  [[nodiscard]] const std::vector<ShearRow>& rows() const { return rows_; }
  [[nodiscard]] const std::vector<MicroRow>& micro_rows() const { return micro_rows_; }

 private:
  [[nodiscard]] double plate_height() const { return s_.walls[ShearBox::k_top_plate].corner.z; }
  [[nodiscard]] double next_row_at() const {
    return std::min(static_cast<double>(rows_.size() + 1) * test_.recording.interval, test_.shear.displacement);
  }

  /// True when the mark of that number is there and near.
  [[nodiscard]] bool has_reached(const std::vector<double>& at, std::size_t number) const {
    return number < at.size() && displacement_ >= at[number] - 0.5 * test_.recording.interval;
  }

  void advance() {
    const double v = test_.shear.velocity;
    const double ramp = std::min(1.0, std::max(0.02, std::sqrt(displacement_ / k_start_ramp)));
    ShearBox::set_velocities(s_.walls, test_.shear.moving_half, v * ramp, s_.walls[ShearBox::k_top_plate].velocity.z);
    s_.step();
    displacement_ += v * ramp * s_.dt;
    review_time_step(s_, k_longest_over_prepared * specimen_.report.time_step.seconds);
    for (int w = 0; w < ShearBox::k_walls; ++w) {
      const double fx = s_.reactions[static_cast<std::size_t>(w)].force.x;
      (ShearBox::half_of(w) == BoxHalf::lower ? sums_.lower : sums_.upper) += fx;
    }
    sums_.bottom_plate += s_.reactions[ShearBox::k_bottom_plate].force.x;
    const double normal = plate_stress(s_, specimen_.load), target = test_.shear.normal_stress;
    sums_.normal += normal;
    if (sums_.steps == 0 || std::fabs(normal - target) > std::fabs(sums_.worst_normal - target)) {
      sums_.worst_normal = normal;
    }
    ++sums_.steps;
  }

  void finish_row() {
    const double area = specimen_.load.area, n = sums_.steps;
    ShearRow row;
    row.displacement = displacement_;
    // The lower half moves to +x against the grains, which push it back: its shear stress is minus their force.
    row.shear_stress = -sums_.lower / n / area;
    row.shear_stress_corrected = row.shear_stress * test_.box.length / (test_.box.length - displacement_);
    row.half_force_difference = -(sums_.lower + sums_.upper) / n / area;
    row.plate_shear_stress = -sums_.bottom_plate / n / area;
    row.normal_stress = sums_.normal / n;
    row.normal_stress_worst = sums_.worst_normal;
    row.vertical_displacement = plate_height() - start_height_;
    row.void_ratio = plate_void_ratio(s_, specimen_.load);
    // Inertial number of Chew et al. (2022): rate D sqrt(rho / sigma_n), rate = shear velocity / initial height.
    row.inertial_number = test_.shear.velocity / start_height_ * specimen_.report.mean_size *
                          std::sqrt(specimen_.report.mean_density / row.normal_stress);
    row.unbalanced_ratio = balance(s_).ratio();
    row.time_step = s_.dt;
    row.energy = since_start(s_.energy());
    rows_.push_back(row);
    sums_ = {};
    observer_.shear_row(row);
    report();
  }

  [[nodiscard]] EnergyReport since_start(EnergyReport e) const {
    e.boundary_work -= start_energy_.boundary_work;
    e.slip -= start_energy_.slip;
    e.dashpot -= start_energy_.dashpot;
    e.local_damping -= start_energy_.local_damping;
    return e;
  }

  void report() {
    const ShearRow& r = rows_.back();
    Progress p;
    p.stage = "shear";
    p.fraction = displacement_ / test_.shear.displacement;
    p.displacement = displacement_;
    p.shear_stress = r.shear_stress;
    p.normal_stress = r.normal_stress;
    p.void_ratio = r.void_ratio;
    p.inertial_number = r.inertial_number;
    p.unbalanced_ratio = r.unbalanced_ratio;
    p.steps = shear_steps_;
    p.time_step = s_.dt;
    observer_.progress(p);
  }

  void watch() {
    const std::string trouble = find_trouble(s_, specimen_.bounds, k_overlap_limit);
    if (trouble.empty()) {
      if (!rows_.empty()) report();
      return;
    }
    throw PhysicsError(
        fmt::format("{} (stage shear, {:.3f} mm). Try a smaller integration.time_step_safety or a slower "
                    "shear.velocity",
                    trouble, displacement_ * 1e3));
  }

  void write_frame() {
    written_frames_.push_back({static_cast<int>(next_frame_), displacement_, s_.state_hash()});
    observer_.frame(s_, written_frames_.back());
    ++next_frame_;
  }

  void record_micro() {
    micro_rows_.push_back({displacement_, analyse(micro_state_of(s_), {}).numbers});
    observer_.micro_row(micro_rows_.back());
  }

  StateArchive specimen_state() {
    StateArchive archive;
    std::string stage = "shear";
    archive.exchange("stage", stage);
    exchange(archive, specimen_);
    return archive;
  }

  void tell_specimen() { observer_.specimen_ready(specimen_state(), specimen_.report); }

  void keep(bool is_new_stage) {
    if (!observer_.wants_checkpoint(is_new_stage)) return;
    StateArchive archive = specimen_state();
    archive.group("shear", [&] { exchange_all(archive); });
    observer_.checkpoint(archive);
  }

  void exchange_all(StateArchive& archive) {
    archive.exchange("displacement", displacement_);
    archive.exchange("start_height", start_height_);
    archive.group("start_energy", [&] { exchange(archive, start_energy_); });
    archive.exchange("steps", shear_steps_);
    archive.group("homogeneity", [&] { exchange(archive, homogeneity_); });
    archive.group("sums", [&] {
      archive.exchange("lower", sums_.lower);
      archive.exchange("upper", sums_.upper);
      archive.exchange("normal", sums_.normal);
      archive.exchange("bottom_plate", sums_.bottom_plate);
      archive.exchange("worst_normal", sums_.worst_normal);
      archive.exchange("steps", sums_.steps);
    });
    exchange(archive, written_frames_);
    next_frame_ = written_frames_.size();
    exchange(archive, rows_);
    exchange(archive, micro_rows_);
  }

  const DirectShearCase& test_;
  Specimen& specimen_;
  Simulation& s_;
  Homogeneity& homogeneity_;
  LabObserver& observer_;
  std::vector<double> frames_, micro_;  ///< m, where states and micro-mechanics are recorded
  double displacement_ = 0.0, start_height_ = 0.0;
  EnergyReport start_energy_;
  std::size_t next_frame_ = 0;
  std::vector<FrameInfo> written_frames_;
  std::int64_t shear_steps_ = 0;
  IntervalSums sums_;
  std::vector<ShearRow> rows_;
  std::vector<MicroRow> micro_rows_;
};

int count_broken_bonds(const Simulation& s) {
  int broken = 0;
  if (s.scene.bond.form != BondForm::incremental) return broken;
  for (int g = 0; g < s.balls.n_grains; ++g) {
    for (int k = 0; k < k_grain_bonds; ++k) broken += read_bond(s, g, k).is_broken ? 1 : 0;
  }
  return broken;
}

void summarise(const DirectShearCase& test, const Specimen& specimen, DirectShearResult& out) {
  const Simulation& s = *specimen.simulation;
  const double target = test.shear.normal_stress;
  double difference = 0.0;
  for (const ShearRow& r : out.rows) {
    out.normal_stress_mean += r.normal_stress;
    out.normal_stress_max_error = std::max(out.normal_stress_max_error, std::fabs(r.normal_stress / target - 1.0));
    out.normal_stress_worst_step =
        std::max(out.normal_stress_worst_step, std::fabs(r.normal_stress_worst / target - 1.0));
    out.inertial_number_max = std::max(out.inertial_number_max, r.inertial_number);
    out.unbalanced_ratio_mean += r.unbalanced_ratio;
    difference += std::fabs(r.half_force_difference);
  }
  const double n = std::max(1.0, static_cast<double>(out.rows.size()));
  out.normal_stress_mean /= n;
  out.unbalanced_ratio_mean /= n;
  if (out.curve.peak_stress > 0.0) out.half_force_imbalance_mean = difference / n / out.curve.peak_stress;
  out.balls = s.balls.n_balls();
  out.clumps = static_cast<int>(s.clumps.clumps.size());
  out.rubber_grains = s.balls.n_grains;
  out.bonds = s.balls.n_grains * k_grain_bonds;
  out.broken_bonds = count_broken_bonds(s);
  out.lost_grains = count_lost_bodies(s, specimen.bounds);
  out.steps = s.steps + specimen.report.fill_steps + specimen.report.other_branch_steps();
  out.time_step = s.dt;
  out.state_hash = s.state_hash();
}

/// How even the finished specimen is; warns when a grain is caught in another.
Homogeneity examine(const DirectShearCase& test, const Specimen& specimen, LabObserver& observer) {
  const Simulation& s = *specimen.simulation;
  const Bounds room{{}, {test.box.length, test.box.width, s.walls[ShearBox::k_top_plate].corner.z}};
  const Homogeneity found = measure_homogeneity(packing_of(s), contact_normals(s), room, specimen.report.mean_size,
                                                test.rubber.density / test.rubber_solid_density);
  if (found.overlap.caught > 0) {
    observer.warning(fmt::format(
        "{} ball centres lie inside other grains of the finished specimen; choose another seed", found.overlap.caught));
  }
  return found;
}

PreparationHooks hooks_of(LabObserver& observer, StateArchive* from) {
  PreparationHooks hooks;
  hooks.resumed = from;
  hooks.watch = [&observer](const PreparationState& state, const std::function<void(StateArchive&)>& save) {
    Progress p;
    p.stage = state.stage;
    p.fraction = state.fraction;
    p.normal_stress = state.rest.stress;
    p.void_ratio = state.rest.void_ratio;
    p.unbalanced_ratio = state.rest.unbalanced_ratio;
    p.steps = state.rest.steps;
    p.time_step = state.time_step;
    p.steps_to_last_stage = state.steps_left;
    if (!state.is_new_stage) observer.progress(p);  // a stage that has not begun has nothing to tell
    if (!observer.wants_checkpoint(state.is_new_stage)) return;
    StateArchive archive;
    save(archive);
    observer.checkpoint(archive);
  };
  hooks.fetch = [&observer](const std::string& name) { return observer.fetch_preparation(name); };
  hooks.keep = [&observer](const std::string& name, const StateArchive& state) {
    observer.keep_preparation(name, state);
  };
  hooks.note = [&observer](const std::string& text) { observer.note(text); };
  return hooks;
}

}  // namespace

DirectShearResult run_direct_shear(const DirectShearCase& test, LabObserver& observer, StateArchive* from) {
  const bool is_in_shear = from != nullptr && from->has_group("shear");
  Specimen specimen = prepare_specimen(specimen_order(test), hooks_of(observer, from));
  const double miss = specimen.report.height / test.box.height - 1.0;
  if (std::fabs(miss) > 0.05) {
    observer.warning(fmt::format(
        "the specimen is {:.1f} mm high, {:+.1f} % off the nominal {:.1f} mm; set "
        "specimen.expected_void_ratio to {:.3f} for the right number of grains",
        specimen.report.height * 1e3, miss * 100.0, test.box.height * 1e3, specimen.report.void_ratio_before_shear));
  }
  Homogeneity homogeneity;
  if (!is_in_shear) homogeneity = examine(test, specimen, observer);
  ShearStage stage(test, specimen, homogeneity, observer);
  stage.run(is_in_shear ? from : nullptr);

  DirectShearResult out;
  out.specimen = specimen.report;
  out.homogeneity = homogeneity;
  out.rows = stage.rows();
  out.micro_rows = stage.micro_rows();
  out.displacement = out.rows.empty() ? 0.0 : out.rows.back().displacement;
  out.curve = read_shear_curve(out.rows);
  summarise(test, specimen, out);
  return out;
}

}  // namespace dem
