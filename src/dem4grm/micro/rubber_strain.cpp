// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/micro/rubber_strain.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "dem4grm/micro/tensor.hpp"

namespace dem {
namespace {

/// Corner slots of a face of a cell, in order around it, seen from outside against the clock.
using Face = std::array<std::size_t, 4>;

/// The 24 outer faces: on each side (axis, sign) of the grain two by two.
constexpr std::array<Face, 24> make_outer_faces() {
  std::array<Face, 24> faces{};
  std::size_t n = 0;
  const std::array<std::size_t, 3> stride{1, 3, 9};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t u = stride[(axis + 1) % 3], v = stride[(axis + 2) % 3];
    for (const bool is_far : {false, true}) {
      for (std::size_t k = 0; k < 4; ++k) {
        const std::size_t corner = (is_far ? 2 * stride[axis] : 0) + (k % 2) * u + (k / 2) * v;
        // u, v and the axis are right-handed: around u then v the face looks to the far side.
        faces[n++] = is_far ? Face{corner, corner + u, corner + u + v, corner + v}
                            : Face{corner, corner + v, corner + u + v, corner + u};
      }
    }
  }
  return faces;
}
constexpr auto k_outer_faces = make_outer_faces();

double triple(const Vec3& a, const Vec3& b, const Vec3& c) { return dot(a, cross(b, c)); }

}  // namespace

RubberState rubber_state_of(const Simulation& s) {
  RubberState out;
  for (int id = 0; id < s.balls.n_rubber_balls(); ++id) {
    out.ball_position.push_back(s.balls.position(s.balls.index_of_id(id)));
  }
  for (int g = 0; g < s.balls.n_grains; ++g) {
    out.rest_length.push_back(s.rubber_of_grain(g).bond.rest_length);
    for (int b = 0; b < k_grain_bonds; ++b) {
      const BondReading bond = read_bond(s, g, b);
      out.bond_length.push_back(bond.length);
      out.bond_normal_force.push_back(0.0 - bond.normal_force);
      out.bond_shear_force.push_back(norm(bond.shear));
      out.bond_moment.push_back(norm(bond.moment));
      out.is_broken.push_back(bond.is_broken ? 1 : 0);
    }
  }
  return out;
}

Distribution distribution_of(std::vector<double> values) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  if (values.empty()) return {nan, nan, nan, nan, nan};
  Distribution out;
  const auto n = static_cast<double>(values.size());
  for (const double v : values) out.mean += v;
  out.mean /= n;
  for (const double v : values) out.deviation += (v - out.mean) * (v - out.mean);
  out.deviation = std::sqrt(out.deviation / n);
  const auto quantile = [&](double p) {
    const auto at = static_cast<std::ptrdiff_t>(p * (n - 1.0));
    std::nth_element(values.begin(), values.begin() + at, values.end());
    return values[static_cast<std::size_t>(at)];
  };
  out.p05 = quantile(0.05);
  out.p50 = quantile(0.50);
  out.p95 = quantile(0.95);
  return out;
}

double grain_volume(std::span<const Vec3> balls) {
  constexpr std::size_t k_middle = 13;  // differences to it keep the digits
  double sum = 0.0;
  for (const Face& face : k_outer_faces) {
    std::array<Vec3, 4> r;
    for (std::size_t k = 0; k < 4; ++k) r[k] = balls[face[k]] - balls[k_middle];
    sum += 0.5 *
           (triple(r[0], r[1], r[2]) + triple(r[0], r[2], r[3]) + triple(r[0], r[1], r[3]) + triple(r[1], r[2], r[3]));
  }
  return sum / 6.0;
}

double grain_aspect_ratio(std::span<const Vec3> balls) {
  Vec3 mean;
  for (const Vec3& x : balls) mean += x;
  mean = mean * (1.0 / static_cast<double>(balls.size()));
  Tensor3 spread;
  for (const Vec3& x : balls) spread += outer(x - mean, x - mean);
  const std::array<double, 3> principal = principal_values(spread);
  return std::sqrt(principal[2] / principal[0]);
}

int closed_second_neighbours(std::span<const Vec3> balls, double rest_length) {
  int closed = 0;
  for (const SlotPair& pair : k_second_neighbours_of_grain) {
    const Vec3 d = balls[pair.j] - balls[pair.i];
    if (dot(d, d) < rest_length * rest_length) ++closed;
  }
  return closed;
}

