// SPDX-License-Identifier: BSD-3-Clause
// Shapes of gravel grains: checks, mass properties, scaling to sieve size 1, and the shapes that are shipped.
#include "dem4grm/grains/clump_template.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "dem4grm/core/error.hpp"
#include "dem4grm/grains/clump_mass_properties.hpp"
#include "dem4grm/grains/clump_sieve.hpp"

namespace dem {
namespace {

// Pebbles that just touch hang together, whatever rounding makes of their distance.
constexpr double k_touching = 1e-9;

bool is_finite(const Vec3& a) { return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z); }

bool hang_together(const Pebble& a, const Pebble& b) {
  return norm(a.position - b.position) <= (a.radius + b.radius) * (1.0 + k_touching);
}

/// Index of the first pebble that cannot be reached from pebble 0 over pebbles that touch or overlap; their number when
/// all can.
std::size_t first_apart(std::span<const Pebble> pebbles) {
  std::vector<std::size_t> reached{0};
  std::vector<bool> is_reached(pebbles.size(), false);
  is_reached[0] = true;
  for (std::size_t next = 0; next < reached.size(); ++next) {
    for (std::size_t i = 0; i < pebbles.size(); ++i) {
      if (is_reached[i] || !hang_together(pebbles[reached[next]], pebbles[i])) continue;
      is_reached[i] = true;
      reached.push_back(i);
    }
  }
  return static_cast<std::size_t>(std::find(is_reached.begin(), is_reached.end(), false) - is_reached.begin());
}

/// What is wrong with single pebbles.
std::vector<PebbleFault> bad_numbers(std::span<const Pebble> pebbles) {
  using Part = PebbleFault::Part;
  std::vector<PebbleFault> faults;
  for (std::size_t i = 0; i < pebbles.size(); ++i) {
    const double radius = pebbles[i].radius;
    if (!(std::isfinite(radius) && radius > 0.0)) {
      faults.push_back(
          {i, Part::radius, fmt::format("pebble {} has radius {}, which must be positive and finite", i + 1, radius)});
    }
    if (!is_finite(pebbles[i].position)) {
      faults.push_back({i, Part::position, fmt::format("pebble {} has a position that is no number", i + 1)});
    }
  }
  return faults;
}

/// What is wrong with how the pebbles lie to each other.
std::vector<PebbleFault> bad_arrangement(std::span<const Pebble> pebbles) {
  using Part = PebbleFault::Part;
  std::vector<PebbleFault> faults;
  if (const std::size_t apart = first_apart(pebbles); apart < pebbles.size()) {
    faults.push_back({apart, Part::pebble,
                      fmt::format("the pebbles do not hang together: nothing joins pebble {} to pebble 1", apart + 1)});
  }
  for (std::size_t i = 0; i < pebbles.size(); ++i) {
    for (std::size_t j = 0; j < pebbles.size(); ++j) {
      const double distance = norm(pebbles[i].position - pebbles[j].position);
      // Of two equal pebbles in one place only the later is named.
      const bool is_inside = distance + pebbles[i].radius <= pebbles[j].radius;
      const bool is_twin = distance == 0.0 && pebbles[i].radius == pebbles[j].radius;
      if (i != j && is_inside && !(is_twin && i < j)) {
        faults.push_back(
            {i, Part::pebble, fmt::format("pebble {} lies inside pebble {} and can be left out", i + 1, j + 1)});
      }
    }
  }
  return faults;
}

void check_pebbles(const std::string& name, const std::vector<Pebble>& pebbles) {
  std::string problems = pebbles.empty() ? "; it has no pebbles" : "";
  if (!pebbles.empty()) {
    for (const PebbleFault& fault : pebble_faults(pebbles)) problems += "; " + fault.message;
  }
  if (!problems.empty()) throw InputError(fmt::format("clump shape '{}': {}", name, problems.substr(2)));
}

/// T1 to T6 (physics reference, 5.3; radii in units of the largest pebble) and the sphere, for comparisons.
std::vector<ClumpTemplate> make_shipped_templates() {
  // Triangle of edge 0.70 and tetrahedron of edge 0.75 as roots of exact numbers.
  const double triangle = 0.70, triangle_height = triangle * std::sqrt(3.0) / 2.0;
  const double corner = 0.75 / std::sqrt(8.0);  // of the cube whose alternate corners make the tetrahedron
  std::vector<ClumpTemplate> shapes;
  shapes.push_back(make_clump_template("T1", {{{-0.30, 0, 0}, 1}, {{0.30, 0, 0}, 1}}));
  shapes.push_back(make_clump_template("T2", {{{-0.30, 0, 0}, 1}, {{0.40, 0, 0}, 0.8}}));
  shapes.push_back(
      make_clump_template("T3", {{{-triangle / 2, 0, 0}, 1}, {{triangle / 2, 0, 0}, 1}, {{0, triangle_height, 0}, 1}}));
  shapes.push_back(make_clump_template("T4", {{{-0.6, 0, 0}, 0.85}, {{0, 0, 0}, 1}, {{0.6, 0, 0}, 0.85}}));
  shapes.push_back(make_clump_template("T5", {{{corner, corner, corner}, 1},
                                              {{corner, -corner, -corner}, 1},
                                              {{-corner, corner, -corner}, 1},
                                              {{-corner, -corner, corner}, 1}}));
  shapes.push_back(make_clump_template("T6", {{{0, 0, 0}, 1},
                                              {{0.5, 0.1, 0}, 0.8},
                                              {{-0.45, 0.15, 0.1}, 0.8},
                                              {{0.05, -0.45, 0.1}, 0.78},
                                              {{-0.05, 0.1, -0.35}, 0.85}}));
  return shapes;
}

}  // namespace

std::vector<PebbleFault> pebble_faults(std::span<const Pebble> pebbles) {
  std::vector<PebbleFault> faults = bad_numbers(pebbles);
  return faults.empty() ? bad_arrangement(pebbles) : faults;
}

ClumpTemplate make_clump_template(std::string name, std::vector<Pebble> pebbles) {
  check_pebbles(name, pebbles);
  const UnionProperties body = union_properties(pebbles);
  const PrincipalAxes principal = principal_axes(body.inertia);
  const double sieve = smallest_square_opening(pebbles);
  const double cube = sieve * sieve * sieve;

  ClumpTemplate shape;
  shape.name = std::move(name);
  shape.volume = body.volume / cube;
  shape.moment_of_inertia = principal.moments * (1.0 / (cube * sieve * sieve));
  for (const Pebble& pebble : pebbles) {
    const Vec3 position = to_body(principal.axes, pebble.position - body.centroid) * (1.0 / sieve);
    shape.pebbles.push_back({position, pebble.radius / sieve});
    shape.bounding_radius = std::max(shape.bounding_radius, norm(position) + pebble.radius / sieve);
  }
  return shape;
}

const std::vector<ClumpTemplate>& standard_clump_templates() {
  static const std::vector<ClumpTemplate> shapes = make_shipped_templates();
  return shapes;
}

const ClumpTemplate* find_clump_template(std::string_view name) {
  static const ClumpTemplate sphere = make_clump_template("sphere", {{{0, 0, 0}, 1}});
  if (name == sphere.name) return &sphere;
  const std::vector<ClumpTemplate>& shapes = standard_clump_templates();
  const auto found = std::find_if(shapes.begin(), shapes.end(), [&](const ClumpTemplate& s) { return s.name == name; });
  return found == shapes.end() ? nullptr : &*found;
}

}  // namespace dem
