// SPDX-License-Identifier: BSD-3-Clause
// The observer that turns a running test into the files of its folder.
#pragma once

#include <chrono>
#include <csignal>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "dem4grm/results/results_file.hpp"
#include "dem4grm/results/summary.hpp"
#include "dem4grm/results/table_file.hpp"
#include "dem4grm/runs/output_folder.hpp"
#include "dem4grm/runs/preparation_store.hpp"
#include "dem4grm/runs/remaining_time.hpp"
#include "dem4grm/runs/run_log.hpp"
#include "dem4grm/runs/status_file.hpp"
#include "dem4grm/runs/stop_cause.hpp"

namespace dem {

/// An end was asked for (StopCause). The code says whether there is a checkpoint to go on from.
struct StoppedOnRequest : Error {
  using Error::Error;
};

/// What a run hears from outside and tells to the outside.
struct RunLinks {
  LabObserver* listener = nullptr;                        ///< hears everything that the writer hears; may be null
  const volatile std::sig_atomic_t* stop_flag = nullptr;  ///< a StopCause: stop at the next good point; may be null
  double checkpoint_interval = 600.0;                     ///< s of wall time between two checkpoints
  std::filesystem::path store{};                          ///< of preparations; empty: in the output folder
  bool is_specimen_only = false;                          ///< end with the finished specimen
  volatile std::sig_atomic_t* save_flag = nullptr;        ///< not zero: write a checkpoint, set it back; may be null
};

/// The forecast of a test that has not begun.
RemainingTime remaining_time_of(const TestCase& test, bool is_specimen_only = false);

class TestWriter : public LabObserver {
 public:
  /// Opens all files of the folder; `past_wall_time`: s that earlier parts of the run took. Throws IoError.
  TestWriter(const OutputFolder& folder, const LoadedCase& loaded, int threads, const RunLinks& links,
             double past_wall_time = 0.0);

  /// These throw IoError when a file cannot be written; when the stop flag is set, checkpoint() throws StoppedOnRequest
  /// after it has written, and so does progress() in a test without checkpoints.
  void progress(const Progress& now) override;
  void note(const std::string& text) override;
  void warning(const std::string& text) override;
  void shear_row(const ShearRow& row) override;
  void micro_row(const MicroRow& row) override;
  void compression_row(const CompressionRow& row) override;
  void frame(const Simulation& state, const FrameInfo& info) override;
  bool wants_checkpoint(bool is_new_stage) override;
  void checkpoint(const StateArchive& state) override;
  bool wants_end_state() override { return true; }
  void end_state(const StateArchive& state) override;
  void resumed(const ResumedRun& past) override;
  std::optional<StateArchive> fetch_preparation(const std::string& name) override;
  void keep_preparation(const std::string& name, const StateArchive& state) override;
  void specimen_ready(const StateArchive& state, const SpecimenReport& report) override;
  bool wants_shear() override { return !links_.is_specimen_only; }

  /// Completes all files; summary.json comes last and marks the folder as complete. Returns what it says.
  JsonObject finish(const DirectShearResult& result);
  JsonObject finish(const GrainCompressionResult& result);
  /// For a test that ends with its specimen: specimen.json; the folder is ready for shear.
  JsonObject finish_specimen(const DirectShearResult& result);
  /// Keeps what there is of a run that ends early. Throws nothing: the reason of the end matters more.
  void give_up(RunState state, const std::string& cause, ExitCode code) noexcept;

 private:
  [[nodiscard]] RunFacts facts() const;
  [[nodiscard]] double seconds() const;
  [[nodiscard]] std::sig_atomic_t stop_cause() const {
    return links_.stop_flag == nullptr ? static_cast<std::sig_atomic_t>(k_no_stop) : *links_.stop_flag;
  }
  [[nodiscard]] bool must_save() const { return links_.save_flag != nullptr && *links_.save_flag != 0; }
  ResultsFile& results();
  void take_row(const ShearRow& row);
  void with_store(const std::function<void()>& write);
  void write_tables();
  void sync_tables();
  void write_profiles();
  void write_summary(const JsonObject& summary);

  const OutputFolder& folder_;
  const LoadedCase& loaded_;
  int threads_;
  RunLinks links_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  RunLog log_;
  StatusFile status_;
  RemainingTime remaining_;
  std::optional<ResultsFile> results_;
  std::optional<TableFile> table_;        ///< shear.csv or grain.csv
  std::optional<TableFile> wall_table_;   ///< walls.csv, of a direct shear test
  std::optional<TableFile> micro_table_;  ///< micro.csv, likewise
  std::optional<PreparationStore> store_;
  bool is_store_lost_ = false;  ///< it could not be written; the run goes on without
  bool is_direct_shear_;
  bool has_shear_begun_ = false;
  double past_wall_time_, last_checkpoint_;  ///< s of wall time, of all parts of the run
  std::string stage_;
  double peak_stress_ = 0.0;  ///< Pa, of the rows so far
  EnergyReport start_energy_, last_energy_;
  std::vector<FrameInfo> frames_;
  std::vector<std::string> warnings_;
  std::vector<StateProfile> profiles_;
  JsonObject branch_;  ///< of branch.json; empty for a test that started anew
};

}  // namespace dem
