// SPDX-License-Identifier: BSD-3-Clause
// The folder of one run, and what it holds before.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "dem4grm/case_file/case_file.hpp"
#include "dem4grm/results/file_names.hpp"
#include "dem4grm/runs/folder_lock.hpp"

namespace dem {

enum class FolderContent {
  nothing,     ///< no folder, or none of our files in it
  unfinished,  ///< the same case, begun and not finished
  complete,    ///< the same case, finished
  shorter,     ///< the same case but for a smaller shear.displacement, with a state from which it can go on
  other_case,
};

/// Looks into a folder without touching it. Throws IoError when it cannot be looked into.
FolderContent look_into(const std::filesystem::path& folder, const LoadedCase& loaded);

/// "runs/<case name>", with every character that is unusual in a file name replaced.
std::filesystem::path default_folder(const std::string& case_name);

/// A folder that belongs to this process until the object goes.
class OutputFolder {
 public:
  /// Makes the folder, takes its lock, removes what an unfinished run without a checkpoint left, writes case.toml and
  /// resolved.toml.
  /// `job` as for FolderLock. `plant` fills a folder from which no checkpoint goes on, and leaves one, where the test starts from a
  /// state of another one; `origin` is the text of branch.json then. Throws FolderInUseError, IoError, and Error with
  /// ExitCode::usage when it holds another case, or a branch of a test that it has no checkpoint of any more.
  OutputFolder(std::filesystem::path path, const LoadedCase& loaded, const std::string& job = {},
               const std::function<void(const std::filesystem::path&)>& plant = {}, const std::string& origin = {});

  [[nodiscard]] std::filesystem::path file(const char* name) const { return path_ / name; }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// What the folder held when the lock was taken; `complete` means that nothing was touched.
  [[nodiscard]] FolderContent found() const { return found_; }
  /// True when there is a checkpoint to go on from; then the other files of the run are there too.
  [[nodiscard]] bool has_checkpoint() const { return has_checkpoint_; }
  /// True when the folder has just got the state of another test to start from.
  [[nodiscard]] bool is_planted() const { return is_planted_; }
  [[nodiscard]] const std::string& lock_note() const { return lock_->note(); }

 private:
  /// Makes an ended test one that goes on to a larger displacement.
  void become_longer(const LoadedCase& loaded);

  std::filesystem::path path_;
  std::unique_ptr<FolderLock> lock_;
  FolderContent found_ = FolderContent::nothing;
  bool has_checkpoint_ = false, is_planted_ = false;
};

}  // namespace dem
