// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/runs/test_writer.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "dem4grm/engine/kernel_target.hpp"
#include "dem4grm/lab/shear_velocity.hpp"
#include "dem4grm/results/micro_table.hpp"
#include "dem4grm/results/output_file.hpp"
#include "dem4grm/results/profile_file.hpp"
#include "dem4grm/results/specimen_file.hpp"
#include "dem4grm/runs/checkpoint_file.hpp"
#include "dem4grm/version.hpp"

namespace dem {
namespace {

ResultsOrigin origin_of(const LoadedCase& loaded) {
  const bool is_shear = std::holds_alternative<DirectShearCase>(loaded.test);
  return {is_shear ? "direct_shear" : "grain_compression", case_name(loaded.test), loaded.source_text,
          loaded.resolved_toml};
}

}  // namespace

RemainingTime remaining_time_of(const TestCase& test, bool is_specimen_only) {
  if (const auto* shear = std::get_if<DirectShearCase>(&test)) {
    return {"shear", is_specimen_only ? 0.0 : shear->shear.displacement / expected_shear_velocity(*shear)};
  }
  return {"compression", 0.0};
}

TestWriter::TestWriter(const OutputFolder& folder, const LoadedCase& loaded, int threads, const RunLinks& links,
                       double past_wall_time)
    : folder_(folder),
      loaded_(loaded),
      threads_(threads),
      links_(links),
      log_(folder.file(file_name::k_log)),
      status_(folder.file(file_name::k_status), case_name(loaded.test), threads),
      remaining_(remaining_time_of(loaded.test, links.is_specimen_only)),
      is_direct_shear_(std::holds_alternative<DirectShearCase>(loaded.test)),
      past_wall_time_(past_wall_time),
      last_checkpoint_(past_wall_time) {
  log_.info(fmt::format("dem4grm {} (commit {}, {}), host {}, {} thread{}, loops for processors of target {}",
                        k_version, k_commit, k_compiler, host_name(), threads, threads == 1 ? "" : "s",
                        kernel_target()));
  log_.info(fmt::format("case {}", case_name(loaded.test)));
  if (is_direct_shear_) {
    table_.emplace(folder.file(file_name::k_shear), shear_columns());
    store_.emplace(links.store.empty() ? folder.file(file_name::k_preparation) : links.store,
                   std::get<DirectShearCase>(loaded.test));
    wall_table_.emplace(folder.file(file_name::k_walls), wall_columns());
    micro_table_.emplace(folder.file(file_name::k_micro), micro_columns());
  } else {
    table_.emplace(folder.file(file_name::k_grain), compression_columns());
  }
  if (std::error_code ignored; std::filesystem::exists(folder.file(file_name::k_branch), ignored)) {
    branch_ = read_json_file(folder.file(file_name::k_branch));
  }
  for (const std::string& text : loaded.warnings) {
    log_.warning(text);
    warnings_.push_back(text);
  }
  if (store_) with_store([&] { store_->check_writable(); });
  // A run that goes on keeps the old file until it knows which states to keep.
  if (!folder.has_checkpoint()) results_.emplace(folder.file(file_name::k_results), origin_of(loaded));
  status_.set_state(is_direct_shear_ ? RunState::preparing : RunState::running);
}

double TestWriter::seconds() const {
  return past_wall_time_ + std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

void TestWriter::progress(const Progress& now) {
  remaining_.update(now, seconds());
  if (now.stage != stage_) {
    stage_ = now.stage;
    log_.info(fmt::format("stage {}{}", stage_,
                          now.time_step > 0.0 ? fmt::format(", time step {:.3e} s", now.time_step) : ""));
    if (stage_ == "shear" && !has_shear_begun_) {
      has_shear_begun_ = true;
      status_.set_state(RunState::running);
    }
  }
  status_.set_progress(now, remaining_);
  if (links_.listener != nullptr) links_.listener->progress(now);
  if (const std::sig_atomic_t cause = stop_cause(); cause != k_no_stop && !is_direct_shear_) {
    status_.set_state(RunState::stopping, stop_words(cause));
    throw StoppedOnRequest(
        ExitCode::interrupted,
        fmt::format("stopped {}; this test keeps no checkpoint, the same command starts it anew", stop_words(cause)));
  }
}

bool TestWriter::wants_checkpoint(bool is_new_stage) {
  return is_new_stage || must_save() || stop_cause() != k_no_stop ||
         seconds() - last_checkpoint_ >= links_.checkpoint_interval;
}

void TestWriter::checkpoint(const StateArchive& state) {
  const std::sig_atomic_t cause = stop_cause();  // asked once: a signal may come while the file is written
  const bool stops = cause != k_no_stop;
  if (stops) status_.set_state(RunState::stopping, stop_words(cause));
  if (must_save()) *links_.save_flag = 0;
  const double begin = seconds();
  write_checkpoint(folder_.file(file_name::k_checkpoint), state, {loaded_.resolved_toml, begin, {}},
                   folder_.file(file_name::k_previous_checkpoint));
  last_checkpoint_ = seconds();
  log_.info(fmt::format("checkpoint, written in {:.2f} s", last_checkpoint_ - begin));
  if (stops) {
    throw StoppedOnRequest(ExitCode::stopped,
                           fmt::format("stopped {}; the same command goes on from the checkpoint", stop_words(cause)));
  }
}

void TestWriter::end_state(const StateArchive& state) {
  write_checkpoint(folder_.file(file_name::k_end_state), state, {loaded_.resolved_toml, seconds(), {}});
}

void TestWriter::resumed(const ResumedRun& past) {
  try {
    results_.emplace(folder_.file(file_name::k_results), origin_of(loaded_), past.frames);
  } catch (const IoError& e) {
    throw IoError(
        fmt::format("{}. It held the {} states of the run so far, which the checkpoint does not; put the file back, or "
                    "remove {} and {} to start the run anew",
                    e.what(), past.frames.size(), file_name::k_checkpoint, file_name::k_previous_checkpoint));
  }
  frames_.assign(past.frames.begin(), past.frames.end());
  start_energy_.kinetic = past.start_energy.kinetic;
  start_energy_.contact_strain = past.start_energy.contact_strain;
  start_energy_.bond_strain = past.start_energy.bond_strain;
  for (const ShearRow& row : past.rows) take_row(row);
  for (const MicroRow& row : past.micro_rows) micro_table_->append(micro_values(row));
}

/// A store that cannot be written must not cost the run; what it holds is used all the same.
void TestWriter::with_store(const std::function<void()>& write) {
  try {
    write();
  } catch (const IoError& e) {
    is_store_lost_ = true;
    warning(fmt::format("{}; the run goes on, but later ones will not find its preparation", e.what()));
  }
}

std::optional<StateArchive> TestWriter::fetch_preparation(const std::string& name) {
  return store_ ? store_->fetch(name) : std::nullopt;
}

void TestWriter::keep_preparation(const std::string& name, const StateArchive& state) {
  if (store_ && !is_store_lost_) with_store([&] { store_->keep(name, state); });
}

void TestWriter::specimen_ready(const StateArchive& state, const SpecimenReport& report) {
  add_specimen_state(folder_.file(file_name::k_specimen), state);
  log_.info(fmt::format("specimen ready: void ratio {:.4f}, height {:.2f} mm", report.void_ratio_before_shear,
                        report.height * 1e3));
}

ResultsFile& TestWriter::results() {
  if (!results_) results_.emplace(folder_.file(file_name::k_results), origin_of(loaded_));
  return *results_;
}

void TestWriter::note(const std::string& text) {
  log_.info(text);
  if (links_.listener != nullptr) links_.listener->note(text);
}

void TestWriter::warning(const std::string& text) {
  log_.warning(text);
  warnings_.push_back(text);
  if (links_.listener != nullptr) links_.listener->warning(text);
}

void TestWriter::take_row(const ShearRow& row) {
  peak_stress_ = std::max(peak_stress_, row.shear_stress);
  const double imbalance = peak_stress_ > 0.0 ? std::fabs(row.half_force_difference) / peak_stress_ : 0.0;
  last_energy_ = row.energy;
  table_->append(shear_values(row, imbalance));
  wall_table_->append(wall_values(row));
}

void TestWriter::shear_row(const ShearRow& row) {
  take_row(row);
  if (links_.listener != nullptr) links_.listener->shear_row(row);
}

void TestWriter::micro_row(const MicroRow& row) {
  micro_table_->append(micro_values(row));
  if (links_.listener != nullptr) links_.listener->micro_row(row);
}

void TestWriter::compression_row(const CompressionRow& row) {
  last_energy_ = row.energy;
  table_->append(compression_values(row));
  if (links_.listener != nullptr) links_.listener->compression_row(row);
}

void TestWriter::frame(const Simulation& state, const FrameInfo& info) {
  if (frames_.empty()) {
    // Rows count the works from here on, but the stored energies from nothing.
    const EnergyReport now = state.energy();
    start_energy_.kinetic = now.kinetic;
    start_energy_.contact_strain = now.contact_strain;
    start_energy_.bond_strain = now.bond_strain;
    if (is_direct_shear_) {
      ResultsFile(folder_.file(file_name::k_specimen), origin_of(loaded_)).add_frame(state, info);
    }
  }
  results().add_frame(state, info);
  frames_.push_back(info);
  log_.info(fmt::format("state {} at {:.3f} mm, hash {}", info.number, info.displacement * 1e3, info.state_hash));
  if (links_.listener != nullptr) links_.listener->frame(state, info);
}

RunFacts TestWriter::facts() const {
  return {threads_,  seconds(), energy_closure_per_cent(start_energy_, last_energy_), frames_, warnings_,
          profiles_, branch_};
}

void TestWriter::write_tables() {
  sync_tables();
  // Without the file the run ended before it had anything of its own to add.
  if (!results_) return;
  std::vector<NamedTable> tables{{is_direct_shear_ ? "shear" : "compression", &*table_}};
  if (wall_table_) tables.push_back({"walls", &*wall_table_});
  if (micro_table_) tables.push_back({"micro", &*micro_table_});
  results_->add_tables(tables);
}

/// Read back from the file, so that a test that was stopped on its way has those of its earlier parts too.
void TestWriter::write_profiles() {
  profiles_ = read_profiles(folder_.file(file_name::k_results));
  TableFile table(folder_.file(file_name::k_profiles), profile_columns());
  append_profiles(table, profiles_);
  const std::array<NamedTable, 1> profiles{{{"profiles", &table}}};
  results_->add_tables(profiles);
}

void TestWriter::sync_tables() {
  table_->sync();
  if (wall_table_) wall_table_->sync();
  if (micro_table_) micro_table_->sync();
}

void TestWriter::write_summary(const JsonObject& summary) {
  std::error_code ignored;  // a checkpoint that stays behind does no harm
  replace_file(folder_.file(file_name::k_summary), json_text(summary));
  log_.info(fmt::format("finished after {:.1f} s, {} rows, state hash {}", number_in(summary, "wall_time_s"),
                        table_->rows(), text_in(summary, "state_hash")));
  status_.set_state(RunState::finished);
  for (const char* name : {file_name::k_checkpoint, file_name::k_previous_checkpoint}) {
    std::filesystem::remove(folder_.file(name), ignored);
  }
}

JsonObject TestWriter::finish(const DirectShearResult& result) {
  write_tables();
  write_profiles();
  JsonObject summary = direct_shear_summary(std::get<DirectShearCase>(loaded_.test), result, facts());
  write_summary(summary);
  return summary;
}

JsonObject TestWriter::finish_specimen(const DirectShearResult& result) {
  JsonObject summary = specimen_summary(std::get<DirectShearCase>(loaded_.test), result, facts());
  replace_file(folder_.file(file_name::k_specimen_summary), json_text(summary));
  status_.set_state(RunState::specimen_ready);
  return summary;
}

JsonObject TestWriter::finish(const GrainCompressionResult& result) {
  write_tables();
  JsonObject summary = grain_compression_summary(std::get<GrainCompressionCase>(loaded_.test), result, facts());
  write_summary(summary);
  return summary;
}

void TestWriter::give_up(RunState state, const std::string& cause, ExitCode code) noexcept {
  // Each part on its own: when one file cannot be written, another still may.
  const auto attempt = [](const auto& part) noexcept {
    try {
      part();
    } catch (...) {
    }
  };
  attempt([&] { state == RunState::failed ? log_.error(cause) : log_.info(cause); });
  // A run that will go on adds its record at its own end.
  const bool goes_on = is_direct_shear_ && state == RunState::stopped;
  attempt([&] { goes_on ? sync_tables() : write_tables(); });
  attempt([&] { status_.set_state(state, cause, code); });
}

}  // namespace dem
