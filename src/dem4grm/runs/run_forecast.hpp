// SPDX-License-Identifier: BSD-3-Clause
// What a run will take on this machine: time from a short trial of the case's own grains, and disk.
#pragma once

#include <cstdint>

#include "dem4grm/case_file/case_file.hpp"
#include "dem4grm/results/json_text.hpp"
#include "dem4grm/runs/case_facts.hpp"

namespace dem {

/// How long the trial takes unless told otherwise, s.
inline constexpr double k_forecast_trial = 2.0;

struct RunForecast {
  double trial = 0.0;             ///< s, how long it was tried
  int threads = 0;                ///< of the trial: as asked for, or what is faster here
  double step_time = 0.0;         ///< s, of a step of the loaded specimen
  std::int64_t steps = 0;         ///< all stages, the fill in steps as dear as those of a loaded specimen
  double preparation_time = 0.0;  ///< s, fill, compression and final friction
  double test_time = 0.0;         ///< s, shear, or the compression of a grain
  double results_size = 0.0;      ///< bytes that stay when the run is done
  double store_size = 0.0;        ///< bytes of the branches kept for other preparations
  double checkpoint_size = 0.0;   ///< bytes while it runs; twice that for the moment in which one is replaced

  [[nodiscard]] double time() const { return preparation_time + test_time; }
};

/// How fast a stand-in for the specimen of a case steps on this machine, and what else only its grains tell.
struct StepTrial {
  double seconds = 0.0;       ///< how long it was tried
  int threads = 1;            ///< as asked for, or what is faster here
  double step_time = 0.0;     ///< s, of a step of the loaded specimen
  double contacts = 0.0;      ///< that carry force
  double solid_volume = 0.0;  ///< m3
  bool has_rubber = true;
};

/// Tries the grains of a case (lab/dense_assembly.hpp) for about so many seconds, half of them on one thread and half on
/// `most_threads`, which 0 leaves to the machine. Tests with the same grains may share a trial. Throws InputError for
/// grains that cannot be drawn.
StepTrial try_steps(const TestCase& test, double seconds = k_forecast_trial, int most_threads = 0);

/// The forecast that follows from a trial of the same grains.
RunForecast forecast_run(const TestCase& test, const CaseFacts& facts, const StepTrial& trial);

/// Both: a trial of the case's own grains, and what follows.
RunForecast forecast_run(const TestCase& test, const CaseFacts& facts, double trial = k_forecast_trial,
                         int most_threads = 0);

/// The forecast with units in its names.
JsonObject forecast_as_json(const RunForecast& forecast);

}  // namespace dem
