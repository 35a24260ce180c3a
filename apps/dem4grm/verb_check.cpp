// SPDX-License-Identifier: BSD-3-Clause
// dem4grm check: validates a case and shows what follows from it.
#include <memory>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "dem4grm/core/error.hpp"
#include "dem4grm/core/quantity.hpp"
#include "dem4grm/laws/inertial_number.hpp"
#include "dem4grm/runs/case_facts.hpp"
#include "dem4grm/runs/run_forecast.hpp"
#include "terminal.hpp"
#include "verbs.hpp"

namespace dem {
namespace {

struct CheckOptions {
  std::string case_path;
  std::vector<std::string> settings;
  bool is_json = false, is_key_list = false, is_brief = false;
  int threads = 0;
};

const char* verdict(double inertial_number) {
  if (inertial_number < k_quasi_static) return "below 1e-4: quasi-static";
  if (inertial_number < k_too_fast) return "between 1e-4 and 1e-3: nearly quasi-static";
  return "above 1e-3: too fast to be quasi-static";
}

std::string facts_text(const CaseFacts& f, std::size_t warnings) {
  std::string text = fmt::format("{}: valid {} case{}\n", f.name, f.test,
                                 warnings == 0 ? "" : fmt::format(", {} warning(s) above", warnings));
  const auto line = [&](const char* name, const std::string& value) {
    text += fmt::format("  {:<18} {}\n", name, value);
  };
  line("grains", fmt::format("{} gravel clumps, {} rubber grains", f.clumps, f.rubber_grains));
  std::string shapes;
  for (const ShapeFacts& s : f.shapes) {
    if (s.grains > 0) shapes += fmt::format("{}{} {:.1f} %", shapes.empty() ? "" : ", ", s.name, 100.0 * s.share);
  }
  if (!shapes.empty()) line("gravel shapes", shapes + " of its volume");
  line("balls", fmt::format("{}, with {} bonds", f.balls, f.bonds));
  line("time step", fmt::format("{:.3e} s{}, limited by: {}", f.time_step,
                                f.test == "direct_shear" ? " until shear" : "", f.time_step_limited_by));
  line("steps", fmt::format("{} {}, {} rows", f.steps, f.test == "direct_shear" ? "of shear" : "in all", f.rows));
  if (f.test == "direct_shear") {
    line("rubber content", fmt::format("{:.4f} by solid volume", f.rubber_content));
    line("void ratio", fmt::format("{:.3f} of the random fill, {:.3f} expected under load", f.generation_void_ratio,
                                   f.expected_void_ratio));
    line("mean grain", fmt::format("{:.2f} mm, {:.0f} kg/m3", f.mean_size * 1e3, f.mean_density));
    line("shear velocity", fmt::format("{}{}", format_quantity(f.shear_velocity, Dimension::speed),
                                       f.is_velocity_chosen ? ", chosen for the nominal height" : ""));
    line("inertial number", fmt::format("{:.2e}, {}", f.inertial_number, verdict(f.inertial_number)));
  }
  line("memory", fmt::format("about {:.0f} MB", f.memory / 1e6));
  return text;
}

std::string forecast_text(const RunForecast& f) {
  std::string text;
  const auto line = [&](const char* name, const std::string& value) {
    text += fmt::format("  {:<18} {}\n", name, value);
  };
  const std::string parts =
      f.preparation_time > 0.0
          ? fmt::format(": specimen {}, shear {}", duration_text(f.preparation_time), duration_text(f.test_time))
          : "";
  line("time", fmt::format("about {} with {} thread(s){}", duration_text(f.time()), f.threads, parts));
  line("", fmt::format("{} steps of {:.3g} ms, from a trial of {:.2g} s on this machine", f.steps, f.step_time * 1e3,
                       f.trial));
  if (f.results_size > 0.0) {
    line("disk", fmt::format("about {:.0f} MB{}, and {:.0f} MB for the checkpoint while it runs", f.results_size / 1e6,
                             f.store_size > 0.0 ? fmt::format(", {:.0f} MB of kept branches", f.store_size / 1e6) : "",
                             f.checkpoint_size / 1e6));
  }
  return text;
}

void check(const CheckOptions& options) {
  if (options.is_key_list) {
    print_result(key_table_markdown());
    return;
  }
  if (options.case_path.empty()) throw Error(ExitCode::usage, "check needs a case file, or --keys");
  const std::vector<Override> overrides = overrides_from(options.settings);
  const LoadedCase loaded = load_case(options.case_path, overrides);
  const CaseFacts facts = derive_facts(loaded.test);
  std::optional<RunForecast> forecast;
  if (!options.is_brief) forecast = forecast_run(loaded.test, facts, k_forecast_trial, options.threads);
  if (options.is_json) {
    JsonObject answer = facts_as_json(facts);
    if (forecast) {
      for (JsonField& field : forecast_as_json(*forecast)) answer.push_back(std::move(field));
    }
    answer.push_back({"warnings", loaded.warnings});
    print_result(json_text(answer));
    return;
  }
  for (const std::string& text : loaded.warnings) print_warning(text);
  print_result(facts_text(facts, loaded.warnings.size()) + (forecast ? forecast_text(*forecast) : "") +
               fmt::format("  {:<18} dem4grm run {}\n", "next", options.case_path));
}

}  // namespace

void add_check(CLI::App& app) {
  CLI::App* verb = app.add_subcommand("check", "validates a case and shows what follows from it");
  const auto options = std::make_shared<CheckOptions>();
  verb->add_option("CASE", options->case_path, "case file");
  add_set_option(*verb, options->settings);
  verb->add_option("-j,--threads", options->threads,
                   "threads of the forecast; by default one or all,\nwhatever is faster here")
      ->type_name("N")
      ->check(CLI::Range(1, 1024));
  verb->add_flag("--brief", options->is_brief, "no trial, and so no forecast of time and disk");
  verb->add_flag("--json", options->is_json, "as one JSON object on stdout");
  verb->add_flag("--keys", options->is_key_list, "the table of all keys in Markdown instead");
  verb->footer("Example:\n  dem4grm check cases/quick.toml --set shear.velocity=\"2 mm/s\"");
  verb->callback([options] { check(*options); });
}

}  // namespace dem
