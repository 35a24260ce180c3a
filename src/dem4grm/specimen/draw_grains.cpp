// SPDX-License-Identifier: BSD-3-Clause
// From gradings, rubber content and box to the list of grains of a specimen.
#include "dem4grm/specimen/draw_grains.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "dem4grm/core/error.hpp"
#include "dem4grm/core/random.hpp"
#include "dem4grm/engine/scene.hpp"
#include "dem4grm/grains/rubber_size.hpp"
#include "dem4grm/specimen/grading.hpp"
#include "dem4grm/specimen/void_ratio_defaults.hpp"

namespace dem {
namespace {

constexpr double k_most_grains = 1e7;       // a slip in a unit must not fill the memory
constexpr double k_one_size_spread = 0.06;  // of D50; wider gradings of rubber get grains of several sizes

double cube(double x) { return x * x * x; }

/// Fewest letters to insert, delete or replace that turn one word into the other (Levenshtein 1966).
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = std::exchange(row[j], std::min({row[j] + 1, row[j - 1] + 1, replaced}));
    }
  }
  return row.back();
}

/// The shape of the user with that name, or nullptr.
const ClumpShape* find_own_shape(const SpecimenSettings& settings, std::string_view name) {
  const auto found = std::find_if(settings.clump_templates.begin(), settings.clump_templates.end(),
                                  [name](const ClumpShape& shape) { return shape.name == name; });
  return found == settings.clump_templates.end() ? nullptr : &*found;
}

std::string unknown_shape(const SpecimenSettings& settings, std::string_view name) {
  std::vector<std::string> known;
  for (const ClumpShape& shape : settings.clump_templates) known.push_back(shape.name);
  for (const ClumpTemplate& shape : standard_clump_templates()) known.push_back(shape.name);
  known.emplace_back("sphere");
  const auto nearest = std::min_element(known.begin(), known.end(), [&](const std::string& a, const std::string& b) {
    return edit_distance(a, name) < edit_distance(b, name);
  });
  return fmt::format("unknown clump shape '{}': did you mean '{}'? Known are {}", name, *nearest,
                     fmt::join(known, ", "));
}

/// Which materials the specimen holds.
struct Contents {
  bool has_gravel = false, has_rubber = false;
};

Contents contents_of(const SpecimenSettings& settings) {
  return {settings.gravel_clumps ? *settings.gravel_clumps > 0 : settings.rubber_content < 1.0,
          settings.rubber_grains ? *settings.rubber_grains > 0 : settings.rubber_content > 0.0};
}

void add_grading_problems(std::vector<std::string>& problems, const char* which, const Grading& grading) {
  for (const std::string& problem : grading_problems(grading)) {
    problems.push_back(fmt::format("{} grading: {}", which, problem));
  }
}

void check_counts(std::vector<std::string>& problems, const SpecimenSettings& settings) {
  const double content = settings.rubber_content;
  const int clumps = settings.gravel_clumps.value_or(0), grains = settings.rubber_grains.value_or(0);
  if (!(content >= 0.0 && content <= 1.0)) {
    problems.push_back(fmt::format("rubber content {} is outside 0 to 1 (0 to 100 %)", content));
  }
  if (clumps < 0 || grains < 0) problems.emplace_back("a number of grains cannot be negative");
  if (clumps > k_most_grains || grains > k_most_grains) {
    problems.push_back(fmt::format("more than {:.0f} grains", k_most_grains));
  }
  if (content <= 0.0 && grains > 0) problems.push_back(fmt::format("{} rubber grains at rubber content 0", grains));
  if (content >= 1.0 && clumps > 0) problems.push_back(fmt::format("{} gravel clumps at rubber content 1", clumps));
}

