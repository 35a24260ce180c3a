// SPDX-License-Identifier: BSD-3-Clause
// dem4grm watch: follows a running test or campaign from another terminal, from its files alone.
#include <chrono>
#include <ctime>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <thread>

#include <fmt/format.h>

#include "campaign_verbs.hpp"
#include "dem4grm/campaign/campaign_folder.hpp"
#include "dem4grm/core/error.hpp"
#include "dem4grm/results/file_names.hpp"
#include "dem4grm/runs/folder_lock.hpp"
#include "dem4grm/runs/live_folder.hpp"
#include "progress_line.hpp"
#include "run_report.hpp"
#include "signals.hpp"
#include "terminal.hpp"
#include "verbs.hpp"

namespace dem {
namespace {

constexpr auto k_watch_interval = std::chrono::milliseconds(500);
constexpr int k_plain_lines_apart = 20;  ///< intervals, where lines cannot be written over

/// Seconds from now to "2031-05-06T07:08:09Z"; nothing for another text.
std::optional<double> seconds_until(const std::string& utc) {
  std::tm parts{};
  if (utc.empty() || ::strptime(utc.c_str(), "%Y-%m-%dT%H:%M:%SZ", &parts) == nullptr) return std::nullopt;
  return std::max(0.0, static_cast<double>(::timegm(&parts)) - utc_now());
}

std::string status_line(const JsonObject& status) {
  Progress now;
  const std::string stage = text_in(status, "stage");
  now.stage = stage.empty() ? text_in(status, "state") : stage;
  now.fraction = number_in(status, "progress", -1.0);
  now.displacement = 1e-3 * number_in(status, "displacement_mm");
  now.shear_stress = 1e3 * number_in(status, "shear_stress_kPa");
  now.normal_stress = 1e3 * number_in(status, "normal_stress_kPa");
  now.void_ratio = number_in(status, "void_ratio");
  now.inertial_number = number_in(status, "inertial_number");
  now.unbalanced_ratio = number_in(status, "unbalanced_ratio");
  Forecast forecast;
  forecast.seconds = seconds_until(text_in(status, "eta"));
  forecast.is_lower_bound = is_set_in(status, "eta_is_lower_bound");
  return progress_text(now, forecast, number_in(status, "steps_per_second"), utc_now());
}

/// A status that is just being replaced reads as the one before.
void refresh(const std::filesystem::path& file, JsonObject& status) {
  try {
    status = read_json_file(file);
  } catch (const Error&) {
    if (status.empty()) throw;
  }
}

std::string end_of(const std::filesystem::path& folder, const JsonObject& status) {
  const std::string state = text_in(status, "state"), cause = text_in(status, "cause");
  if (state == "finished") return run_report(read_json_file(folder / file_name::k_summary), folder, false);
  const bool was_silent = state != "stopped" && state != "failed" && state != "specimen ready";
  return fmt::format("{}: {}{}\n", folder.string(),
                     was_silent ? fmt::format("no process is at work; it was last heard of at {}, {}",
                                              text_in(status, "time"), text_in(status, "stage"))
                                : state,
                     cause.empty() ? "" : ": " + cause);
}

void watch_test(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / file_name::k_status;
  JsonObject status;
  refresh(file, status);
  install_signals();
  const bool is_terminal = is_error_stream_a_terminal();
  std::string stage;
  for (int k = 0; stop_requested == 0 && is_folder_locked(folder).value_or(text_in(status, "state") == "running");
       ++k) {
    refresh(file, status);
    std::string text = status_line(status);
    if (is_terminal) {
      text.resize(std::min(text.size(), static_cast<std::size_t>(std::max(terminal_width() - 1, 20))));
      std::cerr << '\r' << text << "\033[K" << std::flush;
    } else if (k % k_plain_lines_apart == 0 || text_in(status, "stage") != stage) {
      std::cerr << text << '\n' << std::flush;
    }
    stage = text_in(status, "stage");
    std::this_thread::sleep_for(k_watch_interval);
  }
  if (is_terminal && !stage.empty()) std::cerr << '\n' << std::flush;
  if (stop_requested != 0) return;  // the test goes on without us
  refresh(file, status);
  print_result(end_of(folder, status));
}

void watch(const std::string& path) {
  const std::filesystem::path folder = path;
  std::error_code ignored;
  if (std::filesystem::exists(CampaignFolder(folder).record(), ignored)) {
    CampaignOptions options;
    options.folder = path;
    options.is_watch = true;
    show_campaign_status(options);
    return;
  }
  if (!std::filesystem::exists(folder / file_name::k_status, ignored)) {
    throw MissingFileError(fmt::format("{}: holds no {}: no test was begun there", path, file_name::k_status));
  }
  watch_test(folder);
}

}  // namespace

void add_watch(CLI::App& app) {
  CLI::App* verb = app.add_subcommand("watch", "follows a running test or campaign from its files");
  const auto path = std::make_shared<std::string>();
  verb->add_option("DIR", *path, "output folder, or the folder of a campaign")->required();
  verb->footer("Example:\n  dem4grm watch runs/quick");
  verb->callback([path] { watch(*path); });
}

}  // namespace dem
