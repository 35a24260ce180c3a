// SPDX-License-Identifier: BSD-3-Clause
// dem4grm micro: the micro-mechanics of a stored state.
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "dem4grm/core/error.hpp"
#include "dem4grm/core/quantity.hpp"
#include "dem4grm/results/micro_text.hpp"
#include "dem4grm/results/output_file.hpp"
#include "dem4grm/results/results_file.hpp"
#include "read_apart.hpp"
#include "terminal.hpp"
#include "verbs.hpp"

namespace dem {
namespace {

struct MicroVerbOptions {
  std::string path, at, histogram;
  std::string level = "contact", mean = "orientations", strong = "normal", projection = "all";
  double bin_width = 10.0;  ///< degrees
  int resamples = 0;
  std::uint64_t seed = 1;
  bool is_json = false;
};

std::optional<double> displacement_of(const std::string& text) {
  if (text.empty()) return std::nullopt;
  const ParsedQuantity at = parse_quantity(text, Dimension::length);
  if (!at.value) throw Error(ExitCode::usage, fmt::format("--at {} {}", text, at.problem));
  return at.value;
}

MicroOptions analysis_options(const MicroVerbOptions& given) {
  MicroOptions out;
  const double bins = 360.0 / given.bin_width;
  const bool is_even = std::fabs(bins / 2.0 - std::nearbyint(bins / 2.0)) < 1e-9;
  if (!(given.bin_width >= 0.5) || !(given.bin_width <= 20.0) || !is_even) {
    throw Error(ExitCode::usage,
                fmt::format("--bin-width {}: must divide 180 degrees, from 0.5 to 20", given.bin_width));
  }
  out.bins = static_cast<int>(std::nearbyint(bins));
  out.level = given.level == "pair" ? ContactLevel::pair : ContactLevel::contact;
  out.force_mean = given.mean == "contacts" ? ForceMean::contacts : ForceMean::orientations;
  out.strong = given.strong == "magnitude" ? StrongMeasure::magnitude : StrongMeasure::normal_force;
  out.projection = given.projection == "near-plane" ? Projection::near_plane : Projection::all;
  out.resamples = given.resamples;
  out.seed = given.seed;
  return out;
}

void show_micro(const MicroVerbOptions& given) {
  const MicroOptions options = analysis_options(given);
  const std::optional<double> at = displacement_of(given.at);
  const std::filesystem::path results = results_in(given.path);
  const StoredMicroState stored = read_micro_state(results, at);
  const MicroAnalysis analysis = analyse(stored.state, options);
  if (!given.histogram.empty()) replace_file(given.histogram, histogram_csv(analysis));
  if (given.is_json) {
    print_result(json_text(micro_as_json(stored, analysis)));
    return;
  }
  print_result(fmt::format("{}: state {} at {:.3f} mm, hash {}\n{}\n", results.string(), stored.name,
                           stored.displacement * 1e3, stored.state_hash, options_text(options)) +
               micro_table_text(analysis));
}

}  // namespace

void add_micro(CLI::App& app) {
  CLI::App* verb = app.add_subcommand("micro", "contact network of a stored state: fabric, forces, ...");
  const auto options = std::make_shared<MicroVerbOptions>();
  // The allowed words stand in the help text; said twice they would not fit a line.
  const auto one_of = [](std::vector<std::string> words) { return CLI::IsMember(std::move(words)).description(""); };
  verb->add_option("DIR", options->path, "output folder, or its results.h5")->required();
  verb->add_option("--at", options->at, "displacement of the state, as 8mm; default the last")->type_name("LENGTH");
  verb->add_option("--bin-width", options->bin_width, "of the polar histograms, divides 180; default 10")
      ->type_name("DEGREES");
  verb->add_option("--level", options->level, "contact (default), or pair: two grains as one")
      ->type_name("LEVEL")
      ->check(one_of({"contact", "pair"}));
  verb->add_option("--mean", options->mean, "f0: over orientations (default) or contacts")
      ->type_name("MEAN")
      ->check(one_of({"orientations", "contacts"}));
  verb->add_option("--strong", options->strong, "above the mean of: normal (default) or magnitude")
      ->type_name("FORCE")
      ->check(one_of({"normal", "magnitude"}));
  verb->add_option("--projection", options->projection, "all (default), or near-plane: |n_y| < 0.5 only")
      ->type_name("SET")
      ->check(one_of({"all", "near-plane"}));
  verb->add_option("--bootstrap", options->resamples, "95 % bands from so many resamples; default none")
      ->type_name("N")
      ->check(CLI::Range(0, k_most_resamples).description(""));
  verb->add_option("--seed", options->seed, "of the bootstrap; default 1")->type_name("N");
  verb->add_option("--histogram", options->histogram, "writes histograms and fitted curves there")
      ->type_name("FILE.csv");
  verb->add_flag("--json", options->is_json, "as one JSON object on stdout");
  verb->footer("Example:\n  dem4grm micro runs/quick --at 8mm --bootstrap 200");
  verb->callback([options] { read_apart(options->path, [&] { show_micro(*options); }); });
}

}  // namespace dem
