// SPDX-License-Identifier: BSD-3-Clause
// One process for one output folder.
//
// The file run.lock names its owner for people; what decides is the lock of the operating system on that file, which
// ends with the process. So a killed run leaves no folder that nobody may use, and a process number that was given to
// another program in the meantime does no harm. The file of another host is not taken over, since its process cannot be
// seen from here, but for one case: the batch job that made it is this very job, put back into the queue by the scheduler
// after its node was lost, and nothing has been heard from the folder for two minutes.
#pragma once

#include <filesystem>
#include <string>

#include "dem4grm/core/error.hpp"

namespace dem {

/// The folder is in use by a live process; the message names host and process.
struct FolderInUseError : Error {
  explicit FolderInUseError(const std::string& message) : Error(ExitCode::folder_in_use, message) {}
};

class FolderLock {
 public:
  static constexpr const char* k_name = "run.lock";

  /// Of a folder on whose lock another host's process of the same batch job is silent, s.
  static constexpr double k_silence_of_lost_node = 120.0;

  /// Takes the lock of a folder that is there. `job`: what the scheduler calls the batch job of this process, the same after
  /// the job was put back into the queue; empty: none. Throws FolderInUseError, or IoError when the file cannot be written.
  explicit FolderLock(const std::filesystem::path& folder, std::string job = {});
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;
  /// Removes the lock file.
  ~FolderLock();

  /// What to tell the user when the lock of a dead process was taken over; empty otherwise.
  [[nodiscard]] const std::string& note() const { return note_; }

 private:
  bool try_once();
  void write_owner();

  std::filesystem::path path_;
  std::string job_;
  int descriptor_ = -1;
  std::string note_;
};

/// Name of this machine.
std::string host_name();
/// "2031-05-06T07:08:09Z" for seconds since 1970.
std::string utc_text(double seconds_since_1970);
/// Seconds since 1970.
double utc_now();

}  // namespace dem