void check_shapes(std::vector<std::string>& problems, const SpecimenSettings& settings) {
  for (const std::string& name : settings.clump_shapes) {
    const bool is_known = find_own_shape(settings, name) != nullptr || find_clump_template(name) != nullptr;
    if (!is_known) problems.push_back(unknown_shape(settings, name));
  }
  if (settings.clump_shares.empty()) return;
  if (settings.clump_shares.size() != settings.clump_shapes.size()) {
    problems.push_back(fmt::format("{} shares of volume for {} clump shapes", settings.clump_shares.size(),
                                   settings.clump_shapes.size()));
  }
  for (const double share : settings.clump_shares) {
    if (!(std::isfinite(share) && share > 0.0)) {
      problems.push_back(fmt::format("the share {} of a clump shape is not positive", share));
    }
  }
}

void check_settings(const SpecimenSettings& settings, const BoxSettings& box) {
  std::vector<std::string> problems;
  check_counts(problems, settings);
  const Contents contents = contents_of(settings);
  if (!contents.has_gravel && !contents.has_rubber) problems.emplace_back("the specimen would have no grains");
  if (contents.has_gravel) {
    add_grading_problems(problems, "gravel", settings.gravel_grading);
    if (settings.clump_shapes.empty()) problems.emplace_back("no clump shape is named for the gravel");
  }
  check_shapes(problems, settings);
  if (contents.has_rubber) {
    add_grading_problems(problems, "rubber", settings.rubber_grading);
  }
  const double box_volume = box.length * box.width * box.height;
  if (!(std::isfinite(box_volume) && box.length > 0.0 && box.width > 0.0 && box.height > 0.0)) {
    problems.emplace_back("length, width and height of the box must be positive");
  }
  if (settings.expected_void_ratio && !(*settings.expected_void_ratio > 0.0)) {
    problems.push_back(fmt::format("expected void ratio {} must be positive", *settings.expected_void_ratio));
  }
  if (!problems.empty()) throw InputError(fmt::format("grains of the specimen: {}", fmt::join(problems, "\n  ")));
}

/// What a shape must hold for each unit of volume that all shapes hold in the mean: 1 for equal shares.
std::vector<double> share_weights(const SpecimenSettings& settings) {
  std::vector<double> weights(settings.clump_shapes.size(), 1.0);
  if (settings.clump_shares.empty()) return weights;
  double sum = 0.0;
  for (const double share : settings.clump_shares) sum += share;
  for (std::size_t k = 0; k < weights.size(); ++k) {
    weights[k] = settings.clump_shares[k] * static_cast<double>(weights.size()) / sum;
  }
  return weights;
}

/// Deals shapes so that each covers its share of the volume, whatever the size: random among the shapes that are less
/// than a mean grain ahead of the last, when the volume that a shape has is counted in units of its share. The dealing does not look at sizes, so that it is the same however the
/// sizes are scaled to reach a number of grains; neighbours on the mass axis are nearly equal, which keeps it fair.
class ShapeDealer {
 public:
  ShapeDealer(const std::vector<ClumpTemplate>& shapes, std::span<const double> weights, std::uint64_t seed)
      : shapes_(shapes), weights_(weights), dealt_(shapes.size(), 0.0), random_(seed, RandomStream::grain_shape, 0) {
    for (const ClumpTemplate& shape : shapes) mean_volume_ += shape.volume / static_cast<double>(shapes.size());
  }

  int next() {
    const double lead = *std::min_element(dealt_.begin(), dealt_.end()) + mean_volume_;
    candidates_.clear();
    for (std::size_t shape = 0; shape < shapes_.size(); ++shape) {
      if (dealt_[shape] < lead) candidates_.push_back(static_cast<int>(shape));
    }
    const auto pick = static_cast<std::size_t>(random_.uniform() * static_cast<double>(candidates_.size()));
    const auto shape = static_cast<std::size_t>(candidates_[pick]);
    dealt_[shape] += shapes_[shape].volume / weights_[shape];
    return static_cast<int>(shape);
  }

