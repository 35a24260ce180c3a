// SPDX-License-Identifier: BSD-3-Clause
// Whether a machine does more with one test on all its processors or with several beside each other: measured, since it
// depends on caches and memory.
#pragma once

#include <functional>

#include "dem4grm/case_file/case_file.hpp"

namespace dem {

/// So many tests at a time with so many threads each.
struct Crew {
  int workers = 1;
  int threads = 1;

  friend bool operator==(const Crew&, const Crew&) = default;
};

/// Steps a second of all workers together, each with a stand-in for the specimen of the case, over about so many seconds.
/// Throws InputError for grains that cannot be drawn.
double steps_together(const TestCase& test, const Crew& crew, double seconds);

/// The crew for a machine of `processors` that makes most steps a second; fewer workers win a draw, since tests then end
/// one after the other. `most_workers`: there are no more tests, or no more memory. Threads are powers of two, and what is
/// left when workers are few. `measure` gives the steps a second of a crew.
Crew best_crew(int processors, int most_workers, const std::function<double(const Crew&)>& measure);

}  // namespace dem
