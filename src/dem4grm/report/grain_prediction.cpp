// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/report/grain_prediction.hpp"

#include <limits>

namespace dem {

GrainPrediction grain_prediction() {
  GrainPrediction out{};
  out[0] = {-1, -1, -1};
  for (int k = 1; k < k_grain_balls; ++k) {
    out[static_cast<std::size_t>(k)] = {0, -1, -1};
    double shortest = std::numeric_limits<double>::max();
    for (int c = 0; c < k; ++c) {
      for (int a = 0; a < k; ++a) {
        for (int b = 0; b <= a; ++b) {
          const Vec3 first = grain_site(a) - grain_site(c), second = grain_site(b) - grain_site(c);
          const Vec3 gap = grain_site(c) + first + second - grain_site(k);
          const double length = dot(first, first) + dot(second, second);
          if (a == c || b == c || dot(gap, gap) > 0.0 || !(length < shortest)) continue;
          shortest = length;
          out[static_cast<std::size_t>(k)] = {a, b, c};
        }
      }
    }
  }
  return out;
}

std::vector<std::int32_t> prediction_residuals(const std::vector<std::int32_t>& places,
                                               const GrainPrediction& prediction) {
  std::vector<std::int32_t> out(places.size());
  for (std::size_t grain = 0; grain < places.size(); grain += k_grain_balls) {
    const auto at = [&](int slot) { return places[grain + static_cast<std::size_t>(slot)]; };
    for (std::size_t k = 0; k < k_grain_balls; ++k) {
      const auto [a, b, c] = prediction[k];
      std::int32_t expected = 0;
      if (a < 0) {
        expected = grain == 0 ? 0 : places[grain - k_grain_balls];
      } else {
        expected = b < 0 ? at(a) : at(a) + at(b) - at(c);
      }
      out[grain + k] = places[grain + k] - expected;
    }
  }
  return out;
}

}  // namespace dem
