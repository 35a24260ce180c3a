// SPDX-License-Identifier: BSD-3-Clause
// Sieve size of a clump: the smallest square opening that it passes.
#include "dem4grm/grains/clump_sieve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <string>
#include <vector>

#include "dem4grm/core/quaternion.hpp"
#include "dem4grm/core/random.hpp"

namespace dem {
namespace {

constexpr std::uint64_t k_search_seed = 0;  // fixed: the size of a shape must not hang on the seed of a run
constexpr int k_starts = 2000;              // random orientations, about 10 degrees apart
constexpr std::size_t k_refined = 24;       // the best of them are refined: there are several local minima
constexpr int k_trials = 80;                // random turns that are tried before the turns get smaller
constexpr int k_most_trials = 100000;       // of one refinement, so that it ends whatever happens
constexpr double k_first_turn = 0.1;        // rad
constexpr double k_last_turn = 1e-11;       // rad
constexpr int k_most_descents = 20;         // from one start
constexpr double k_settled = 1e-10;         // relative gain of a descent that counts as none

double width(std::span<const Pebble> pebbles, const Vec3& u) {
  double low = dot(pebbles[0].position, u) - pebbles[0].radius;
  double high = dot(pebbles[0].position, u) + pebbles[0].radius;
  for (const Pebble& pebble : pebbles.subspan(1)) {
    const double along = dot(pebble.position, u);
    low = std::min(low, along - pebble.radius);
    high = std::max(high, along + pebble.radius);
  }
  return high - low;
}

/// Side of the square with edges along the first two axes of the orientation that holds the projected clump.
double square_side(std::span<const Pebble> pebbles, const Quaternion& q) {
  const Frame axes = frame_of(q);
  return std::max(width(pebbles, axes.e1), width(pebbles, axes.e2));
}

struct Candidate {
  Quaternion orientation;
  double side = 0.0;
};

/// Descent by random turns that get smaller when none of them helps. The side has kinks in its valleys, where
/// gradients and moves along fixed axes get stuck; random turns do not.
Candidate refine(std::span<const Pebble> pebbles, Candidate best, RandomSequence& random) {
  int trials = 0;
  for (double turn = k_first_turn; turn > k_last_turn && trials < k_most_trials;) {
    bool is_better = false;
    for (int trial = 0; trial < k_trials; ++trial, ++trials) {
      const Quaternion step{1.0, turn * random.uniform(-0.5, 0.5), turn * random.uniform(-0.5, 0.5),
                            turn * random.uniform(-0.5, 0.5)};
      const Quaternion tried = normalized(step * best.orientation);
      const double side = square_side(pebbles, tried);
      if (side < best.side) {
        best = {tried, side};
        is_better = true;
      }
    }
    if (!is_better) turn *= 0.5;
  }
  return best;
}

/// Descents, each from where the last one ended, until a fresh one with large turns gains nothing: a single descent
/// can run its turns down to nothing in a narrow valley whose floor still falls.
double refine_until_settled(std::span<const Pebble> pebbles, Candidate best, RandomSequence& random) {
  for (int descent = 0; descent < k_most_descents; ++descent) {
    const Candidate refined = refine(pebbles, best, random);
    const bool is_settled = best.side - refined.side <= k_settled * refined.side;
    best = refined;
    if (is_settled) break;
  }
  return best.side;
}

/// Nine significant digits: sides that are equal but for the last steps of the search become equal numbers.
double rounded(double value) {
  const std::string text = fmt::format("{:.8e}", value);
  double result = value;
  std::from_chars(text.data(), text.data() + text.size(), result);
  return result;
}

}  // namespace

double smallest_square_opening(std::span<const Pebble> pebbles) {
  RandomSequence random(k_search_seed, RandomStream::monte_carlo, 0);
  std::vector<Candidate> candidates;
  candidates.reserve(k_starts);
  for (int start = 0; start < k_starts; ++start) {
    const Quaternion q = random.orientation();
    candidates.push_back({q, square_side(pebbles, q)});
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.side < b.side; });
  double smallest = candidates.front().side;
  for (std::size_t i = 0; i < k_refined; ++i)
    smallest = std::min(smallest, refine_until_settled(pebbles, candidates[i], random));
  return rounded(smallest);
}

}  // namespace dem
