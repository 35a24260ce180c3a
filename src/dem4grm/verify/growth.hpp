// SPDX-License-Identifier: BSD-3-Clause
// Does small motion grow? What tells a stable time step from one that is not.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "dem4grm/core/random.hpp"
#include "dem4grm/engine/simulation.hpp"
#include "dem4grm/verify/findings.hpp"

namespace dem::verify {

/// Source of three numbers from -size to size.
class RandomVectors {
 public:
  explicit RandomVectors(std::uint64_t seed) : random_(seed, RandomStream::test, 0) {}
  Vec3 operator()(double size) {
    return {random_.uniform(-size, size), random_.uniform(-size, size), random_.uniform(-size, size)};
  }

 private:
  RandomSequence random_;
};

/// Largest kinetic energy over the start's within so many steps; stops when it has grown by `enough`.
inline double largest_growth(Simulation& s, int steps, double enough = 1e6) {
  const double start = s.energy().kinetic;
  double largest = 0.0;
  for (int k = 0; k < steps && largest < enough * start; ++k) {
    s.step();
    const double now = s.energy().kinetic;
    largest = std::isfinite(now) ? std::max(largest, now) : 1e300;
  }
  return largest / start;
}

/// Below the limit the kinetic energy stays within 20 times its start, above it passes `enough` times that.
inline void hold_growth(Findings& findings, const std::string& what, double fraction, double growth,
                        double enough = 1e6) {
  constexpr const char* k_border = "border of the leapfrog scheme, largest eigenvalue 4";
  const std::string quantity = fmt::format("growth of the kinetic energy at {} of the limit, {}", fraction, what);
  if (fraction < 1.0) {
    findings.at_most(quantity, "1", 20.0, growth, k_border);
  } else {
    findings.at_least(quantity, "1", enough, growth, k_border);
  }
}

}  // namespace dem::verify
