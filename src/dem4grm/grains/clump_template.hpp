// SPDX-License-Identifier: BSD-3-Clause
// Shapes of gravel grains: a few overlapping pebbles, with the mass properties of their union.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dem4grm/core/vec3.hpp"

namespace dem {

/// One ball of a clump, in the clump's principal axes with the centroid at the origin.
struct Pebble {
  Vec3 position;
  double radius = 0.0;
};

/// A shape in its principal axes. All lengths are in units of the sieve size: the smallest square opening that the
/// union of the pebbles passes in any orientation is 1. A clump of sieve size D has pebbles D times as large,
/// volume D^3 times and principal moments density * D^5 times those given here.
struct ClumpTemplate {
  std::string name;
  std::vector<Pebble> pebbles;
  double volume = 0.0;           ///< of the union, overlap counted once
  Vec3 moment_of_inertia;        ///< principal moments of the union at unit density
  double bounding_radius = 0.0;  ///< of the sphere about the centroid that holds all pebbles
};

/// One thing that is wrong with the pebbles of a shape.
struct PebbleFault {
  enum class Part : std::uint8_t { radius, position, pebble };
  std::size_t pebble = 0;  ///< index of the pebble that the message is about
  Part part = Part::pebble;
  std::string message;  ///< counts pebbles from 1, as people do
};

/// Everything that keeps pebbles (any frame and unit, at least one) from being a shape: numbers that are none, radii
/// that are not positive; when there is nothing of that kind, pebbles that do not hang together or lie inside another.
std::vector<PebbleFault> pebble_faults(std::span<const Pebble> pebbles);

/// Builds a template from pebbles in any frame and unit. Throws InputError for no pebbles, a radius that is not
/// positive, or pebbles that do not hang together.
ClumpTemplate make_clump_template(std::string name, std::vector<Pebble> pebbles);

/// The six rounded shapes T1 to T6 that are shipped (docs/theory/clumps.md).
const std::vector<ClumpTemplate>& standard_clump_templates();

/// The standard template of that name, or nullptr.
const ClumpTemplate* find_clump_template(std::string_view name);

}  // namespace dem
