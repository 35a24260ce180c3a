// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/runs/run_forecast.hpp"

#include <omp.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <variant>

#include "dem4grm/engine/observe.hpp"
#include "dem4grm/lab/dense_assembly.hpp"
#include "dem4grm/lab/direct_shear.hpp"
#include "dem4grm/lab/grain_compression.hpp"
#include "dem4grm/specimen/branch_words.hpp"
#include "dem4grm/specimen/draw_grains.hpp"
#include "dem4grm/specimen/rest.hpp"

namespace dem {
namespace {

using Clock = std::chrono::steady_clock;

// Of a real specimen against the stand-in, median of a step, measured at full size and 100 kPa: gravel 0.9 to 1.0,
// rubber 1.25 (second neighbours close, walls are nearer).
constexpr double k_step_of_gravel = 0.95, k_step_of_rubber = 1.25;
// Of the time step in shear against that of the preparation, gravel at 100 kPa (decision 13); rubber keeps its own.
constexpr double k_growth_of_time_step = 1.28;
// Fill in units of a step under load: 6,600 for gravel, 9,000 with VRC 25, 19,000 for rubber alone; and steps to come to
// rest twice.
// A search takes e_min, e_max and two trials or three. Each rests after its way; without friction it creeps, the longer the
// more grains there are: 17,000 to 22,000 steps with 600 grains, 130,000 with 4,488.
constexpr double k_usual_branches = 4.5, k_branch_rest = 4000.0, k_smooth_rest_per_grain = 29.0;
constexpr double k_fill_of_gravel = 7000.0, k_fill_of_rubber = 19000.0, k_rest_steps = 18000.0;
// Compressed bytes in a full state, measured on states of gravel, rubber and a mixture.
constexpr double k_bytes_per_ball = 46.0, k_bytes_per_bond = 27.0, k_bytes_per_clump = 106.0,
                 k_bytes_per_contact = 71.0;
// The tables with their copies in results.h5, where every column is a dataset with a head of its own: shear.csv and walls.csv
// by row, micro.csv by row, profiles.csv by state.
constexpr double k_bytes_of_tables = 450e3, k_bytes_per_row = 1090.0, k_bytes_per_micro_row = 3.9e3,
                 k_bytes_of_profile = 3.2e3;
constexpr double k_checkpoint_bytes_per_ball = 2.0 * 200.0;  // two of them

/// Mean time of a step over so many seconds, on so many threads; s.
double time_of_step(Simulation& s, double seconds, int threads) {
  const int before = omp_get_max_threads();
  omp_set_num_threads(threads);
  for (int k = 0; k < 3; ++k) s.step();
  const auto start = Clock::now();
  std::chrono::duration<double> spent{};
  int steps = 0;
  do {
    s.step();
    ++steps;
    spent = Clock::now() - start;
  } while (spent.count() < seconds);
  omp_set_num_threads(before);
  return spent.count() / steps;
}

/// The better of one thread and the most.
void try_threads(Simulation& s, int most_threads, StepTrial& out) {
  const int most = most_threads > 0 ? most_threads : omp_get_max_threads();
  out.threads = 1;
  out.step_time = time_of_step(s, most > 1 ? 0.5 * out.seconds : out.seconds, 1);
  if (most == 1) return;
  const double with_most = time_of_step(s, 0.5 * out.seconds, most);
  if (with_most < out.step_time || most_threads > 0) out.step_time = with_most, out.threads = most;
}

StepTrial trial_of(const DirectShearCase& test, double seconds, int most_threads) {
  const SpecimenOrder order = specimen_order(test);
  const GrainList grains =
      draw_grains(order.specimen, order.box, order.materials.rubber.density, order.solid_density, order.seed);
  const DenseAssembly assembly =
      make_dense_assembly(grains, order.materials, order.box.length, order.box.width, order.seed);
  Simulation s(assembly.scene);
  s.set_time_step(k_frozen_time_step);
  StepTrial out;
  out.seconds = seconds;
  try_threads(s, most_threads, out);
  const double rubber_share = static_cast<double>(s.balls.n_rubber_balls()) / s.balls.n_balls();
  out.step_time *= k_step_of_gravel + (k_step_of_rubber - k_step_of_gravel) * rubber_share;
  out.contacts = static_cast<double>(balance(s).active_contacts);
  out.solid_volume = grains.solid_volume();
  out.has_rubber = grains.rubber_count > 0;
  return out;
}

StepTrial trial_of(const GrainCompressionCase& test, double seconds, int /*most_threads*/) {
  Simulation s(lone_grain(test));
  s.set_time_step(k_frozen_time_step);
  StepTrial out;
  out.seconds = 0.1 * seconds;  // it takes microseconds, always the same
  out.step_time = time_of_step(s, out.seconds, 1);
  return out;
}

RunForecast forecast(const DirectShearCase& test, const CaseFacts& facts, const StepTrial& trial) {
  const SpecimenOrder order = specimen_order(test);
  RunForecast out;
  out.trial = trial.seconds;
  out.threads = trial.threads;
  out.step_time = trial.step_time;

  const bool grows = !trial.has_rubber && test.integration.time_step_rule == TimeStepRule::true_limit;
  const double growth = grows ? k_growth_of_time_step : 1.0;
  const double shear_steps = static_cast<double>(facts.steps) / growth;
  // The plate comes down from the height of the fill at its top speed for most of the way.
  const double layer = trial.solid_volume / (test.box.length * test.box.width);
  const double travel = layer * std::max(0.0, facts.generation_void_ratio - facts.expected_void_ratio);
  const double fill_steps = k_fill_of_gravel + (k_fill_of_rubber - k_fill_of_gravel) * facts.rubber_content;
  const double slow = test.specimen.approach_speed;
  const Layer fill{layer * (1.0 + facts.generation_void_ratio), facts.mean_size, facts.mean_density};
  // While the plate comes down the stress rises to that of the first rest.
  const double quick = plate_speed_at(test.specimen.approach_inertial_number, fill,
                                      0.3 * rest_stresses(order, test.specimen.branch_stress_ratio).front());
  const double way = travel / slow / facts.time_step, branch_way = travel / std::max(slow, quick) / facts.time_step;
  const bool has_search = !test.specimen.preparation_friction;
  const auto stops = std::count_if(test.specimen.load_steps.begin(), test.specimen.load_steps.end(),
                                   [&](double stress) { return stress < test.shear.normal_stress; });
  const double branch = branch_way + k_branch_rest * (1.0 + static_cast<double>(stops));
  const double search = k_usual_branches * branch + k_smooth_rest_per_grain * (facts.clumps + facts.rubber_grains);
  const double preparation_steps = fill_steps + (has_search ? search : way) + k_rest_steps;
  out.steps = std::llround(preparation_steps + shear_steps);
  out.preparation_time = preparation_steps * out.step_time;
  out.test_time = shear_steps * out.step_time;

  const double state = k_bytes_per_ball * facts.balls + k_bytes_per_bond * facts.bonds +
                       k_bytes_per_clump * facts.clumps + k_bytes_per_contact * trial.contacts;
  out.results_size = (state + k_bytes_of_profile) * static_cast<double>(state_displacements(test).size() + 1) +
                     k_bytes_per_row * facts.rows + k_bytes_of_tables +  // one more state: specimen.h5
                     k_bytes_per_micro_row * static_cast<double>(micro_displacements(test).size());
  out.checkpoint_size = k_checkpoint_bytes_per_ball * facts.balls;
  out.results_size += 2.0 * out.checkpoint_size;  // the complete states in specimen.h5 and end_state.h5
  if (has_search) out.store_size = k_usual_branches * (1.0 + static_cast<double>(stops)) * out.checkpoint_size;
  return out;
}

RunForecast forecast(const GrainCompressionCase& /*test*/, const CaseFacts& facts, const StepTrial& trial) {
  RunForecast out;
  out.threads = 1;
  out.trial = trial.seconds;
  out.step_time = trial.step_time;
  out.steps = facts.steps;
  out.test_time = static_cast<double>(out.steps) * out.step_time;
  return out;
}

}  // namespace

StepTrial try_steps(const TestCase& test, double seconds, int most_threads) {
  return std::visit([&](const auto& t) { return trial_of(t, seconds, most_threads); }, test);
}

RunForecast forecast_run(const TestCase& test, const CaseFacts& facts, const StepTrial& trial) {
  return std::visit([&](const auto& t) { return forecast(t, facts, trial); }, test);
}

RunForecast forecast_run(const TestCase& test, const CaseFacts& facts, double trial, int most_threads) {
  return forecast_run(test, facts, try_steps(test, trial, most_threads));
}

JsonObject forecast_as_json(const RunForecast& f) {
  return {{"forecast_threads", f.threads},
          {"forecast_steps", f.steps},
          {"forecast_step_ms", f.step_time * 1e3},
          {"forecast_preparation_s", f.preparation_time},
          {"forecast_test_s", f.test_time},
          {"forecast_time_s", f.time()},
          {"forecast_results_MB", f.results_size / 1e6},
          {"forecast_store_MB", f.store_size / 1e6},
          {"forecast_checkpoint_MB", f.checkpoint_size / 1e6}};
}

}  // namespace dem
