// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/micro/height_profile.hpp"

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "dem4grm/core/bounds.hpp"
#include "dem4grm/core/error.hpp"
#include "dem4grm/micro/rubber_strain.hpp"
#include "dem4grm/micro/strong_network.hpp"
#include "dem4grm/specimen/solid_columns.hpp"

namespace dem {
namespace {

constexpr int k_fewest_layers = 4;
/// A step of the displacements below this share of that of the halves is no band.
constexpr double k_least_slip = 0.05;
constexpr double k_least_slip_length = 1e-6;  // m; and nothing is a band that is smaller

/// Adds pieces of columns up in layers.
class LayerCollector {
 public:
  LayerCollector(const Bounds& room, int layers, double mean_size)
      : x_(room.low.x, room.high.x, 1, k_column_spacing * mean_size),
        y_(room.low.y, room.high.y, 1, k_column_spacing * mean_size),
        low_(room.low.z),
        thickness_((room.high.z - room.low.z) / layers),
        layers_(static_cast<std::size_t>(layers)) {}

  [[nodiscard]] const ColumnAxis& x() const { return x_; }
  [[nodiscard]] const ColumnAxis& y() const { return y_; }

  void add(int /*i*/, int /*j*/, double a, double b, double fill, double Cell::*material) {
    const auto n = static_cast<int>(layers_.size());
    const int first = std::clamp(static_cast<int>((a - low_) / thickness_), 0, n - 1);
    const int last = std::clamp(static_cast<int>((b - low_) / thickness_), 0, n - 1);
    for (int k = first; k <= last; ++k) {
      const double length = shared(a, b, low_ + k * thickness_, low_ + (k + 1) * thickness_);
      layers_[static_cast<std::size_t>(k)].*material += x_.step * y_.step * fill * length;
    }
  }

  [[nodiscard]] const std::vector<Cell>& layers() const { return layers_; }