 private:
  const std::vector<ClumpTemplate>& shapes_;
  std::span<const double> weights_;  ///< of each shape, 1 in the mean
  std::vector<double> dealt_;  ///< volume of all grains of the shape so far, as if all had size 1, over the weight
  RandomSequence random_;
  double mean_volume_ = 0.0;
  std::vector<int> candidates_;
};

/// The middle of the mass share that starts at `start`, for a grain of volume shape_volume * size^3 in gravel of volume
/// `total`: the least m with m = start + shape_volume * size(m)^3 / (2 total). Beyond 1 when no grain fits any more.
double share_middle(const Grading& grading, double start, double shape_volume, double total) {
  double middle = start;
  for (int i = 0; i < 200; ++i) {  // rises to the solution; three or four rounds unless the grains are very few
    const double next = start + 0.5 * shape_volume * cube(size_at_passing(grading, middle)) / total;
    if (next <= middle || next > 1.0) return next;
    middle = next;
  }
  return middle;
}

/// Grains along the mass axis, as many as the volume `total` takes.
std::vector<GravelGrain> walk_volume(const Grading& grading, const std::vector<ClumpTemplate>& shapes, double total,
                                     ShapeDealer dealer) {
  std::vector<GravelGrain> grains;
  for (double start = 0.0;;) {
    const int shape = dealer.next();
    const double middle = share_middle(grading, start, shapes[static_cast<std::size_t>(shape)].volume, total);
    if (middle > 1.0) return grains;
    grains.push_back({shape, size_at_passing(grading, middle)});
    start += 2.0 * (middle - start);
  }
}

/// Gives sizes to a fixed number of grains; returns where on the mass axis the last share ends.
double walk_count(const Grading& grading, const std::vector<ClumpTemplate>& shapes, double total,
                  std::span<GravelGrain> grains) {
  double start = 0.0;
  for (GravelGrain& grain : grains) {
    const double volume = shapes[static_cast<std::size_t>(grain.shape)].volume;
    const double middle = share_middle(grading, start, volume, total);
    if (middle > 1.0) return middle;
    grain.sieve_size = size_at_passing(grading, middle);
    start += 2.0 * (middle - start);
  }
  return start;
}

/// Gives sizes to the grains so that together they cover the mass axis: bisection on the total volume, on which the end
/// of the last share depends in one direction only.
void cover_mass_axis(const Grading& grading, const std::vector<ClumpTemplate>& shapes, std::span<GravelGrain> grains) {
  double unit_volume = 0.0;
  for (const GravelGrain& grain : grains) unit_volume += shapes[static_cast<std::size_t>(grain.shape)].volume;
  double low = 0.5 * unit_volume * cube(smallest_size(grading));  // the last share ends beyond 1
  double high = 2.0 * unit_volume * cube(largest_size(grading));  // and before 1
  for (double middle = 0.5 * (low + high); low < middle && middle < high; middle = 0.5 * (low + high)) {
    (walk_count(grading, shapes, middle, grains) > 1.0 ? low : high) = middle;
  }
  walk_count(grading, shapes, high, grains);
}

/// Exactly so many grains that cover the mass axis.
std::vector<GravelGrain> walk_exact_count(const Grading& grading, const std::vector<ClumpTemplate>& shapes, int count,
                                          ShapeDealer dealer) {
  std::vector<GravelGrain> grains(static_cast<std::size_t>(count));
  for (GravelGrain& grain : grains) grain.shape = dealer.next();
  cover_mass_axis(grading, shapes, grains);
  return grains;
}

/// Shuffle after Fisher and Yates; the standard library leaves the order to its makers.
void shuffle(std::vector<GravelGrain>& grains, std::uint64_t seed) {
  RandomSequence random(seed, RandomStream::grain_order, 0);
  for (std::size_t left = grains.size(); left > 1; --left) {
    const auto pick = static_cast<std::size_t>(random.uniform() * static_cast<double>(left));
    std::swap(grains[left - 1], grains[pick]);
  }
}

