// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/runs/throughput.hpp"

#include <omp.h>

#include <algorithm>
#include <atomic>
#include <barrier>
#include <chrono>
#include <exception>
#include <thread>
#include <vector>

#include "dem4grm/lab/dense_assembly.hpp"
#include "dem4grm/lab/direct_shear.hpp"
#include "dem4grm/lab/grain_compression.hpp"
#include "dem4grm/specimen/draw_grains.hpp"

namespace dem {
namespace {

constexpr double k_draw = 1.03;  // a crew must be faster by this factor than one with fewer workers

Scene stand_in(const TestCase& test) {
  if (const auto* shear = std::get_if<DirectShearCase>(&test)) {
    const SpecimenOrder order = specimen_order(*shear);
    const GrainList grains =
        draw_grains(order.specimen, order.box, order.materials.rubber.density, order.solid_density, order.seed);
    return make_dense_assembly(grains, order.materials, order.box.length, order.box.width, order.seed).scene;
  }
  return lone_grain(std::get<GrainCompressionCase>(test));
}

/// One worker: steps from the moment when all are ready until the time is over.
double steps_of_worker(const Scene& scene, int threads, double seconds, std::barrier<>& all_ready) {
  omp_set_num_threads(threads);  // of this thread of the program only
  Simulation s(scene);
  s.set_time_step(k_frozen_time_step);
  for (int k = 0; k < 3; ++k) s.step();
  all_ready.arrive_and_wait();
  const auto start = std::chrono::steady_clock::now();
  std::chrono::duration<double> spent{};
  int steps = 0;
  do {
    s.step();
    ++steps;
    spent = std::chrono::steady_clock::now() - start;
  } while (spent.count() < seconds);
  return steps / spent.count();
}

}  // namespace

double steps_together(const TestCase& test, const Crew& crew, double seconds) {
  const Scene scene = stand_in(test);
  const auto n = static_cast<std::size_t>(crew.workers);
  std::vector<double> rates(n, 0.0);
  std::barrier all_ready(crew.workers);
  std::vector<std::exception_ptr> failures(n);
  std::vector<std::thread> workers;
  for (std::size_t k = 0; k < n; ++k) {
    workers.emplace_back([&, k] {
      try {
        rates[k] = steps_of_worker(scene, crew.threads, seconds, all_ready);
      } catch (...) {
        failures[k] = std::current_exception();
        all_ready.arrive_and_drop();
      }
    });
  }
  for (std::thread& worker : workers) worker.join();
  for (const std::exception_ptr& failure : failures) {
    if (failure) std::rethrow_exception(failure);
  }
  double sum = 0.0;
  for (const double rate : rates) sum += rate;
  return sum;
}

Crew best_crew(int processors, int most_workers, const std::function<double(const Crew&)>& measure) {
  std::vector<Crew> crews;
  for (int threads = 1; threads < 2 * processors; threads *= 2) {
    const int workers = std::clamp(processors / std::min(threads, processors), 1, std::max(1, most_workers));
    // Workers that the tests or the memory forbid leave their processors to the others.
    const Crew crew{workers, std::max(std::min(threads, processors), processors / workers)};
    if (std::find(crews.begin(), crews.end(), crew) == crews.end()) crews.push_back(crew);
  }
  if (crews.size() == 1) return crews.front();
  std::sort(crews.begin(), crews.end(), [](const Crew& a, const Crew& b) { return a.workers < b.workers; });
  Crew best = crews.front();
  double best_rate = 0.0;
  for (const Crew& crew : crews) {
    const double rate = measure(crew);
    if (rate <= k_draw * best_rate) continue;
    best = crew;
    best_rate = rate;
  }
  return best;
}

}  // namespace dem
