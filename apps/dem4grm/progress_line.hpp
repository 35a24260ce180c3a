// SPDX-License-Identifier: BSD-3-Clause
// Shows on stderr where a test stands: one line written over on a terminal, plain lines else.
#pragma once

#include <chrono>
#include <string>

#include "dem4grm/lab/observer.hpp"
#include "dem4grm/runs/remaining_time.hpp"

namespace dem {

enum class Loudness { silent, normal, verbose };

/// "compression  done after 14:32 (over 36 min)  sigma 59.8 kPa  e 0.652  unbalanced 3.1e-04  812 steps/s"
std::string progress_text(const Progress& now, const Forecast& forecast, double steps_per_second, double utc_seconds);

class ProgressLine : public LabObserver {
 public:
  /// The test decides what the last stage is and how long it is.
  ProgressLine(RemainingTime remaining, Loudness loudness);
  ~ProgressLine() override;

  void progress(const Progress& now) override;
  void note(const std::string& text) override;
  void warning(const std::string& text) override;
  void frame(const Simulation& state, const FrameInfo& info) override;

  /// Ends the line that is written over.
  void close_line();

 private:
  [[nodiscard]] double seconds() const;

  RemainingTime remaining_;
  Loudness loudness_;
  bool is_terminal_;
  bool is_line_open_ = false;
  std::string stage_;
  double shown_at_ = -1e9;  ///< s since start
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace dem