void draw_gravel(GrainList& list, const SpecimenSettings& settings, double volume, std::uint64_t seed) {
  const Grading& grading = settings.gravel_grading;
  const std::vector<double> weights = share_weights(settings);
  const ShapeDealer dealer(list.shapes, weights, seed);
  if (settings.gravel_clumps) {
    list.gravel = walk_exact_count(grading, list.shapes, *settings.gravel_clumps, dealer);
  } else {
    const double smallest = cube(smallest_size(grading));
    const auto least = std::min_element(list.shapes.begin(), list.shapes.end(),
                                        [](const auto& a, const auto& b) { return a.volume < b.volume; });
    if (volume / (least->volume * smallest) > k_most_grains) {
      throw InputError(
          fmt::format("grains of the specimen: the box may hold more than {:.0f} gravel grains; "
                      "are the sizes in millimetres?",
                      k_most_grains));
    }
    list.gravel = walk_volume(grading, list.shapes, volume, dealer);
  }
  if (list.gravel.empty()) throw InputError("grains of the specimen: the box is too small for one gravel grain");
  shuffle(list.gravel, seed);
  for (const GravelGrain& grain : list.gravel) {
    list.gravel_volume += list.shapes[static_cast<std::size_t>(grain.shape)].volume * cube(grain.sieve_size);
  }
}

bool is_of_one_size(const Grading& grading) {
  const double middle = d50(grading), allowed = k_one_size_spread * middle * (1.0 + 1e-9);
  return largest_size(grading) - middle <= allowed && middle - smallest_size(grading) <= allowed;
}

void check_rubber_count(double count, int least) {
  if (count > k_most_grains) {
    throw InputError(fmt::format("grains of the specimen: the box would hold {:.3g} rubber grains, more than {:.0f}",
                                 count, k_most_grains));
  }
  if (count < least) {
    throw InputError(least == 1
                         ? std::string("grains of the specimen: the box is too small for one rubber grain")
                         : fmt::format("grains of the specimen: the box is too small for {} rubber grains, which "
                                       "a rubber grading of several sizes needs",
                                       least));
  }
}

/// So many runs of rubber grains of one size that cover the mass axis, the last one of `rest` grains when rest > 0. A run
/// is walked like one clump whose volume is that of all its grains: a rubber grain of size d has the solid volume d^3.
std::vector<GravelGrain> rubber_runs(const Grading& grading, std::size_t whole_runs, int rest) {
  std::vector<ClumpTemplate> runs(2);
  runs[0].volume = k_grains_of_one_size;
  runs[1].volume = rest;
  std::vector<GravelGrain> sizes(whole_runs);
  if (rest > 0) sizes.push_back({1, 0.0});
  cover_mass_axis(grading, runs, sizes);
  return sizes;
}

/// The number of whole runs whose volume is nearest to the one that is wanted; at least one.
std::vector<GravelGrain> rubber_runs_of_volume(const Grading& grading, double volume) {
  const auto miss = [&](const std::vector<GravelGrain>& runs) {
    double sum = 0.0;
    for (const GravelGrain& run : runs) sum += k_grains_of_one_size * cube(run.sieve_size);
    return std::abs(sum - volume);
  };
  std::vector<ClumpTemplate> run(1);
  run[0].volume = k_grains_of_one_size;
  const std::vector<double> weight(1, 1.0);
  const std::size_t n = walk_volume(grading, run, volume, ShapeDealer(run, weight, 0)).size();
  std::vector<GravelGrain> more = rubber_runs(grading, n + 1, 0);
  if (n == 0) return more;
  std::vector<GravelGrain> fewer = rubber_runs(grading, n, 0);
  return miss(more) < miss(fewer) ? more : fewer;
}

