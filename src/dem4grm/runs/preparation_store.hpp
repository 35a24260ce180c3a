// SPDX-License-Identifier: BSD-3-Clause
// States of preparations that later ones may begin with: the random fill, and branches at rest under a stress.
//
// A state is handed over only to a preparation that would arrive at the same bits: materials, box, gradings, seed and
// rules of rest must agree, and the program must be the same to the byte. Friction and stress are in the name of a state.
// So a test ends with the same bits whether it found states or not.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "dem4grm/core/state_archive.hpp"
#include "dem4grm/lab/case.hpp"

namespace dem {

/// The case as TOML without what does not matter to the states kept: name, target of the search, stresses, shear, record.
std::string preparation_text(const DirectShearCase& test);

/// Fingerprint of the running program; empty when it cannot be read, and then nothing is handed over.
std::string program_fingerprint();

class PreparationStore {
 public:
  /// States of this case lie in a subfolder of `folder`, named by the fingerprint of preparation_text. Several processes
  /// may share a folder.
  PreparationStore(const std::filesystem::path& folder, const DirectShearCase& test,
                   const std::string& program = program_fingerprint());

  /// A state that was kept under that name; nothing when there is none, or none that can be used.
  [[nodiscard]] std::optional<StateArchive> fetch(const std::string& name) const;
  /// Writes an empty file and removes it, and the drafts of processes of this machine that have died. Throws IoError when
  /// the store cannot be written.
  void check_writable() const;
  /// Throws IoError when it cannot be written.
  void keep(const std::string& name, const StateArchive& state) const;

 private:
  [[nodiscard]] std::filesystem::path file_of(const std::string& name) const;
  /// Of this process alone.
  [[nodiscard]] std::filesystem::path draft_of(const std::string& name) const;
  void make_folder() const;
  void remove_dead_drafts() const;

  std::filesystem::path folder_;
  std::string text_;  ///< what a state must agree with: case and program
  bool has_program_;
};

}  // namespace dem
