// SPDX-License-Identifier: BSD-3-Clause
#include "progress_line.hpp"

#include <cmath>
#include <iostream>

#include <fmt/format.h>

#include "dem4grm/runs/folder_lock.hpp"
#include "terminal.hpp"

namespace dem {
namespace {

constexpr double k_terminal_interval = 0.2;  // s
constexpr double k_plain_interval = 10.0;    // s

}  // namespace

// What matters most comes first: a narrow terminal cuts the end.
std::string progress_text(const Progress& now, const Forecast& forecast, double steps_per_second, double utc_seconds) {
  std::string text = now.stage;
  if (now.fraction >= 0.0) text += fmt::format(" {:.1f} %", 100.0 * now.fraction);
  if (forecast.seconds) {
    text += fmt::format("  done {}{} ({}{})", forecast.is_lower_bound ? "after " : "",
                        clock_text(utc_seconds, *forecast.seconds), forecast.is_lower_bound ? "over " : "",
                        duration_text(*forecast.seconds));
  }
  const bool is_moving = now.displacement > 0.0;
  if (is_moving) text += fmt::format("  {:.3f} mm", now.displacement * 1e3);
  if (is_moving && now.normal_stress > 0.0) text += fmt::format("  tau {:.1f} kPa", now.shear_stress / 1e3);
  if (!is_moving && now.normal_stress > 0.0) text += fmt::format("  sigma {:.1f} kPa", now.normal_stress / 1e3);
  if (now.void_ratio > 0.0) text += fmt::format("  e {:.3f}", now.void_ratio);
  if (now.inertial_number > 0.0) text += fmt::format("  I {:.1e}", now.inertial_number);
  if (!is_moving && now.unbalanced_ratio > 0.0) text += fmt::format("  unbalanced {:.1e}", now.unbalanced_ratio);
  if (steps_per_second > 0.0) text += fmt::format("  {:.0f} steps/s", steps_per_second);
  return text;
}

ProgressLine::ProgressLine(RemainingTime remaining, Loudness loudness)
    : remaining_(std::move(remaining)), loudness_(loudness), is_terminal_(is_error_stream_a_terminal()) {}

ProgressLine::~ProgressLine() { close_line(); }

double ProgressLine::seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

void ProgressLine::progress(const Progress& now) {
  const double time = seconds();
  remaining_.update(now, time);
  if (loudness_ == Loudness::silent) return;
  const bool is_new_stage = now.stage != stage_;
  const bool is_last = now.fraction >= 1.0 - 1e-12 && !is_terminal_;
  if (!is_new_stage && !is_last && time - shown_at_ < (is_terminal_ ? k_terminal_interval : k_plain_interval)) return;
  if (is_new_stage) close_line();
  stage_ = now.stage;
  shown_at_ = time;
  std::string text = progress_text(now, remaining_.forecast(), remaining_.steps_per_second(), utc_now());
  if (!is_terminal_) {
    std::cerr << text << '\n' << std::flush;
    return;
  }
  // One column stays free: a full line would wrap and could not be written over.
  text.resize(std::min(text.size(), static_cast<std::size_t>(std::max(terminal_width() - 1, 20))));
  std::cerr << '\r' << text << "\033[K" << std::flush;
  is_line_open_ = true;
}

void ProgressLine::close_line() {
  if (is_line_open_) std::cerr << '\n' << std::flush;
  is_line_open_ = false;
}

void ProgressLine::note(const std::string& text) {
  if (loudness_ == Loudness::silent) return;
  close_line();
  print_note(text);
}

void ProgressLine::warning(const std::string& text) {
  if (loudness_ == Loudness::silent) return;
  close_line();
  print_warning(text);
}

void ProgressLine::frame(const Simulation& /*state*/, const FrameInfo& info) {
  if (loudness_ != Loudness::verbose) return;
  close_line();
  print_note(fmt::format("state {} at {:.3f} mm, hash {}", info.number, info.displacement * 1e3, info.state_hash));
}

}  // namespace dem
