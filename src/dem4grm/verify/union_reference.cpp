// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/verify/union_reference.hpp"

#include <algorithm>
#include <utility>

namespace dem::verify {

namespace {

double width(std::span<const Pebble> pebbles, const Vec3& u) {
  double low = 1e300, high = -1e300;
  for (const Pebble& p : pebbles) {
    low = std::min(low, dot(p.position, u) - p.radius);
    high = std::max(high, dot(p.position, u) + p.radius);
  }
  return high - low;
}

double opening(std::span<const Pebble> pebbles, const Quaternion& q) {
  const Frame f = frame_of(q);
  return std::max(width(pebbles, f.e1), width(pebbles, f.e2));
}

/// The minimum lies on a kink, where the axes of a coordinate search may all lead up: directions are drawn instead.
double follow_down(std::span<const Pebble> pebbles, Quaternion q, RandomSequence random) {
  double best = opening(pebbles, q);
  for (double step = 0.05; step > 1e-10; step *= 0.7) {
    for (int attempt = 0; attempt < 60; ++attempt) {
      const Quaternion turn{1.0, random.uniform(-step, step), random.uniform(-step, step), random.uniform(-step, step)};
      const Quaternion next = normalized(turn * q);
      const double value = opening(pebbles, next);
      if (value >= best) continue;
      best = value;
      q = next;
    }
  }
  return best;
}

}  // namespace

double scanned_opening(std::span<const Pebble> pebbles) {
  constexpr int n_views = 4000, n_turns = 45, n_followed = 60;
  std::vector<std::pair<double, Quaternion>> seen;
  seen.reserve(static_cast<std::size_t>(n_views) * n_turns);
  for (int i = 0; i < n_views; ++i) {
    // Views on a spiral over the half sphere; the frame is the turn that carries z to the view.
    const double z = (i + 0.5) / n_views, s = std::sqrt(1 - z * z), angle = 2.399963229728653 * i;
    const Quaternion view = normalized({1.0 + z, -s * std::sin(angle), s * std::cos(angle), 0.0});
    for (int j = 0; j < n_turns; ++j) {
      const double half = 0.25 * k_pi * j / n_turns;  // a square repeats after 90 degrees
      const Quaternion q = view * Quaternion{std::cos(half), 0, 0, std::sin(half)};
      seen.emplace_back(opening(pebbles, q), q);
    }
  }
  std::partial_sort(seen.begin(), seen.begin() + n_followed, seen.end(),
                    [](const auto& a, const auto& b) { return a.first < b.first; });
  double best = seen[0].first;
  for (int k = 0; k < n_followed; ++k) {
    const auto id = static_cast<std::uint64_t>(k);
    best = std::min(best, follow_down(pebbles, seen[static_cast<std::size_t>(k)].second,
                                      RandomSequence(17, RandomStream::monte_carlo, id)));
  }
  return best;
}

}  // namespace dem::verify
