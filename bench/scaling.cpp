// SPDX-License-Identifier: BSD-3-Clause
// How the cost of a step grows with the specimen, and how it falls with threads.
//
//   bench_scaling CASE [steps]
//
// The grains of the case in boxes of 1/8, 1 and 8 times its volume, as dense assemblies, on 1, 2, 4, ... threads up to
// the number of processors. Prints one CSV row each: microseconds and nanoseconds per ball and step, "warm" with the
// caches as the step before left them, "cold" after a sweep through 128 MiB; then the memory per ball.
#include <fstream>

#include "support.hpp"

namespace {

/// Resident memory of this process, bytes.
double resident_bytes() {
  std::ifstream statm("/proc/self/statm");
  double total = 0.0, resident = 0.0;
  statm >> total >> resident;
  return resident * 4096.0;
}

void sweep(std::vector<double>& buffer) {
  for (double& v : buffer) v += 1.0;
}

bench::Times steps_of(dem::Simulation& s, int steps, std::vector<double>* swept) {
  bench::Times times;
  for (int k = 0; k < steps; ++k) {
    if (swept != nullptr) sweep(*swept);
    times.add(bench::time_of([&] { s.step(); }));
  }
  return times;
}

void measure(dem::DirectShearCase test, double scale, int steps) {
  test.box.length *= scale;
  test.box.width *= scale;
  test.box.height *= scale;
  const double before = resident_bytes();
  bench::Loaded loaded = bench::assembly_of(test);
  dem::Simulation& s = *loaded.specimen.simulation;
  s.margins.tunes = false;
  s.step();
  const double bytes_per_ball = (resident_bytes() - before) / s.balls.n_balls();
  std::vector<double> buffer(std::size_t{16} << 20U);
  for (int threads = 1; threads <= omp_get_num_procs(); threads *= 2) {
    omp_set_num_threads(threads);
    const bench::Times warm = steps_of(s, steps, nullptr), cold = steps_of(s, steps, &buffer);
    const double per_ball = 1e3 / s.balls.n_balls();
    fmt::print("{},{},{:.1f},{:.2f},{:.1f},{:.2f},{:.0f}\n", bench::common_row(test.name, s), scale * scale * scale,
               warm.median(), warm.median() * per_ball, cold.median(), cold.median() * per_ball, bytes_per_ball);
    std::fflush(stdout);
  }
}

}  // namespace

int main(int argc, char** argv) {
  return bench::run_benchmark(argc, "bench_scaling CASE [steps]", [&] {
    const auto test = bench::case_of(argv[1]);
    fmt::print("{},volume,warm_us,warm_ns_per_ball,cold_us,cold_ns_per_ball,bytes_per_ball\n", bench::common_columns());
    for (const double scale : {0.5, 1.0, 2.0}) measure(test, scale, bench::argument(argc, argv, 2, 50));
    return 0;
  });
}
