// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/specimen/sieve_analysis.hpp"

#include <algorithm>
#include <cmath>

#include "dem4grm/core/error.hpp"
#include "dem4grm/grains/clump_mass_properties.hpp"
#include "dem4grm/grains/clump_sieve.hpp"
#include "dem4grm/grains/rubber_size.hpp"
#include "dem4grm/specimen/grading.hpp"

namespace dem {
namespace {

// Positions are rounded at 1e-14 of a grain; shapes that differ less than this are one shape.
constexpr double k_alike = 1e-9;
// A grain whose size is the opening passes it; sizes are rounded to nine digits.
constexpr double k_fits = 1e-8;

/// Distances and radii of pebbles over the radius of the first one: equal for clumps of equal shape, whatever their
/// size, place and orientation. Mirror images are alike too, and pass the same openings.
std::vector<double> signature_of(std::span<const Pebble> pebbles) {
  std::vector<double> signature;
  const double unit = 1.0 / pebbles.front().radius;
  for (std::size_t i = 0; i < pebbles.size(); ++i) {
    signature.push_back(pebbles[i].radius * unit);
    for (std::size_t j = 0; j < i; ++j) {
      signature.push_back(norm(pebbles[i].position - pebbles[j].position) * unit);
    }
  }
  return signature;
}

bool are_alike(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(), [](double p, double q) {
           return std::abs(p - q) <= k_alike * (std::abs(p) + 1.0);
         });
}

/// Measures clumps and remembers every shape that it has seen.
class Caliper {
 public:
  MeasuredGrain measure(std::span<const Pebble> pebbles) {
    const double unit = pebbles.front().radius;
    const std::vector<double> signature = signature_of(pebbles);
    auto known =
        std::find_if(known_.begin(), known_.end(), [&](const Known& k) { return are_alike(k.signature, signature); });
    if (known == known_.end()) {
      known_.push_back({signature, measure_unit(pebbles, unit)});
      known = std::prev(known_.end());
    }
    return {known->unit_grain.size * unit, known->unit_grain.volume * unit * unit * unit};
  }

 private:
  struct Known {
    std::vector<double> signature;
    MeasuredGrain unit_grain;  ///< at a first radius of 1
  };

  static MeasuredGrain measure_unit(std::span<const Pebble> pebbles, double unit) {
    std::vector<Pebble> scaled;
    for (const Pebble& p : pebbles) {
      scaled.push_back({(p.position - pebbles.front().position) * (1.0 / unit), p.radius / unit});
    }
    return {smallest_square_opening(scaled), union_properties(scaled).volume};
  }

  std::vector<Known> known_;
};

double volume_of(std::span<const MeasuredGrain> grains) {
  double sum = 0.0;
  for (const MeasuredGrain& grain : grains) sum += grain.volume;
  return sum;
}

SieveColumn column_of(std::span<const MeasuredGrain> grains, const Grading& asked, std::span<const double> openings) {
  SieveColumn column;
  if (grains.empty()) return column;
  for (const double opening : openings) {
    column.measured.push_back(share_passing(grains, opening));
    column.asked.push_back(passing_at_size(asked, opening));
  }
  return column;
}

/// Share of the mass that is rubber, from its share of the volume.
double rubber_share_of_mass(double rubber_content, const SieveInput& input) {
  const double rubber = rubber_content * input.solid_density, gravel = (1.0 - rubber_content) * input.gravel_density;
  return rubber / (rubber + gravel);
}

std::vector<double> mixed(const std::vector<double>& gravel, const std::vector<double>& rubber, double rubber_share) {
  std::vector<double> both(gravel.size());
  for (std::size_t k = 0; k < both.size(); ++k) both[k] = (1.0 - rubber_share) * gravel[k] + rubber_share * rubber[k];
  return both;
}

}  // namespace

MeasuredGrains measure_grains(const Packing& packing, double ball_density, double solid_density) {
  MeasuredGrains grains;
  for (int g = 0; g < packing.n_rubber_grains; ++g) {
    const double r = packing.radius[static_cast<std::size_t>(g * k_grain_balls)];
    grains.rubber.push_back(
        {rubber_grain_size(r, ball_density, solid_density), rubber_solid_volume(r, ball_density, solid_density)});
  }
  Caliper caliper;
  for_each_clump(packing, [&](std::span<const Pebble> pebbles) { grains.gravel.push_back(caliper.measure(pebbles)); });
  return grains;
}

double mean_size(const MeasuredGrains& grains) {
  double all = 0.0, sum = 0.0;
  for (const auto* of_material : {&grains.gravel, &grains.rubber}) {
    for (const MeasuredGrain& grain : *of_material) {
      all += grain.volume;
      sum += grain.volume * grain.size;
    }
  }
  return all > 0.0 ? sum / all : 0.0;
}

double share_passing(std::span<const MeasuredGrain> grains, double opening) {
  double passing = 0.0, all = 0.0;
  for (const MeasuredGrain& grain : grains) {
    all += grain.volume;
    if (grain.size <= opening * (1.0 + k_fits)) passing += grain.volume;
  }
  return all > 0.0 ? passing / all : 0.0;
}

double opening_for_share(std::span<const MeasuredGrain> grains, double share) {
  if (grains.empty()) throw InputError("a sieve analysis needs grains");
  std::vector<MeasuredGrain> sorted(grains.begin(), grains.end());
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const MeasuredGrain& a, const MeasuredGrain& b) { return a.size < b.size; });
  const double all = volume_of(grains);
  double below = 0.0, last_middle = 0.0, last_size = sorted.front().size;
  for (const MeasuredGrain& grain : sorted) {
    const double middle = (below + 0.5 * grain.volume) / all;
    if (middle >= share) {
      if (below == 0.0) return grain.size;
      return last_size + (grain.size - last_size) * (share - last_middle) / (middle - last_middle);
    }
    below += grain.volume;
    last_middle = middle;
    last_size = grain.size;
  }
  return last_size;
}

double SieveColumn::largest_difference() const {
  double largest = 0.0;
  for (std::size_t k = 0; k < measured.size(); ++k) largest = std::max(largest, std::abs(measured[k] - asked[k]));
  return largest;
}

std::vector<double> usual_sieves(const MeasuredGrains& grains, const SieveInput& input) {
  std::vector<double> openings;
  const auto take = [&](const std::vector<MeasuredGrain>& of_material, const Grading& grading) {
    if (of_material.empty()) return;
    for (const GradingPoint& point : grading) openings.push_back(point.size);
  };
  take(grains.gravel, input.gravel);
  take(grains.rubber, input.rubber);
  return openings;
}

SieveTable sieve_table(const MeasuredGrains& grains, const SieveInput& input, std::vector<double> openings) {
  std::sort(openings.begin(), openings.end());
  openings.erase(std::unique(openings.begin(), openings.end()), openings.end());
  SieveTable table;
  table.gravel = column_of(grains.gravel, input.gravel, openings);
  table.rubber = column_of(grains.rubber, input.rubber, openings);
  if (table.gravel.is_there() && table.rubber.is_there()) {
    const double gravel = volume_of(grains.gravel), rubber = volume_of(grains.rubber);
    const double found = rubber / (rubber + gravel);
    const double asked = input.is_content_asked ? input.rubber_content : found;
    table.together.measured = mixed(table.gravel.measured, table.rubber.measured, rubber_share_of_mass(found, input));
    table.together.asked = mixed(table.gravel.asked, table.rubber.asked, rubber_share_of_mass(asked, input));
  }
  table.openings = std::move(openings);
  return table;
}

}  // namespace dem
