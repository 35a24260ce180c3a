// SPDX-License-Identifier: BSD-3-Clause
// A listener that sets the number of threads by what they achieve, and passes everything on.
#pragma once

#include <omp.h>

#include <chrono>

#include "dem4grm/core/thread_choice.hpp"
#include "dem4grm/lab/observer.hpp"

namespace dem {

class ThreadTuner : public LabObserver {
 public:
  ThreadTuner(LabObserver& next, int most) : next_(next), choice_(most) {}

  void progress(const Progress& now) override {
    const std::chrono::duration<double> clock = std::chrono::steady_clock::now().time_since_epoch();
    omp_set_num_threads(choice_.update(clock.count(), now.steps));
    next_.progress(now);
  }
  void note(const std::string& text) override { next_.note(text); }
  void warning(const std::string& text) override { next_.warning(text); }
  void shear_row(const ShearRow& row) override { next_.shear_row(row); }
  void micro_row(const MicroRow& row) override { next_.micro_row(row); }
  void compression_row(const CompressionRow& row) override { next_.compression_row(row); }
  void frame(const Simulation& state, const FrameInfo& info) override { next_.frame(state, info); }

 private:
  LabObserver& next_;
  ThreadChoice choice_;
};

}  // namespace dem
