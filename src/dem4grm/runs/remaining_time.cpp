// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/runs/remaining_time.hpp"

#include <algorithm>

namespace dem {

namespace {

constexpr double k_window = 30.0;   // s, over which the speed is taken
constexpr double k_spacing = 0.25;  // s, between two samples that are kept
constexpr std::size_t k_least_samples = 3;

}  // namespace

void RemainingTime::update(const Progress& now, double wall_time) {
  if (now.time_step > 0.0) time_step_ = now.time_step;
  steps_to_last_stage_ = now.steps_to_last_stage;
  if (!samples_.empty()) wall_time = std::max(wall_time, samples_.back().wall_time);
  const Sample sample{wall_time, now.fraction, now.steps};
  if (now.stage != stage_) {
    stage_ = now.stage;
    first_ = sample;
    samples_.clear();
  }
  // The last sample always is the present one; older ones are thinned out.
  if (samples_.size() >= 2 && wall_time - samples_[samples_.size() - 2].wall_time < k_spacing) samples_.pop_back();
  samples_.push_back(sample);
  while (samples_.size() > k_least_samples && wall_time - samples_[1].wall_time > k_window) samples_.pop_front();
}

double RemainingTime::steps_per_second() const {
  if (samples_.size() < 2) return 0.0;
  const double elapsed = samples_.back().wall_time - samples_.front().wall_time;
  if (!(elapsed > 0.0)) return 0.0;
  return std::max(0.0, static_cast<double>(samples_.back().steps - samples_.front().steps) / elapsed);
}

std::optional<double> RemainingTime::rest_of_stage() const {
  if (samples_.empty() || samples_.back().fraction < 0.0) return std::nullopt;
  const Sample& now = samples_.back();
  // The latest speed early on; later the mean of the stage takes over by itself as the window is a part of it.
  const Sample& from = now.wall_time - first_.wall_time > 2.0 * k_window ? samples_.front() : first_;
  const double done = now.fraction - from.fraction, elapsed = now.wall_time - from.wall_time;
  if (!(done > 0.0) || !(elapsed > 0.0)) return std::nullopt;
  return elapsed * std::max(0.0, 1.0 - now.fraction) / done;
}

Forecast RemainingTime::forecast() const {
  if (stage_ == last_stage_) return {rest_of_stage(), false};
  // The end of this stage alone would say nothing about the test, in which the last stage takes longest.
  const double speed = steps_per_second();
  if (!(time_step_ > 0.0) || !(speed > 0.0)) return {std::nullopt, true};
  const double last_stage = last_stage_duration_ / time_step_ / speed;
  if (steps_to_last_stage_ >= 0.0) return {steps_to_last_stage_ / speed + last_stage, false};
  return {rest_of_stage().value_or(0.0) + last_stage, true};
}

}  // namespace dem
