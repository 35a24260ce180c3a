// SPDX-License-Identifier: BSD-3-Clause
// Counter-based random numbers: the value depends on (seed, stream, id, draw) alone, never on the order of calls.
#pragma once

#include <cstdint>

#include "dem4grm/core/quaternion.hpp"

namespace dem {

/// All streams of the project in one place; two uses of one stream would be correlated.
enum class RandomStream : std::uint64_t {
  grain_size = 1,
  grain_shape = 2,
  grain_position = 3,
  grain_orientation = 4,
  grain_order = 5,
  monte_carlo = 6,
  stiffest_mode = 7,
  bootstrap = 8,
  test = 99,
};

/// Source of uniform numbers for one (seed, stream, id); each call of next takes the following draw.
/// The mixing function is the finaliser of SplitMix64 (Steele, Lea & Flood 2014), applied twice over the keys.
class RandomSequence {
 public:
  RandomSequence(std::uint64_t seed, RandomStream stream, std::uint64_t id)
      : key_(mix(mix(seed + 0x9e3779b97f4a7c15ULL) ^ mix((static_cast<std::uint64_t>(stream) << 56) + id + 1))) {}

  std::uint64_t next_bits() { return mix(key_ + 0x9e3779b97f4a7c15ULL * ++draw_); }

  /// Uniform in [0, 1), 53 bits.
  double uniform() { return static_cast<double>(next_bits() >> 11U) * 0x1.0p-53; }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }

  /// Uniform random orientation (rejection in the 4-ball, no trigonometry).
  Quaternion orientation() {
    for (;;) {
      const Quaternion q{uniform(-1, 1), uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)};
      const double s = q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z;
      if (s > 0.01 && s <= 1.0) return normalized(q);
    }
  }

 private:
  static constexpr std::uint64_t mix(std::uint64_t z) {
    z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27U)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31U);
  }
  std::uint64_t key_;
  std::uint64_t draw_ = 0;
};

}  // namespace dem
