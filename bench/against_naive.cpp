// SPDX-License-Identifier: BSD-3-Clause
// How much the layout, the lanes and the ordered sums are worth: the engine's step and a naive one (naive_step.hpp) on
// the same rubber specimen, in turn.
//
//   bench_against_naive FOLDER|CASE [threads] [steps]
//
// Prints one CSV row for each with the fastest and the median step in microseconds, then the ratio of the medians. The
// walls are evaluated once for both and not timed; after the steps the two states must agree, or the program fails.
#include "naive_step.hpp"
#include "support.hpp"

namespace {

/// Both add the same numbers in another order.
constexpr double k_largest_distance = 1e-12;  // m

int measure(const std::string& source, int steps) {
  bench::Loaded loaded = bench::specimen_of(source);
  dem::Simulation& s = *loaded.specimen.simulation;
  s.margins.tunes = false;
  s.rebuild_candidates();
  bench::NaiveStep naive(s);
  bench::Times engine_times, naive_times;
  for (int k = 0; k < steps; ++k) {
    bench::drive_walls(loaded.test, s);
    dem::evaluate_wall_contacts(s);
    naive_times.add(bench::time_of([&] { naive.run(s); }));
    engine_times.add(bench::time_of([&] {
      dem::evaluate_early_contacts(s);
      dem::advance_rubber_grains(s);
    }));
    dem::move_walls(s);
    if (s.margins.is_used_up) break;  // both use the list that they began with
  }
  const std::string common = bench::common_row(loaded.test.name, s);
  fmt::print("{},variant,fastest_us,median_us,steps\n", bench::common_columns());
  fmt::print("{},naive,{:.1f},{:.1f},{}\n", common, naive_times.fastest(), naive_times.median(),
             naive_times.microseconds.size());
  fmt::print("{},engine,{:.1f},{:.1f},{}\n", common, engine_times.fastest(), engine_times.median(),
             engine_times.microseconds.size());
  const double distance = naive.distance_to(s);
  fmt::print("ratio of medians {:.2f}, of fastest {:.2f}; states differ by {:.2g} m\n",
             naive_times.median() / engine_times.median(), naive_times.fastest() / engine_times.fastest(), distance);
  return distance < k_largest_distance ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  return bench::run_benchmark(argc, "bench_against_naive FOLDER|CASE [threads] [steps]", [&] {
    omp_set_num_threads(bench::argument(argc, argv, 2, omp_get_num_procs()));
    return measure(argv[1], bench::argument(argc, argv, 3, 100));
  });
}
