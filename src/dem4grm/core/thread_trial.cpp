// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/core/thread_trial.hpp"

#include <latch>
#include <system_error>
#include <thread>
#include <vector>

namespace dem {

int possible_threads(int wanted) {
  std::latch all_were_tried(1);
  std::vector<std::thread> others;
  others.reserve(static_cast<std::size_t>(wanted));
  try {
    for (int k = 1; k < wanted; ++k) others.emplace_back([&] { all_were_tried.wait(); });
  } catch (const std::system_error&) {
    // Those that live are the answer.
  }
  all_were_tried.count_down();
  for (std::thread& other : others) other.join();
  return static_cast<int>(others.size()) + 1;
}

}  // namespace dem
