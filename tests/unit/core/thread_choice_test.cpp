// SPDX-License-Identifier: BSD-3-Clause
// The choice of threads, on machines whose speed is given by a formula.
#include "dem4grm/core/thread_choice.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <map>

namespace dem {
namespace {

/// Runs for some simulated seconds; returns the share of time spent with each number of threads.
std::map<int, double> simulate(int most, double seconds, const std::function<double(int, double)>& steps_per_second) {
  ThreadChoice choice(most);
  std::map<int, double> share;
  double time = 0.0, steps = 0.0;
  const double tick = 0.03;
  while (time < seconds) {
    const int threads = choice.update(time, static_cast<std::int64_t>(steps));
    EXPECT_GE(threads, 1);
    EXPECT_LE(threads, most);
    share[threads] += tick / seconds;
    steps += steps_per_second(threads, time) * tick;
    time += tick;
  }
  return share;
}

TEST(ThreadChoice, KeepsAllThreadsOnAQuietMachine) {
  auto share = simulate(2, 200.0, [](int n, double) { return n == 2 ? 1800.0 : 1000.0; });
  EXPECT_GT(share[2], 0.96);
}

TEST(ThreadChoice, FallsBackToOneThreadWhenTwoDisturbEachOther) {
  auto share = simulate(2, 200.0, [](int n, double) { return n == 2 ? 300.0 : 1000.0; });
  EXPECT_GT(share[1], 0.96);
}

TEST(ThreadChoice, ComesBackWhenTheMachineIsQuietAgain) {
  auto share = simulate(2, 400.0, [](int n, double t) { return n == 2 ? (t < 200.0 ? 300.0 : 1800.0) : 1000.0; });
  EXPECT_GT(share[2], 0.42);
  EXPECT_GT(share[1], 0.42);
}

TEST(ThreadChoice, FindsAnOptimumInTheMiddle) {
  auto share = simulate(16, 300.0, [](int n, double) { return n <= 4 ? 1000.0 * n : 4000.0 / (n / 4.0); });
  EXPECT_GT(share[4], 0.9);
}

TEST(ThreadChoice, ANewStageStartsANewMeasurement) {
  ThreadChoice choice(2);
  EXPECT_EQ(choice.update(0.0, 0), 2);
  EXPECT_EQ(choice.update(2.0, 2000), 1);  // a trial with half of them
  EXPECT_EQ(choice.update(2.1, 0), 2);     // steps started anew: the trial says nothing
}

TEST(ThreadChoice, OneProcessorIsLeftAlone) {
  ThreadChoice choice(1);
  for (int k = 0; k < 100; ++k) EXPECT_EQ(choice.update(0.5 * k, 100 * k), 1);
}

}  // namespace
}  // namespace dem
