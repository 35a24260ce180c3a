// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/core/thread_choice.hpp"

#include <algorithm>

namespace dem {

void ThreadChoice::begin(int threads, double seconds, std::int64_t steps) {
  current_ = threads;
  since_ = seconds;
  steps_at_ = steps;
  has_begun_ = true;
}

/// Half or double the best number, in turn; the best itself when there is no other.
int ThreadChoice::candidate() {
  const int fewer = std::max(1, best_ / 2), more = std::min(most_, best_ * 2);
  const int wanted = try_fewer_ ? fewer : more;
  try_fewer_ = !try_fewer_;
  return wanted != best_ ? wanted : fewer + more - best_;
}

int ThreadChoice::update(double seconds, std::int64_t steps) {
  if (most_ == 1) return 1;
  if (!has_begun_ || steps < steps_at_) {  // the first call, or a new stage
    is_trial_ = false;
    begin(best_, seconds, steps);
    return current_;
  }
  const double spent = seconds - since_;
  if (spent < (is_trial_ ? k_trial : hold_) || steps == steps_at_) return current_;
  const double rate = static_cast<double>(steps - steps_at_) / spent;
  if (!is_trial_) {
    held_rate_ = rate;
    is_trial_ = true;
    begin(candidate(), seconds, steps);
    return current_;
  }
  is_trial_ = false;
  if (rate > k_gain * held_rate_) {
    best_ = current_;
    hold_ = k_first_hold;
  } else {
    hold_ = std::min(2.0 * hold_, k_longest_hold);
  }
  begin(best_, seconds, steps);
  return current_;
}

}  // namespace dem
