// SPDX-License-Identifier: BSD-3-Clause
// How fast is each hot loop by itself? Bonds, contacts, ordered sums, the same sums without order and the list of
// candidates, on the specimen of an output folder or on a dense assembly of a case.
//
//   bench_kernels FOLDER|CASE [threads] [repeats]
//
// Nothing moves: every loop runs again and again on the same state. Prints one CSV row per loop: fastest and median time
// in microseconds over all repeats, the number of its items and the fastest time per item in nanoseconds.
#include <array>
#include <cstdint>
#include <vector>

#include "dem4grm/core/blocks.hpp"
#include "dem4grm/engine/kernels/kernels.hpp"
#include "support.hpp"

namespace {

/// One number of every block, so that no loop can be left out by the compiler.
using Kept = std::vector<double>;

/// What the ordered sums would be without their order: every row adds to both its bodies at once, by atomic additions.
void run_atomic_sums(const dem::Simulation& s, std::vector<std::array<double, 8>>& loads) {
  const dem::ContactTable& t = s.contacts;
  const auto n_loads = static_cast<std::int64_t>(loads.size()), n_rows = static_cast<std::int64_t>(t.n_pairs());
  const auto add = [&](int ball, const dem::Vec3& force, const dem::Vec3& torque) {
    double* to = loads[static_cast<std::size_t>(ball)].data();
    const double values[6] = {force.x, force.y, force.z, torque.x, torque.y, torque.z};
    for (std::size_t c = 0; c < 6; ++c) {
#pragma omp atomic
      to[c] += values[c];
    }
  };
#pragma omp parallel for schedule(static)
  for (std::int64_t k = 0; k < n_loads; ++k) loads[static_cast<std::size_t>(k)] = {};
#pragma omp parallel for schedule(static)
  for (std::int64_t k = 0; k < n_rows; ++k) {
    const auto row = static_cast<std::size_t>(k);
    const dem::Vec3 force = t.force(row), couple = t.couple(row);
    add(dem::first_of(t.pairs[row]), force, couple * t.lever_i(row));
    add(dem::second_of(t.pairs[row]), -force, couple * t.lever_j(row));
  }
}

template <class Work>
void measure(const std::string& common, const char* name, std::size_t items, int repeats, Work&& work) {
  if (items == 0) return;
  bench::Times times;
  for (int k = 0; k < repeats; ++k) times.add(bench::time_of(work));
  fmt::print("{},{},{:.2f},{:.2f},{},{:.3f}\n", common, name, times.fastest(), times.median(), items,
             times.fastest() * 1e3 / static_cast<double>(items));
}

void measure_all(const std::string& source, int repeats) {
  bench::Loaded loaded = bench::specimen_of(source);
  dem::Simulation& s = *loaded.specimen.simulation;
  s.set_time_step(dem::k_frozen_time_step);
  s.step();
  const std::string common = bench::common_row(loaded.test.name, s);
  const auto blocks = static_cast<std::size_t>(s.balls.n_blocks);
  Kept kept(blocks + 1);
  fmt::print("{},kernel,fastest_us,median_us,items,fastest_ns_per_item\n", bench::common_columns());
  const auto bonds = static_cast<std::size_t>(s.balls.n_grains) * dem::k_grain_bonds;
  if (s.scene.bond.form == dem::BondForm::history_free) {
    measure(common, "bonds", bonds, repeats, [&] { dem::kernels().evaluate_bonds_alone(s, kept); });
  }
  measure(common, "ball contacts", s.contacts.n_pairs(), repeats, [&] { dem::evaluate_ball_contacts(s); });
  measure(common, "wall contacts", s.contacts.wall_pairs.size(), repeats, [&] { dem::evaluate_wall_contacts(s); });
  const auto references = static_cast<std::size_t>(s.references.start[blocks]);
  measure(common, "ordered sums", references, repeats, [&] { dem::kernels().sum_contacts_alone(s, kept); });
  std::vector<std::array<double, 8>> loads(static_cast<std::size_t>(s.balls.n_balls()));
  measure(common, "atomic sums", 2 * s.contacts.n_pairs(), repeats, [&] { run_atomic_sums(s, loads); });
  const auto balls = static_cast<std::size_t>(s.balls.n_balls());
  measure(common, "list", balls, std::max(repeats / 20, 3), [&] { s.rebuild_candidates(); });
  measure(common, "list with search", balls, std::max(repeats / 20, 3), [&] {
    s.near.is_valid = false;
    s.rebuild_candidates();
  });
}

}  // namespace

int main(int argc, char** argv) {
  return bench::run_benchmark(argc, "bench_kernels FOLDER|CASE [threads] [repeats]", [&] {
    omp_set_num_threads(bench::argument(argc, argv, 2, omp_get_num_procs()));
    measure_all(argv[1], bench::argument(argc, argv, 3, 200));
    return 0;
  });
}