 private:
  ColumnAxis x_, y_;
  double low_, thickness_;
  std::vector<Cell> layers_;
};

int number_of_layers(const ProfileOptions& options, double height) {
  if (options.layers > 0) return options.layers;
  return std::max(k_fewest_layers, static_cast<int>(std::lround(height / options.mean_size)));
}

/// All that the grains reach, also where the halves have parted; between the plates along z.
Bounds reach_of(const Packing& packing, double height) {
  Bounds room{packing.position.front(), packing.position.front()};
  for (std::size_t k = 0; k < packing.position.size(); ++k) {
    const Vec3& p = packing.position[k];
    const double r = packing.radius[k];
    room.low = {std::min(room.low.x, p.x - r), std::min(room.low.y, p.y - r), 0.0};
    room.high = {std::max(room.high.x, p.x + r), std::max(room.high.y, p.y + r), height};
  }
  return room;
}

void take_solid(const ProfileState& now, const ProfileOptions& options, std::vector<ProfileLayer>& layers) {
  LayerCollector collector(reach_of(now.packing, now.network.box.height), static_cast<int>(layers.size()),
                           options.mean_size);
  add_solid(now.packing, options.rubber_fill, collector);
  for (std::size_t k = 0; k < layers.size(); ++k) {
    const Cell& cell = collector.layers()[k];
    const double solid = cell.gravel + cell.rubber;
    layers[k].void_ratio = now.network.box.area * (layers[k].high - layers[k].low) / solid - 1.0;
    layers[k].rubber_content = cell.rubber / solid;
  }
}

std::size_t layer_at(const std::vector<ProfileLayer>& layers, double z) {
  const double thickness = layers.front().high - layers.front().low;
  const auto last = static_cast<int>(layers.size()) - 1;
  return static_cast<std::size_t>(std::clamp(static_cast<int>(z / thickness), 0, last));
}

void take_grains(const ProfileState& start, const ProfileState& now, std::vector<ProfileLayer>& layers) {
  std::vector<double> gravel(layers.size()), rubber(layers.size());
  for (std::size_t body = 0; body < now.network.body_position.size(); ++body) {
    const Vec3& at = now.network.body_position[body];
    const Vec3 moved = at - start.network.body_position[body];
    const Vec3 turn = rotation_between(start.orientation[body], now.orientation[body]);
    const std::size_t k = layer_at(layers, at.z);
    ProfileLayer& layer = layers[k];
    const bool is_rubber = now.network.body_material[body] == k_rubber;
    layer.grains += 1.0;
    layer.displacement_x += moved.x;
    layer.displacement_z += moved.z;
    layer.rotation += turn.y;
    layer.rotation_size += norm(turn);
    (is_rubber ? layer.rotation_rubber : layer.rotation_gravel) += turn.y;
    (is_rubber ? rubber : gravel)[k] += 1.0;
  }
  for (std::size_t k = 0; k < layers.size(); ++k) {
    ProfileLayer& layer = layers[k];
    for (double* sum : {&layer.displacement_x, &layer.displacement_z, &layer.rotation, &layer.rotation_size}) {
      *sum /= layer.grains;
    }
    layer.rotation_gravel /= gravel[k];
    layer.rotation_rubber /= rubber[k];
  }
}

void take_contacts(const ContactNetwork& network, std::vector<ProfileLayer>& layers) {
  const std::vector<unsigned char> is_strong = strong_contacts(network.contacts, StrongMeasure::normal_force);
  for (std::size_t c = 0; c < network.contacts.size(); ++c) {
    ProfileLayer& layer = layers[layer_at(layers, network.contacts[c].point.z)];
    layer.contacts += 1.0;
    layer.strong_share += is_strong[c];
  }
  for (ProfileLayer& layer : layers) layer.strong_share /= layer.contacts;
}

ShearBand band_of(const ProfileState& start, const ProfileState& now) {
  const std::vector<Vec3>& before = start.network.body_position;
  const auto by_width = [](const Vec3& a, const Vec3& b) { return a.y < b.y; };
  const auto [low, high] = std::minmax_element(before.begin(), before.end(), by_width);
  const double width = high->y - low->y;
  std::vector<BandSample> grains;
  for (std::size_t body = 0; body < before.size(); ++body) {
    const Vec3& at = now.network.body_position[body];
    const auto slice = static_cast<int>((before[body].y - low->y) / width * k_band_slices);
    grains.push_back({at.z, at.x - before[body].x, std::clamp(slice, 0, k_band_slices - 1)});
  }
  return fit_shear_band(grains, now.network.box.height,
                        std::max(k_least_slip_length, k_least_slip * (now.displacement - start.displacement)));
}

}  // namespace

Quaternion grain_orientation(std::span<const Vec3> balls, double rest_length) {
  const Tensor3 f = deformation_of(balls, rest_length);
  Eigen::Matrix3d m;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) m(i, j) = f(static_cast<std::size_t>(i), static_cast<std::size_t>(j));
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> parts(m, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Quaterniond q(Eigen::Matrix3d(parts.matrixU() * parts.matrixV().transpose()));
  return normalized({q.w(), q.x(), q.y(), q.z()});
}

Vec3 rotation_between(const Quaternion& from, const Quaternion& to) {
  Quaternion q = to * conjugate(from);
  if (q.w < 0.0) q = {-q.w, -q.x, -q.y, -q.z};  // the shorter way round
  const Vec3 axis{q.x, q.y, q.z};
  const double sine = norm(axis);
  return sine > 0.0 ? axis * (2.0 * std::atan2(sine, q.w) / sine) : Vec3{};
}

StateProfile height_profile(const ProfileState& start, const ProfileState& now, const ProfileOptions& options) {
  const std::size_t n_bodies = now.network.body_position.size();
  require(n_bodies > 0 && start.network.body_position.size() == n_bodies && start.orientation.size() == n_bodies &&
              now.orientation.size() == n_bodies,
          "both states of a profile hold the same grains");
  StateProfile out;
  out.displacement = now.displacement;
  const double height = now.network.box.height;
  const int n = number_of_layers(options, start.network.box.height);
  for (int k = 0; k < n; ++k) {
    ProfileLayer layer;
    layer.low = height * k / n;
    layer.high = height * (k + 1) / n;
    out.layers.push_back(layer);
  }
  take_grains(start, now, out.layers);
  take_solid(now, options, out.layers);
  take_contacts(now.network, out.layers);
  out.band = band_of(start, now);
  return out;
}

}  // namespace dem
