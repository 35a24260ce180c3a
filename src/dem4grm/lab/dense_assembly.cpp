// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/lab/dense_assembly.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "dem4grm/core/error.hpp"
#include "dem4grm/core/random.hpp"
#include "dem4grm/core/space_curve.hpp"
#include "dem4grm/walls/shear_box.hpp"

namespace dem {
namespace {

constexpr double k_jitter = 0.2;  // of the cell

/// Places [n] in the order of a curve: neighbours are side by side, as in a specimen.
std::vector<Vec3> lattice(std::size_t n, double cell, double length, double width, std::uint64_t seed) {
  const auto along = [&](double size) { return std::max<std::size_t>(1, static_cast<std::size_t>(size / cell)); };
  const std::size_t nx = along(length), ny = along(width);
  std::vector<Vec3> places;
  places.reserve(n);
  for (std::size_t k = 0; k < n; ++k) {
    RandomSequence random(seed, RandomStream::grain_position, k);
    const std::size_t row = k / nx, layer = row / ny;
    const Vec3 at{static_cast<double>(k % nx), static_cast<double>(row % ny), static_cast<double>(layer)};
    const auto jitter = [&] { return 0.5 + k_jitter * random.uniform(-0.5, 0.5); };
    const Vec3 offset{jitter(), jitter(), jitter()};
    places.push_back((at + offset) * cell);
  }
  sort_along_curve(places, [](const Vec3& p) { return p; });
  return places;
}

}  // namespace

DenseAssembly make_dense_assembly(const GrainList& grains, const Scene& materials, double length, double width,
                                  std::uint64_t seed) {
  const std::size_t n = grains.gravel.size() + static_cast<std::size_t>(grains.rubber_count);
  require(n > 0, "a dense assembly needs grains");
  const double cell = std::cbrt(k_dense_cell_volume * grains.solid_volume() / static_cast<double>(n));
  const std::vector<Vec3> places = lattice(n, cell, length, width, seed);
  DenseAssembly out;
  out.scene = materials;
  out.scene.shapes = grains.shapes;
  out.scene.rubber_ball_radius = grains.rubber_ball_radius;
  out.scene.rubber_ball_radii = grains.rubber_radii;
  // The two kinds are spread evenly over the places.
  std::size_t gravel = 0, rubber = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const Pose pose{places[k], RandomSequence(seed, RandomStream::grain_orientation, k).orientation()};
    out.height = std::max(out.height, places[k].z + 0.5 * cell);
    if ((k + 1) * grains.gravel.size() / n > gravel) {
      const GravelGrain& g = grains.gravel[gravel++];
      out.scene.clumps.push_back({g.shape, g.sieve_size, pose, k_gravel});
    } else {
      ++rubber;
      out.scene.grains.push_back(pose);
    }
  }
  BoxSettings box;
  box.length = length;
  box.width = width;
  box.height = box.upper_height = out.height;
  out.scene.wall_list = ShearBox(box, out.height).walls();
  return out;
}

}  // namespace dem
