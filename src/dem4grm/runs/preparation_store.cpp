// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/runs/preparation_store.hpp"

#include <unistd.h>

#include <fmt/format.h>

#include <cerrno>
#include <charconv>
#include <csignal>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>

#include "dem4grm/case_file/case_file.hpp"
#include "dem4grm/core/error.hpp"
#include "dem4grm/core/state_hash.hpp"
#include "dem4grm/results/output_file.hpp"
#include "dem4grm/runs/checkpoint_file.hpp"
#include "dem4grm/runs/folder_lock.hpp"

namespace dem {
namespace {

constexpr std::size_t k_digits = 12;  // of the fingerprint; the whole text is compared too

std::string fingerprint(const std::string& bytes) {
  StateHash hash;
  hash.add_bytes(bytes.data(), bytes.size());
  return hash.text();
}

}  // namespace

std::string preparation_text(const DirectShearCase& test) {
  DirectShearCase kept = test;
  const SpecimenSettings plain;
  kept.name = DirectShearCase{}.name;
  kept.specimen.relative_density = k_default_relative_density;
  kept.specimen.preparation_friction.reset();
  kept.specimen.relative_density_tolerance = plain.relative_density_tolerance;
  kept.specimen.smallest_friction = plain.smallest_friction;
  kept.specimen.largest_friction = plain.largest_friction;
  kept.specimen.branch_stress_ratio = plain.branch_stress_ratio;
  kept.specimen.load_steps.clear();
  kept.box.split_plane = SplitPlane::nominal;  // until the final friction
  kept.servo.shear_speed_cap = ServoSettings{}.shear_speed_cap;
  kept.shear = {};
  kept.recording = {};
  return resolved_toml(kept);
}

std::string program_fingerprint() {
  std::ifstream program("/proc/self/exe", std::ios::binary);
  if (!program) return {};
  return fingerprint(std::string(std::istreambuf_iterator<char>(program), {}));
}

PreparationStore::PreparationStore(const std::filesystem::path& folder, const DirectShearCase& test,
                                   const std::string& program)
    : text_(preparation_text(test)), has_program_(!program.empty()) {
  folder_ = folder / fingerprint(text_).substr(0, k_digits);
  text_ += "# program " + program + "\n";
}

std::filesystem::path PreparationStore::file_of(const std::string& name) const { return folder_ / (name + ".h5"); }

std::optional<StateArchive> PreparationStore::fetch(const std::string& name) const {
  std::error_code error;
  if (!has_program_ || !std::filesystem::exists(file_of(name), error)) return std::nullopt;
  try {
    StoredCheckpoint stored = read_checkpoint(file_of(name));
    if (stored.facts.resolved_toml != text_) return std::nullopt;
    return std::move(stored.state);
  } catch (const IoError&) {
    return std::nullopt;  // damaged or of another format: it is made again, and written over
  }
}

/// What processes of this machine that are no more left half written: NAME-HOST-PROCESS.part, or the draft of that.
void PreparationStore::remove_dead_drafts() const {
  const std::string of_this_machine = "-" + host_name() + "-";
  std::error_code error;
  std::filesystem::directory_iterator entry(folder_, error), end;
  for (; !error && entry != end; entry.increment(error)) {
    std::string name = entry->path().filename().string();
    if (name.ends_with(".tmp")) name.resize(name.size() - 4);
    const std::size_t at = name.rfind(of_this_machine);
    if (at == std::string::npos || !name.ends_with(".part")) continue;
    const std::string_view number = std::string_view(name).substr(at + of_this_machine.size());
    pid_t process = 0;
    const auto [rest, reason] = std::from_chars(number.data(), number.data() + number.size(), process);
    if (reason != std::errc() || std::string_view(rest, number.data() + number.size()) != ".part") continue;
    const bool is_dead = process > 0 && ::kill(process, 0) != 0 && errno == ESRCH;
    std::error_code ignored;
    if (is_dead) std::filesystem::remove(entry->path(), ignored);
  }
}

void PreparationStore::check_writable() const {
  make_folder();
  remove_dead_drafts();
  const std::filesystem::path probe = draft_of("probe");
  replace_file(probe, "");
  std::error_code ignored;
  std::filesystem::remove(probe, ignored);
}

void PreparationStore::make_folder() const {
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  if (error) throw IoError(fmt::format("{}: the folder cannot be made: {}", folder_.string(), error.message()));
}

std::filesystem::path PreparationStore::draft_of(const std::string& name) const {
  return folder_ / fmt::format("{}-{}-{}.part", name, host_name(), ::getpid());
}

void PreparationStore::keep(const std::string& name, const StateArchive& state) const {
  make_folder();
  // A draft of its own: another process, here or on another machine, may be keeping the same state.
  const std::filesystem::path draft = draft_of(name);
  write_checkpoint(draft, state, {text_, 0.0, {}});
  publish_file(draft, file_of(name));
}

}  // namespace dem
