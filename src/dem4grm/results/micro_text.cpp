// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/results/micro_text.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "dem4grm/results/histogram_curves.hpp"
#include "dem4grm/results/micro_table.hpp"
#include "dem4grm/results/output_file.hpp"

namespace dem {
namespace {

constexpr double k_in_degrees = 180.0 / std::numbers::pi;

std::string number_text(double value) {
  if (std::isnan(value)) return "-";
  const bool is_whole = std::fabs(value) < 1e7 && value == std::floor(value);
  return is_whole ? fmt::format("{:.0f}", value) : fmt::format("{:.4g}", value);
}

/// "[0.1, 0.2]"
std::string band_text(const Band& band, double scale) {
  return std::isnan(band.low) ? "-" : fmt::format("[{:.3g}, {:.3g}]", band.low * scale, band.high * scale);
}

struct BandQuantity {
  const char* name;  ///< of the SetQuantity that it belongs to
  Band AnisotropyBands::*band;
  double scale = 1.0;
};
constexpr std::array<BandQuantity, 8> k_bands{{
    {"a", &AnisotropyBands::fabric_amplitude},
    {"theta_a", &AnisotropyBands::fabric_direction, k_in_degrees},
    {"a_n", &AnisotropyBands::normal_amplitude},
    {"theta_n", &AnisotropyBands::normal_direction, k_in_degrees},
    {"a_t", &AnisotropyBands::shear_amplitude},
    {"theta_t", &AnisotropyBands::shear_direction, k_in_degrees},
    {"a_s", &AnisotropyBands::signed_shear_amplitude},
    {"theta_s", &AnisotropyBands::signed_shear_direction, k_in_degrees},
}};

std::string unit_text(const char* unit) {
  const std::string text = unit;
  if (text == "1") return "";
  return text == "mN_m" ? "mN m" : text;
}

JsonList tensor_as_json(const Tensor3& t) {
  JsonList rows;
  for (std::size_t i = 0; i < 3; ++i) rows.emplace_back(JsonList{t(i, 0), t(i, 1), t(i, 2)});
  return rows;
}

JsonObject bands_as_json(const AnisotropyBands& bands) {
  JsonObject out;
  for (const BandQuantity& q : k_bands) {
    const Band& band = bands.*q.band;
    out.push_back(
        {name_with_unit(q.name, q.scale == 1.0 ? "1" : "deg"), JsonList{band.low * q.scale, band.high * q.scale}});
  }
  return out;
}

JsonObject options_as_json(const MicroOptions& o) {
  return {{"bin_width_deg", o.bin_width() * k_in_degrees},
          {"level", o.level == ContactLevel::contact ? "contact" : "pair"},
          {"mean", o.force_mean == ForceMean::orientations ? "orientations" : "contacts"},
          {"strong", o.strong == StrongMeasure::normal_force ? "normal" : "magnitude"},
          {"projection", o.projection == Projection::all ? "all" : "near-plane"},
          {"resamples", o.resamples},
          {"seed", static_cast<std::int64_t>(o.seed)}};
}

void append_histogram(std::string& text, const PolarHistogram& h, const char* set) {
  const HistogramCurves curves = histogram_curves(h);
  for (std::size_t k = 0; k < curves.angle_deg.size(); ++k) {
    text += set;
    for (const std::vector<double>* column :
         {&curves.angle_deg, &curves.contacts, &curves.density, &curves.density_fit, &curves.normal_force,
          &curves.normal_force_fit, &curves.shear_force, &curves.shear_force_fit, &curves.signed_shear,
          &curves.signed_shear_fit}) {
      text += ',';
      if (!std::isnan((*column)[k])) append_number(text, (*column)[k]);
    }
    text += '\n';
  }
}

}  // namespace

std::string options_text(const MicroOptions& o) {
  return fmt::format("{}, bins of {:.4g} deg{}, f0 over {}, strong above the mean {}",
                     o.level == ContactLevel::contact ? "contacts" : "contacts merged to pairs of bodies",
                     o.bin_width() * k_in_degrees, o.projection == Projection::all ? "" : ", |n_y| < 0.5 only",
                     o.force_mean == ForceMean::orientations ? "orientations" : "contacts",
                     o.strong == StrongMeasure::normal_force ? "normal force" : "force");
}

std::string micro_table_text(const MicroAnalysis& analysis) {
  std::string text = fmt::format("  {:<26}", "");
  for (const char* set : k_set_names) text += fmt::format(" {:>14}", set);
  text += '\n';
  const auto line = [&](const std::string& name, const char* unit, const auto& value_of) {
    text += fmt::format("  {:<26}", name);
    for (std::size_t set = 0; set < k_contact_sets; ++set) text += fmt::format(" {:>14}", value_of(set));
    const std::string shown = unit_text(unit);
    text += shown.empty() ? "\n" : fmt::format(" {}\n", shown);
  };
  for (const SetQuantity& q : set_quantities()) {
    line(q.name, q.unit, [&](std::size_t set) { return number_text(value_in_unit(q, analysis.numbers.sets[set])); });
    if (analysis.options.resamples == 0) continue;
    for (const BandQuantity& b : k_bands) {
      if (std::string(b.name) != q.name) continue;
      line("  95 % band", q.unit, [&](std::size_t set) { return band_text(analysis.bands[set].*b.band, b.scale); });
    }
  }
  for (const StateQuantity& q : state_quantities()) {
    const double value = value_in_unit(q, analysis.numbers);
    const bool is_zone = q.value == &MicroNumbers::zone;
    const std::string unit = unit_text(q.unit);
    text += fmt::format("  {:<26} {:>14}{}{}\n", q.name, is_zone ? zone_name(value) : number_text(value),
                        unit.empty() ? "" : " ", unit);
  }
  return text;
}

JsonObject micro_as_json(const StoredMicroState& stored, const MicroAnalysis& analysis) {
  JsonObject out{{"state", stored.name},
                 {"displacement_mm", stored.displacement * 1e3},
                 {"state_hash", stored.state_hash},
                 {"options", options_as_json(analysis.options)}};
  JsonObject sets;
  for (std::size_t set = 0; set < k_contact_sets; ++set) {
    JsonObject of_set;
    for (const SetQuantity& q : set_quantities()) {
      of_set.push_back({name_with_unit(q.name, q.unit), value_in_unit(q, analysis.numbers.sets[set])});
    }
    if (analysis.options.resamples > 0) of_set.push_back({"bands_95", bands_as_json(analysis.bands[set])});
    sets.push_back({k_set_names[set], std::move(of_set)});
  }
  out.push_back({"sets", std::move(sets)});
  for (const StateQuantity& q : state_quantities()) {
    out.push_back({name_with_unit(q.name, q.unit), value_in_unit(q, analysis.numbers)});
  }
  out.push_back({"zone_name", zone_name(analysis.numbers.zone)});
  out.push_back(
      {"is_fabric_isotropic", analysis.numbers.of_all().fabric_amplitude < analysis.numbers.of_all().fabric_noise});
  out.push_back({"fabric_tensor", tensor_as_json(analysis.fabric)});
  out.push_back({"fabric_tensor_strong", tensor_as_json(analysis.strong_fabric)});
  out.push_back({"fabric_tensor_weak", tensor_as_json(analysis.weak_fabric)});
  return out;
}

std::string histogram_csv(const MicroAnalysis& analysis) {
  std::string text =
      "set,angle_deg,contacts,density_per_rad,density_fit_per_rad,normal_force_N,normal_force_fit_N,shear_force_N,"
      "shear_force_fit_N,signed_shear_force_N,signed_shear_force_fit_N\n";
  for (std::size_t set = 0; set < k_contact_sets; ++set) {
    append_histogram(text, analysis.histograms[set], k_set_names[set]);
  }
  return text;
}

}  // namespace dem
