// SPDX-License-Identifier: BSD-3-Clause
// Properties that every clump must have, on random clumps of one to six pebbles.
#include <gtest/gtest.h>
// rapidcheck's own header needs gtest's first.
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "dem4grm/core/random.hpp"
#include "dem4grm/grains/clump_mass_properties.hpp"
#include "dem4grm/grains/clump_template.hpp"

namespace {

using namespace dem;

constexpr double k_pi = 3.14159265358979323846;

/// Pebbles of radius 0.5 to 1; each overlaps the one before it, none lies inside it.
std::vector<Pebble> random_clump(int n_pebbles, std::uint64_t seed) {
  RandomSequence random(seed, RandomStream::test, 0);
  std::vector<Pebble> pebbles{{{random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(-3, 3)}, 1.0}};
  while (static_cast<int>(pebbles.size()) < n_pebbles) {
    const Pebble& last = pebbles.back();
    const double radius = random.uniform(0.5, 1.0);
    const double distance = std::abs(last.radius - radius) + random.uniform(0.2, 0.9) * std::min(radius, last.radius);
    pebbles.push_back({last.position + frame_of(random.orientation()).e1 * distance, radius});
  }
  return pebbles;
}

std::vector<Pebble> drawn_clump() {
  const int n_pebbles = *rc::gen::inRange(1, 7);
  return random_clump(n_pebbles, *rc::gen::arbitrary<std::uint64_t>());
}

bool is_close(double a, double b, double tolerance) { return std::abs(a - b) <= tolerance; }

RC_GTEST_PROP(Clump, PrincipalFrameIsRightHandedAndOrthonormal, ()) {
  const PrincipalAxes p = principal_axes(union_properties(drawn_clump()).inertia);
  RC_ASSERT(is_close(dot(cross(p.axes.e1, p.axes.e2), p.axes.e3), 1.0, 1e-12));
  RC_ASSERT(is_close(norm(p.axes.e1), 1.0, 1e-12));
  RC_ASSERT(is_close(norm(p.axes.e2), 1.0, 1e-12));
  RC_ASSERT(is_close(dot(p.axes.e1, p.axes.e2), 0.0, 1e-12));
  RC_ASSERT(p.moments.x > 0.0);
  RC_ASSERT(p.moments.x <= p.moments.y);
  RC_ASSERT(p.moments.y <= p.moments.z);
  RC_ASSERT(p.moments.z <= p.moments.x + p.moments.y);  // holds for every real body
}

RC_GTEST_PROP(Clump, VolumeLiesBetweenTheLargestPebbleAndTheSum, ()) {
  const std::vector<Pebble> pebbles = drawn_clump();
  double sum = 0.0, largest = 0.0;
  for (const Pebble& pebble : pebbles) {
    const double volume = 4.0 / 3.0 * k_pi * pebble.radius * pebble.radius * pebble.radius;
    sum += volume;
    largest = std::max(largest, volume);
  }
  const double volume = union_properties(pebbles).volume;
  RC_ASSERT(volume <= sum * (1.0 + 1e-12));
  RC_ASSERT(volume >= largest * (1.0 - 1e-12));
}

RC_GTEST_PROP(Clump, MassPropertiesTurnWithThePebbles, ()) {
  const std::vector<Pebble> pebbles = drawn_clump();
  RandomSequence random(*rc::gen::arbitrary<std::uint64_t>(), RandomStream::test, 1);
  const Quaternion q = random.orientation();
  std::vector<Pebble> turned = pebbles;
  for (Pebble& pebble : turned) pebble.position = rotate(q, pebble.position);
  const UnionProperties a = union_properties(pebbles), b = union_properties(turned);
  const PrincipalAxes pa = principal_axes(a.inertia), pb = principal_axes(b.inertia);
  RC_ASSERT(is_close(b.volume / a.volume, 1.0, 1e-4));
  RC_ASSERT(norm(b.centroid - rotate(q, a.centroid)) <= 1e-4);
  RC_ASSERT(is_close(pb.moments.x / pa.moments.x, 1.0, 2e-4));
  RC_ASSERT(is_close(pb.moments.y / pa.moments.y, 1.0, 2e-4));
  RC_ASSERT(is_close(pb.moments.z / pa.moments.z, 1.0, 2e-4));
}

RC_GTEST_PROP(Clump, TemplateHasSieveSizeOneWhateverTheUnit, ()) {
  std::vector<Pebble> pebbles = drawn_clump();
  // A random chain may hide a pebble inside one of its other neighbours, which templates refuse.
  for (const Pebble& p : pebbles) {
    for (const Pebble& q : pebbles) RC_PRE(&p == &q || norm(p.position - q.position) + p.radius > q.radius);
  }
  const ClumpTemplate shape = make_clump_template("random", pebbles);
  for (Pebble& pebble : pebbles) pebble = {pebble.position * 1e-3, pebble.radius * 1e-3};
  const ClumpTemplate small = make_clump_template("small", pebbles);
  // The search ends in another local minimum now and then when the last bits differ; 2e-5 of the size was seen.
  RC_ASSERT(is_close(small.volume / shape.volume, 1.0, 3e-4));
  double largest = 0.0;
  for (const Pebble& pebble : shape.pebbles) largest = std::max(largest, pebble.radius);
  RC_ASSERT(2.0 * largest <= 1.0 + 1e-8);                // no opening is smaller than the largest pebble
  RC_ASSERT(2.0 * shape.bounding_radius >= 1.0 - 1e-8);  // and the bounding sphere passes
}

}  // namespace
