// SPDX-License-Identifier: BSD-3-Clause
// When a test will be done, from what it has done so far.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>

#include "dem4grm/lab/observer.hpp"

namespace dem {

/// A forecast. Stages that settle until the specimen is at rest count with the steps that the test expects of them, or
/// with nothing.
struct Forecast {
  std::optional<double> seconds;  ///< until the end of the test
  bool is_lower_bound = false;    ///< a stage of unknown length is still to come or is running
};

/// Fed with every progress report. Time is wall-clock time in seconds from any origin; it may stand still but must not
/// run backwards (a step back is taken as none).
class RemainingTime {
 public:
  /// last_stage: name of the stage at whose end the test is done; last_stage_duration: of it, simulated, s.
  RemainingTime(std::string last_stage, double last_stage_duration)
      : last_stage_(std::move(last_stage)), last_stage_duration_(last_stage_duration) {}

  void update(const Progress& now, double wall_time);

  [[nodiscard]] Forecast forecast() const;
  /// Steps per second over the last half minute or so; 0 while unknown.
  [[nodiscard]] double steps_per_second() const;

 private:
  struct Sample {
    double wall_time = 0.0, fraction = 0.0;
    std::int64_t steps = 0;
  };
  [[nodiscard]] std::optional<double> rest_of_stage() const;

  std::string last_stage_;
  double last_stage_duration_ = 0.0;
  std::string stage_;
  double time_step_ = 0.0;
  double steps_to_last_stage_ = -1.0;
  Sample first_;                ///< of the present stage
  std::deque<Sample> samples_;  ///< of the present stage, the latest ones
};

}  // namespace dem