void draw_rubber(GrainList& list, const SpecimenSettings& settings, double volume, double ball_density,
                 double solid_density) {
  const Grading& grading = settings.rubber_grading;
  list.rubber_ball_radius = rubber_ball_radius(d50(grading), ball_density, solid_density);
  list.rubber_solid_volume = rubber_solid_volume(list.rubber_ball_radius, ball_density, solid_density);
  list.rubber_mean_size = rubber_grain_size(list.rubber_ball_radius, ball_density, solid_density);
  const double count =
      settings.rubber_grains ? *settings.rubber_grains : std::floor(volume / list.rubber_solid_volume + 0.5);
  if (is_of_one_size(grading)) {
    check_rubber_count(count, 1);
    list.rubber_count = static_cast<int>(count);
    list.rubber_volume = count * list.rubber_solid_volume;
    return;
  }
  check_rubber_count(volume / cube(smallest_size(grading)), 1);
  check_rubber_count(count, settings.rubber_grains ? 1 : k_grains_of_one_size);
  double size_times_volume = 0.0;
  const int wanted = settings.rubber_grains.value_or(0), rest = wanted % k_grains_of_one_size;
  const auto whole_runs = static_cast<std::size_t>(wanted / k_grains_of_one_size);
  const std::vector<GravelGrain> runs =
      settings.rubber_grains ? rubber_runs(grading, whole_runs, rest) : rubber_runs_of_volume(grading, volume);
  for (const GravelGrain& run : runs) {
    const int grains = run.shape == 1 ? rest : k_grains_of_one_size;
    const double size = run.sieve_size;
    list.rubber_radii.insert(list.rubber_radii.end(), static_cast<std::size_t>(grains),
                             rubber_ball_radius(size, ball_density, solid_density));
    list.rubber_volume += grains * cube(size);
    size_times_volume += grains * cube(size) * size;
  }
  list.rubber_count = static_cast<int>(list.rubber_radii.size());
  list.rubber_mean_size = size_times_volume / list.rubber_volume;
}

}  // namespace

GrainList draw_grains(const SpecimenSettings& settings, const BoxSettings& box, double ball_density,
                      double solid_density, std::uint64_t seed) {
  check_settings(settings, box);
  const double content = settings.rubber_content;
  const double void_ratio = settings.expected_void_ratio.value_or(expected_void_ratio(content));
  const double solid_volume = box.length * box.width * box.height / (1.0 + void_ratio);

  GrainList list;
  for (const std::string& name : settings.clump_shapes) {
    const ClumpShape* own = find_own_shape(settings, name);
    list.shapes.push_back(own != nullptr ? make_clump_template(name, own->pebbles) : *find_clump_template(name));
  }
  const Contents contents = contents_of(settings);
  if (contents.has_rubber) draw_rubber(list, settings, content * solid_volume, ball_density, solid_density);
  if (contents.has_gravel) draw_gravel(list, settings, (1.0 - content) * solid_volume, seed);
  return list;
}

void check_fills_box(const GrainList& list, const SpecimenSettings& settings, const BoxSettings& box) {
  if (!settings.gravel_clumps && !settings.rubber_grains) return;
  double largest = list.rubber_count > 0 ? list.rubber_mean_size : 0.0;
  for (const GravelGrain& g : list.gravel) largest = std::max(largest, g.sieve_size);
  const double void_ratio = settings.expected_void_ratio.value_or(expected_void_ratio(settings.rubber_content));
  const double height = list.solid_volume() * (1.0 + void_ratio) / (box.length * box.width);
  const bool is_nominal = box.split_plane == SplitPlane::nominal;
  const double least = is_nominal ? 0.5 * box.height + largest : 2.0 * largest;
  if (height >= least) return;
  throw InputError(fmt::format(
      "grains of the specimen: {} gravel and {} rubber grains fill {:.1f} mm of the box, the least is {:.1f} mm "
      "({}); give more grains or a lower box.height",
      list.gravel.size(), list.rubber_count, height * 1e3, least * 1e3,
      is_nominal ? "half of box.height and one of the largest grains" : "two of the largest grains"));
}

}  // namespace dem
