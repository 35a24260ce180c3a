// SPDX-License-Identifier: BSD-3-Clause
// status.json: where a run stands, for people and programs that look from outside.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "dem4grm/core/error.hpp"
#include "dem4grm/lab/observer.hpp"
#include "dem4grm/runs/remaining_time.hpp"

namespace dem {

/// States of a run, in the order in which they can follow each other.
enum class RunState { created, preparing, running, stopping, stopped, specimen_ready, finished, failed };

const char* state_name(RunState state);

/// Replaced as a whole each time, so that a reader never sees half a file.
class StatusFile {
 public:
  static constexpr double k_least_interval = 1.0;  ///< s, between two writes that only report progress

  /// Writes state "created". Throws IoError.
  StatusFile(std::filesystem::path path, std::string case_name, int threads);

  /// Writes at once. `cause` says why a run stopped or failed, `exit_code` what the program then ends with. Throws IoError.
  void set_state(RunState state, const std::string& cause = {}, std::optional<ExitCode> exit_code = {});
  /// Remembers where the run is and writes it if the last write is older than k_least_interval. Throws IoError.
  void set_progress(const Progress& now, const RemainingTime& remaining);

 private:
  void write();

  std::filesystem::path path_;
  std::string case_name_, cause_;
  int threads_ = 0;
  std::optional<ExitCode> exit_code_;
  RunState state_ = RunState::created;
  double started_ = 0.0, written_ = 0.0;  ///< s since 1970
  Progress progress_;
  Forecast forecast_;
  double steps_per_second_ = 0.0;
};

}  // namespace dem