namespace {

/// strain: of all bonds that are not broken.
void take_compressed_bonds(std::span<const double> strain, RubberReport& out) {
  double compressed = 0.0, sum = 0.0;
  for (const double e : strain) {
    if (!(e > 0.0)) continue;
    sum += e;
    compressed += 1.0;
  }
  out.bond_strain_compressed = sum / compressed;
  out.bonds_compressed = compressed / static_cast<double>(strain.size());
}

}  // namespace

NeighbourStrain strain_by_neighbour(std::span<const double> grain_bond_strain, const ContactNetwork& network) {
  std::vector<std::pair<int, int>> pairs;  // rubber grain and what it touches
  const auto n_grains = static_cast<int>(grain_bond_strain.size());
  for (const Contact& c : network.contacts) {
    if (c.body_i < n_grains) pairs.emplace_back(c.body_i, c.body_j);
    if (c.body_j < n_grains) pairs.emplace_back(c.body_j, c.body_i);
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  NeighbourStrain sum, count;
  for (const auto& [grain, other] : pairs) {
    const bool is_rubber = network.body_material[static_cast<std::size_t>(other)] == k_rubber;
    (is_rubber ? sum.at_rubber : sum.at_gravel) += grain_bond_strain[static_cast<std::size_t>(grain)];
    (is_rubber ? count.at_rubber : count.at_gravel) += 1.0;
  }
  return {sum.at_gravel / count.at_gravel, sum.at_rubber / count.at_rubber};
}

Tensor3 deformation_of(std::span<const Vec3> balls, double rest_length) {
  const double a = 2.0 * rest_length / std::numbers::sqrt3;
  Vec3 mean;
  for (const Vec3& x : balls) mean += x * (1.0 / k_grain_balls);
  Tensor3 product;
  double spread = 0.0;
  for (int slot = 0; slot < k_grain_balls; ++slot) {
    const Vec3 at_rest = grain_site(slot) * a;
    product += outer(balls[static_cast<std::size_t>(slot)] - mean, at_rest);
    spread += at_rest.x * at_rest.x;
  }
  return product * (1.0 / spread);
}

double strain_along(const Tensor3& deformation, const Vec3& m) { return 1.0 - 1.0 / norm(solve(deformation, m)); }

double mean_strain_along(const RubberState& state, const Vec3& m) {
  double sum = 0.0;
  for (std::size_t g = 0; g < state.n_grains(); ++g) {
    const auto balls = std::span(state.ball_position).subspan(g * k_grain_balls, k_grain_balls);
    sum += strain_along(deformation_of(balls, state.rest_length[g]), m);
  }
  return sum / static_cast<double>(state.n_grains());
}

RubberReport rubber_report(const RubberState& state) {
  std::vector<double> bond_strain, volume_strain, aspect_ratio;
  RubberReport out;
  double bonds = 0.0;
  std::vector<double> whole_bonds(state.n_grains());
  out.grain_bond_strain.resize(state.n_grains());
  for (std::size_t b = 0; b < state.bond_length.size(); ++b) {
    if (state.is_broken[b] != 0) continue;
    bond_strain.push_back(1.0 - state.bond_length[b] / state.rest_length[b / k_grain_bonds]);
    out.grain_bond_strain[b / k_grain_bonds] += bond_strain.back();
    whole_bonds[b / k_grain_bonds] += 1.0;
    out.bond_force += state.bond_normal_force[b];
    out.bond_force_size += std::fabs(state.bond_normal_force[b]);
    out.bond_moment += state.bond_moment[b];
    bonds += 1.0;
  }
  const std::size_t n_grains = state.n_grains();
  for (std::size_t g = 0; g < n_grains; ++g) {
    const double side = 4.0 * state.rest_length[g] / std::numbers::sqrt3, rest_volume = side * side * side;
    const auto balls = std::span(state.ball_position).subspan(g * k_grain_balls, k_grain_balls);
    volume_strain.push_back(1.0 - grain_volume(balls) / rest_volume);
    aspect_ratio.push_back(grain_aspect_ratio(balls));
    out.closed_second_neighbours += closed_second_neighbours(balls, state.rest_length[g]);
  }
  out.bond_force /= bonds;
  out.bond_force_size /= bonds;
  out.bond_moment /= bonds;
  out.closed_second_neighbours /= static_cast<double>(n_grains);
  for (std::size_t g = 0; g < n_grains; ++g) out.grain_bond_strain[g] /= whole_bonds[g];
  take_compressed_bonds(bond_strain, out);
  out.bond_strain = distribution_of(std::move(bond_strain));
  out.volume_strain = distribution_of(std::move(volume_strain));
  out.aspect_ratio = distribution_of(std::move(aspect_ratio));
  return out;
}

}  // namespace dem
