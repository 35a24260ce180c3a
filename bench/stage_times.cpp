// SPDX-License-Identifier: BSD-3-Clause
// Where does a time step go? Takes the specimen of an output folder, shears it a little and times every stage.
//
//   bench_stage_times FOLDER|CASE [threads] [steps]
//
// FOLDER is that of a `dem4grm run` stopped in any stage after the fill; of a case file, the grains are taken as a dense
// assembly that does not move (lab/dense_assembly.hpp). Prints one CSV row per stage and one for the whole step:
// fastest, median and mean time in microseconds over all steps; then the time of one new list of candidates, picked
// from the near pairs, and of one with a search.
#include <vector>

#include "support.hpp"

namespace {

struct Stage {
  const char* name;
  void (*run)(dem::Simulation&);
  bench::Times times;
};

void print_row(const std::string& common, const char* name, const bench::Times& t, const std::string& hash) {
  fmt::print("{},{},{:.2f},{:.2f},{:.2f},{}\n", common, name, t.fastest(), t.median(), t.mean(), hash);
}

void measure(const std::string& source, int steps) {
  bench::Loaded loaded = bench::specimen_of(source);
  dem::Simulation& s = *loaded.specimen.simulation;
  std::vector<Stage> stages{{"candidates", dem::refresh_candidates, {}},
                            {"early ball contacts", dem::evaluate_early_contacts, {}},
                            {"wall contacts", dem::evaluate_wall_contacts, {}},
                            {"rubber grains", dem::advance_rubber_grains, {}},
                            {"clumps", dem::advance_clumps, {}},
                            {"walls", dem::move_walls, {}}};
  bench::Times whole;
  for (int k = 0; k < steps; ++k) {
    bench::drive_walls(loaded.test, s);
    double sum = 0.0;
    for (Stage& stage : stages) {
      const double t = bench::time_of([&] { stage.run(s); });
      stage.times.add(t);
      sum += t;
    }
    whole.add(sum);
    s.time += s.dt;
    ++s.steps;
  }
  const std::string common = bench::common_row(loaded.test.name, s), hash = s.state_hash();
  fmt::print("{},stage,fastest_us,median_us,mean_us,state_hash\n", bench::common_columns());
  for (const Stage& stage : stages) print_row(common, stage.name, stage.times, hash);
  print_row(common, "step", whole, hash);
  bench::Times list, search;
  for (int k = 0; k < 10; ++k) {
    s.near.is_valid = false;
    search.add(bench::time_of([&] { s.rebuild_candidates(); }));
    list.add(bench::time_of([&] { s.rebuild_candidates(); }));
  }
  print_row(common, "one list", list, hash);
  print_row(common, "one list with search", search, hash);
}

}  // namespace

int main(int argc, char** argv) {
  return bench::run_benchmark(argc, "bench_stage_times FOLDER|CASE [threads] [steps]", [&] {
    omp_set_num_threads(bench::argument(argc, argv, 2, omp_get_num_procs()));
    measure(argv[1], bench::argument(argc, argv, 3, 500));
    return 0;
  });
}
