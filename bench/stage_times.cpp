// SPDX-License-Identifier: BSD-3-Clause
// Where does a time step go? Prepares the specimen of a case, shears it a little and times every stage of the step.
//
//   bench_stage_times cases/quick.toml [threads] [steps]
//
// Prints one CSV row per stage: fastest and median time of the stage in microseconds over all steps, and the time of
// one candidate search. The specimen is only brought near rest (force ratio 1e-2), which changes no cost.
#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <functional>
#include <string>
#include <vector>

#include "dem4grm/io/case_file.hpp"
#include "dem4grm/lab/direct_shear.hpp"
#include "dem4grm/version.hpp"
#include "dem4grm/walls/shear_box.hpp"

namespace {

using Clock = std::chrono::steady_clock;

double microseconds(Clock::duration d) { return std::chrono::duration<double, std::micro>(d).count(); }

struct Stage {
  const char* name;
  std::function<void(dem::Simulation&)> run;
  std::vector<double> times;
};

dem::Specimen near_rest(const dem::DirectShearCase& test) {
  dem::SpecimenOrder order = dem::specimen_order(test);
  order.equilibrium.force_ratio = 1e-2;
  order.equilibrium.plate_speed = 1.0;
  order.equilibrium.hold_steps = 100;
  return dem::prepare_specimen(order, {});
}

void measure(const std::string& path, int threads, int steps) {
  const dem::LoadedCase loaded = dem::load_case(path);
  const auto& test = std::get<dem::DirectShearCase>(loaded.test);
  dem::Specimen specimen = near_rest(test);
  dem::Simulation& s = *specimen.simulation;
  s.servo.speed_cap = std::max(test.servo.shear_speed_cap, test.shear.velocity);
  std::array<Stage, 6> stages{{{"candidates", dem::refresh_candidates, {}},
                               {"ball contacts", dem::evaluate_ball_contacts, {}},
                               {"wall contacts", dem::evaluate_wall_contacts, {}},
                               {"rubber grains", dem::advance_rubber_grains, {}},
                               {"clumps", dem::advance_clumps, {}},
                               {"walls", dem::move_walls, {}}}};
  for (int k = 0; k < steps; ++k) {
    dem::ShearBox::set_velocities(s.walls, test.shear.moving_half, test.shear.velocity,
                                  s.walls[dem::ShearBox::k_top_plate].velocity.z);
    for (Stage& stage : stages) {
      const auto start = Clock::now();
      stage.run(s);
      stage.times.push_back(microseconds(Clock::now() - start));
    }
    s.time += s.dt;
    ++s.steps;
  }
  const std::string common =
      fmt::format("{},{},{},{},{},{},{},{}", dem::k_commit, dem::k_compiler, test.name, threads, s.balls.n_balls(),
                  s.contacts.n_pairs(), s.contacts.wall_pairs.size(), s.state_hash());
  fmt::print("commit,compiler,case,threads,balls,pairs,wall_pairs,state_hash,stage,fastest_us,median_us,mean_us\n");
  const auto row = [&](const char* name, std::vector<double> t) {
    std::sort(t.begin(), t.end());
    double sum = 0.0;
    for (const double v : t) sum += v;
    fmt::print("{},{},{:.2f},{:.2f},{:.2f}\n", common, name, t.front(), t[t.size() / 2],
               sum / static_cast<double>(t.size()));
  };
  for (const Stage& stage : stages) row(stage.name, stage.times);
  std::vector<double> search;
  for (int k = 0; k < 10; ++k) {
    const auto start = Clock::now();
    s.rebuild_candidates();
    search.push_back(microseconds(Clock::now() - start));
  }
  row("one search", search);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fputs("usage: bench_stage_times CASE [threads] [steps]\n", stderr);
    return 64;
  }
  try {
    const int threads = argc > 2 ? std::atoi(argv[2]) : omp_get_num_procs();
    omp_set_num_threads(threads);
    measure(argv[1], threads, argc > 3 ? std::atoi(argv[3]) : 2000);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
