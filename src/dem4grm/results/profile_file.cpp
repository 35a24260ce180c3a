// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/results/profile_file.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

#include "dem4grm/core/error.hpp"
#include "dem4grm/micro/rubber_strain.hpp"
#include "dem4grm/results/hdf5_handle.hpp"
#include "dem4grm/results/micro_state_file.hpp"
#include "dem4grm/results/results_file.hpp"
#include "dem4grm/results/stored_grains.hpp"
#include "dem4grm/specimen/sieve_analysis.hpp"

namespace dem {
namespace {

constexpr double k_to_degrees = 180.0 / std::numbers::pi;
using L = ProfileLayer;

struct LayerQuantity {
  const char* name;
  const char* unit;
  const char* description;
  double ProfileLayer::*value;
  double scale = 1.0;
};
constexpr std::array<LayerQuantity, 13> k_quantities{{
    {"low_mm", "mm", "lower border of the layer", &L::low, 1e3},
    {"high_mm", "mm", "upper border", &L::high, 1e3},
    {"grains", "1", "grains with their centre in the layer", &L::grains},
    {"displacement_x_mm", "mm", "mean displacement of them along the shear direction", &L::displacement_x, 1e3},
    {"displacement_z_mm", "mm", "mean displacement of them, up positive", &L::displacement_z, 1e3},
    {"rotation_deg", "deg", "mean turn of them about y", &L::rotation, k_to_degrees},
    {"rotation_size_deg", "deg", "mean angle of the whole turn", &L::rotation_size, k_to_degrees},
    {"rotation_gravel_deg", "deg", "mean turn about y of the gravel alone", &L::rotation_gravel, k_to_degrees},
    {"rotation_rubber_deg", "deg", "mean turn about y of the rubber alone", &L::rotation_rubber, k_to_degrees},
    {"void_ratio", "1", "nominal area times thickness over the solid in it, less 1", &L::void_ratio},
    {"rubber_content", "1", "rubber in the solid of the layer", &L::rubber_content},
    {"contacts", "1", "contacts between grains", &L::contacts},
    {"strong_share", "1", "share of them above the mean normal force of all contacts", &L::strong_share},
}};

constexpr std::array<ColumnInfo, 1 + k_quantities.size()> make_columns() {
  std::array<ColumnInfo, 1 + k_quantities.size()> columns{};
  columns[0] = {"shear_displacement_mm", "mm", "displacement of the halves against each other, of the state"};
  for (std::size_t k = 0; k < k_quantities.size(); ++k) {
    columns[k + 1] = {k_quantities[k].name, k_quantities[k].unit, k_quantities[k].description};
  }
  return columns;
}
constexpr auto k_columns = make_columns();

std::vector<Quaternion> read_orientations(const hdf5::Handle& frame, const RubberState& rubber) {
  std::vector<Quaternion> out;
  for (std::size_t g = 0; g < rubber.n_grains(); ++g) {
    out.push_back(grain_orientation(std::span(rubber.ball_position).subspan(g * k_grain_balls, k_grain_balls),
                                    rubber.rest_length[g]));
  }
  const std::vector<double> q = hdf5::read_dataset(hdf5::open_group(frame, "clumps"), "orientation");
  for (std::size_t k = 0; k + 3 < q.size(); k += 4) out.push_back({q[k], q[k + 1], q[k + 2], q[k + 3]});
  return out;
}

ProfileState read_state_of(const std::filesystem::path& results, const StoredFrame& stored) {
  StoredMicroState micro = read_micro_state(results, stored.displacement);
  const hdf5::Handle file = open_results(results);
  const hdf5::Handle frame = hdf5::open_group(hdf5::open_group(file, "frames"), stored.name);
  ProfileState out{stored.displacement, read_packing(frame), std::move(micro.state.network), {}};
  out.orientation = read_orientations(frame, micro.state.rubber);
  if (out.orientation.size() != out.network.body_position.size()) {
    throw IoError("the orientations of the state do not fit its grains");
  }
  return out;
}

JsonObject band_as_json(const StateProfile& p) {
  const ShearBand& b = p.band;
  return {{"displacement_mm", p.displacement * 1e3},
          {"thickness_mm", b.thickness * 1e3},
          {"thickness_error_mm", b.thickness_error * 1e3},
          {"centre_mm", b.centre * 1e3},
          {"centre_error_mm", b.centre_error * 1e3},
          {"slip_mm", b.slip * 1e3},
          {"scatter_mm", b.scatter * 1e3}};
}

}  // namespace

std::vector<StateProfile> read_profiles(const std::filesystem::path& results, int layers) {
  const StoredResults outline = read_outline(results);
  const StoredGrains first = read_stored_grains(results);  // refuses other tests and files without a state
  const double density = first.test.rubber.density, solid_density = first.test.rubber_solid_density;
  const ProfileOptions options{layers, mean_size(measure_grains(first.packing, density, solid_density)),
                               density / solid_density};
  std::vector<StateProfile> out;
  try {
    const ProfileState start = read_state_of(results, outline.frames.front());
    for (const StoredFrame& frame : outline.frames) {
      out.push_back(height_profile(start, read_state_of(results, frame), options));
    }
  } catch (const IoError& e) {
    const std::string shown = results.string();
    if (std::string_view(e.what()).starts_with(shown)) throw;
    throw IoError(fmt::format("{}: {}", shown, e.what()));
  }
  return out;
}

std::span<const ColumnInfo> profile_columns() { return k_columns; }

std::vector<double> profile_values(const StateProfile& profile, const ProfileLayer& layer) {
  std::vector<double> values{profile.displacement * 1e3};
  for (const LayerQuantity& q : k_quantities) values.push_back(without_sign_of_nan(layer.*q.value * q.scale));
  return values;
}

void append_profiles(TableFile& table, std::span<const StateProfile> profiles) {
  for (const StateProfile& state : profiles) {
    for (const ProfileLayer& layer : state.layers) table.append(profile_values(state, layer));
  }
  table.sync();
}

JsonList shear_bands_as_json(std::span<const StateProfile> profiles) {
  JsonList list;
  for (const StateProfile& p : profiles) list.emplace_back(band_as_json(p));
  return list;
}

std::string profile_text(const StateProfile& profile) {
  std::string text = fmt::format(
      "{:>13} {:>7} {:>8} {:>8} {:>9} {:>7} {:>7} {:>9} {:>7}\n{:>13} {:>7} {:>8} {:>8} {:>9}\n", "height", "grains",
      "u_x", "u_z", "rotation", "e", "rubber", "contacts", "strong", "mm", "", "mm", "mm", "degrees");
  for (auto layer = profile.layers.rbegin(); layer != profile.layers.rend(); ++layer) {
    text += fmt::format(
        "{:>5.1f} to {:>4.1f} {:>7.0f} {:>8.3f} {:>8.3f} {:>9.2f} {:>7.3f} {:>7.3f} {:>9.0f} {:>7.3f}\n",
        layer->low * 1e3, layer->high * 1e3, layer->grains, layer->displacement_x * 1e3, layer->displacement_z * 1e3,
        layer->rotation * k_to_degrees, layer->void_ratio, layer->rubber_content, layer->contacts, layer->strong_share);
  }
  const ShearBand& b = profile.band;
  if (std::isnan(b.thickness)) return text + "no shear band to be found\n";
  return text +
         fmt::format("shear band {:.1f} +- {:.1f} mm thick, middle at {:.1f} +- {:.1f} mm; {:.3f} mm of slip in it\n",
                     b.thickness * 1e3, b.thickness_error * 1e3, b.centre * 1e3, b.centre_error * 1e3,
                     std::fabs(b.slip) * 1e3);
}

JsonObject profiles_as_json(std::span<const StateProfile> profiles) {
  JsonList states;
  for (const StateProfile& p : profiles) {
    JsonObject state{{"displacement_mm", p.displacement * 1e3}, {"shear_band", band_as_json(p)}};
    for (const LayerQuantity& q : k_quantities) {
      JsonList column;
      for (const ProfileLayer& layer : p.layers) column.emplace_back(without_sign_of_nan(layer.*q.value * q.scale));
      state.push_back({q.name, std::move(column)});
    }
    states.emplace_back(std::move(state));
  }
  return {{"states", std::move(states)}};
}

}  // namespace dem
