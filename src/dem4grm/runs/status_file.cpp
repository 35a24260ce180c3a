// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/runs/status_file.hpp"

#include <unistd.h>

#include <array>
#include <cmath>

#include "dem4grm/core/quantity.hpp"
#include "dem4grm/results/json_text.hpp"
#include "dem4grm/results/output_file.hpp"
#include "dem4grm/runs/folder_lock.hpp"
#include "dem4grm/version.hpp"

namespace dem {

const char* state_name(RunState state) {
  constexpr std::array<const char*, 8> k_names{"created", "preparing",      "running",  "stopping",
                                               "stopped", "specimen ready", "finished", "failed"};
  return k_names[static_cast<std::size_t>(state)];
}

StatusFile::StatusFile(std::filesystem::path path, std::string case_name, int threads)
    : path_(std::move(path)), case_name_(std::move(case_name)), threads_(threads), started_(utc_now()) {
  write();
}

void StatusFile::set_state(RunState state, const std::string& cause, std::optional<ExitCode> exit_code) {
  state_ = state;
  exit_code_ = exit_code;
  cause_ = cause;
  write();
}

void StatusFile::set_progress(const Progress& now, const RemainingTime& remaining) {
  progress_ = now;
  forecast_ = remaining.forecast();
  steps_per_second_ = remaining.steps_per_second();
  // A clock that was set back must not silence the file.
  if (std::fabs(utc_now() - written_) >= k_least_interval) write();
}

void StatusFile::write() {
  const double now = utc_now();
  const bool is_going_on = state_ == RunState::preparing || state_ == RunState::running;
  JsonObject status{{"state", state_name(state_)},
                    {"case", case_name_},
                    {"version", k_version},
                    {"commit", k_commit},
                    {"host", host_name()},
                    {"pid", static_cast<std::int64_t>(::getpid())},
                    {"threads", threads_},
                    {"started", utc_text(started_)},
                    {"time", utc_text(now)},
                    {"stage", progress_.stage},
                    {"step", progress_.steps},
                    {"progress", progress_.fraction >= 0.0 ? JsonValue(progress_.fraction) : JsonValue()},
                    {"displacement_mm", progress_.displacement * 1e3},
                    {"shear_stress_kPa", progress_.shear_stress / 1e3},
                    {"normal_stress_kPa", progress_.normal_stress / 1e3},
                    {"void_ratio", progress_.void_ratio},
                    {"inertial_number", progress_.inertial_number},
                    {"shear_velocity_mm_per_s", scaled_decimal(progress_.shear_velocity, -3)},
                    {"unbalanced_ratio", progress_.unbalanced_ratio},
                    {"steps_per_second", steps_per_second_}};
  const bool is_known = is_going_on && forecast_.seconds.has_value();
  status.push_back({"eta", is_known ? JsonValue(utc_text(now + *forecast_.seconds)) : JsonValue()});
  status.push_back({"eta_is_lower_bound", is_known && forecast_.is_lower_bound});
  status.push_back({"cause", cause_.empty() ? JsonValue() : JsonValue(cause_)});
  status.push_back({"exit_code", exit_code_ ? JsonValue(static_cast<int>(*exit_code_)) : JsonValue()});
  const std::string text = json_text(status);
  try {
    replace_file(path_, text);
  } catch (const IoError&) {
    // The last word of a run must be true on a full disk too.
    const bool is_last = state_ == RunState::failed || state_ == RunState::stopped;
    if (!is_last || !overwrite_file(path_, text)) throw;
  }
  written_ = now;
}

}  // namespace dem
