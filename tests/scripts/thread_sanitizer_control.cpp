// SPDX-License-Identifier: BSD-3-Clause
// Control experiment of the thread sanitizer: `clean` synchronises by OpenMP alone and must pass without a report,
// `add`, `order` and `late` hold data races that this code base could grow and must be reported.
#include <cstddef>
#include <cstdio>
#include <string_view>
#include <vector>

namespace {

constexpr int k_n_contacts = 20000;

// Contacts first, then each ball gathers its own: joined by the barrier between two loops, as in the step.
double gather() {
  std::vector<double> contact_force(k_n_contacts), ball_force(k_n_contacts);
  double sum = 0.0;
  for (int step = 0; step < 20; ++step) {
#pragma omp parallel
    {
#pragma omp for schedule(static)
      for (int c = 0; c < k_n_contacts; ++c) contact_force[static_cast<std::size_t>(c)] = c + step;
#pragma omp for schedule(dynamic, 100)
      for (int i = 0; i < k_n_contacts; ++i) {
        ball_force[static_cast<std::size_t>(i)] = contact_force[static_cast<std::size_t>(k_n_contacts - 1 - i)];
      }
#pragma omp single
      for (const double force : ball_force) sum += force;
#pragma omp critical
      sum += 1.0;
    }
  }
  return sum;
}

// Two contacts add to the same ball with no order between them.
double add() {
  std::vector<double> ball_force(k_n_contacts / 2);
#pragma omp parallel for schedule(static)
  for (int c = 0; c < k_n_contacts; ++c) ball_force[static_cast<std::size_t>((c * 7) % (k_n_contacts / 2))] += 1.0;
  return ball_force[0];
}

// The second loop reads what another thread may not have written yet: the barrier was taken away.
double order() {
  std::vector<double> contact_force(k_n_contacts), ball_force(k_n_contacts);
#pragma omp parallel
  {
#pragma omp for schedule(static) nowait
    for (int c = 0; c < k_n_contacts; ++c) contact_force[static_cast<std::size_t>(c)] = c;
#pragma omp for schedule(static)
    for (int i = 0; i < k_n_contacts; ++i) {
      ball_force[static_cast<std::size_t>(i)] = contact_force[static_cast<std::size_t>(k_n_contacts - 1 - i)];
    }
  }
  return ball_force[0];
}

// One word is written by every thread, each time after much other work: found only with a long enough memory of the
// accesses of each thread (history_size).
double late() {
  constexpr int n_blocks = 24, block_size = 20000;
  std::vector<double> value(static_cast<std::size_t>(n_blocks) * block_size, 1.0);
  double last = 0.0;
  for (int step = 0; step < 20; ++step) {
#pragma omp parallel for schedule(static)
    for (int b = 0; b < n_blocks; ++b) {
      double* const block = value.data() + static_cast<std::ptrdiff_t>(b) * block_size;
      for (int i = 1; i < block_size; ++i) block[i] += 0.5 * block[i - 1];
      last = block[block_size - 1];
    }
  }
  return last;
}

}  // namespace

int main(int n_arguments, char** arguments) {
  const std::string_view kind = n_arguments > 1 ? arguments[1] : "clean";
  const double result = kind == "add" ? add() : kind == "order" ? order() : kind == "late" ? late() : gather();
  std::printf("%g\n", result);
  return 0;
}
