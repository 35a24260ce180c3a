// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/lab/direct_shear.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string>

#include "dem4grm/core/error.hpp"
#include "dem4grm/lab/shear_stage.hpp"
#include "dem4grm/lab/shear_velocity.hpp"
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
  out.shear_velocity = shear_velocity(test.shear, specimen.report);
  double difference = 0.0;
  const std::span<const ShearRow> rows = std::span<const ShearRow>(out.rows).subspan(out.rows_before);
  for (const ShearRow& r : rows) {
    out.normal_stress_mean += r.normal_stress;
    out.normal_stress_max_error = std::max(out.normal_stress_max_error, std::fabs(r.normal_stress / target - 1.0));
    out.normal_stress_worst_step =
        std::max(out.normal_stress_worst_step, std::fabs(r.normal_stress_worst / target - 1.0));
    out.inertial_number_max = std::max(out.inertial_number_max, r.inertial_number);
    out.unbalanced_ratio_mean += r.unbalanced_ratio;
    difference += std::fabs(r.half_force_difference);
  }
  const double n = std::max(1.0, static_cast<double>(rows.size()));
  out.normal_stress_mean /= n;
  out.unbalanced_ratio_mean /= n;
  if (out.curve.peak_stress > 0.0) out.half_force_imbalance_mean = difference / n / out.curve.peak_stress;
  out.balls = s.balls.n_balls();
  out.clumps = static_cast<int>(s.clumps.clumps.size());
  out.rubber_grains = s.balls.n_grains;
  out.bonds = s.balls.n_grains * k_grain_bonds;
  out.broken_bonds = count_broken_bonds(s);
  out.lost_grains = count_lost_bodies(s, ShearBox::rooms_of(s.walls));
  out.steps = s.steps + specimen.report.fill_steps + specimen.report.other_branch_steps();
  out.time_step = s.dt;
  out.state_hash = s.state_hash();
}

/// The finished specimen.
BeforeShear examine(const DirectShearCase& test, const Specimen& specimen) {
  const Simulation& s = *specimen.simulation;
  const Bounds room{{}, {test.box.length, test.box.width, s.walls[ShearBox::k_top_plate].corner.z}};
  return {measure_homogeneity(packing_of(s), normals_of(contact_network_of(s).contacts), room,
                              specimen.report.mean_size, test.rubber.density / test.rubber_solid_density),
          measure_lateral_stress(s, test.box)};
}

void warn_of_caught(const BeforeShear& before, LabObserver& observer) {
  const int caught = before.homogeneity.overlap.caught;
  if (caught == 0) return;
  observer.warning(
      fmt::format("{} ball centres lie inside other grains of the finished specimen; choose another seed", caught));
}

// A row of published gravel was 3.3 % off where a force chain broke; beyond these the plate did not follow.
constexpr double k_mean_stress_error = 0.01, k_row_stress_error = 0.10;
constexpr double k_too_fast = 1e-3;  // inertial number

/// What of the test was not as it was meant to be.
void warn_of_quality(const DirectShearCase& test, const DirectShearResult& r, LabObserver& observer) {
  const double target = test.shear.normal_stress, off = r.normal_stress_mean / target - 1.0;
  if (r.rows.size() > r.rows_before &&
      (std::fabs(off) > k_mean_stress_error || r.normal_stress_max_error > k_row_stress_error)) {
    observer.warning(
        fmt::format("the plate did not hold its stress: {:.2f} kPa in the mean where {:g} kPa were asked for, and "
                    "{:.1f} % off in the "
                    "worst row; a slower shear.velocity or a larger servo.gain may help",
                    r.normal_stress_mean / 1e3, target / 1e3, 100.0 * r.normal_stress_max_error));
  }
  if (r.inertial_number_max > k_too_fast) {
    observer.warning(
        fmt::format("the inertial number reached {:.1e}: above {:g} a test is not quasi-static; take a slower "
                    "shear.velocity, or \"quasi-static\"",
                    r.inertial_number_max, k_too_fast));
  }
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
  BeforeShear before;
  if (!is_in_shear) {
    before = examine(test, specimen);
    warn_of_caught(before, observer);
  }
  ShearStage stage(test, specimen, before, observer);
  stage.run(is_in_shear ? from : nullptr);
  if (is_in_shear) warn_of_caught(before, observer);  // known again only now

  DirectShearResult out;
  out.specimen = specimen.report;
  out.before = before;
  out.rows = stage.rows();
  out.micro_rows = stage.micro_rows();
  out.displacement = out.rows.empty() ? 0.0 : out.rows.back().displacement;
  out.rows_before = static_cast<std::size_t>(stage.turn().course_rows);
  out.displacement_before = stage.turn().course_begin;
  out.curve = read_shear_curve(std::span<const ShearRow>(out.rows).subspan(out.rows_before), out.displacement_before);
  summarise(test, specimen, out);
  warn_of_quality(test, out, observer);
  return out;
}

}  // namespace dem
