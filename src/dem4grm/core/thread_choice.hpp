// SPDX-License-Identifier: BSD-3-Clause
// How many threads are fastest just now. On a machine with other work, two threads that wait for each other at every
// stage can be several times slower than one; since the number never changes a result, it may change during a run.
#pragma once

#include <cstdint>

namespace dem {

/// Tries half and double the present number of threads now and then and keeps what makes more steps per second. Pure
/// arithmetic: the caller brings the clock and applies the answer.
class ThreadChoice {
 public:
  /// most: threads to begin with and never to exceed, at least 1.
  explicit ThreadChoice(int most) : most_(most), best_(most), current_(most) {}

  /// seconds: of any steady clock; steps: done so far in the present stage (may start anew from 0).
  /// Returns the number of threads to use from now on.
  int update(double seconds, std::int64_t steps);

  [[nodiscard]] int current() const { return current_; }

  static constexpr double k_trial = 0.25;         ///< s, length of a trial
  static constexpr double k_first_hold = 1.0;     ///< s, between trials at first and after a change
  static constexpr double k_longest_hold = 16.0;  ///< s
  static constexpr double k_gain = 1.1;           ///< a trial must be faster by this factor

 private:
  void begin(int threads, double seconds, std::int64_t steps);
  [[nodiscard]] int candidate();

  int most_, best_, current_;
  bool has_begun_ = false, is_trial_ = false, try_fewer_ = true;
  double hold_ = k_first_hold, since_ = 0.0, held_rate_ = 0.0;
  std::int64_t steps_at_ = 0;
};

}  // namespace dem
