// SPDX-License-Identifier: BSD-3-Clause
// run.log: what happened in a run, with times.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

namespace dem {

/// Lines are added to what earlier runs in the same folder wrote. A log that cannot be written after it was opened
/// stops nothing: results matter more.
class RunLog {
 public:
  /// Throws IoError.
  explicit RunLog(const std::filesystem::path& path);
  RunLog(const RunLog&) = delete;
  RunLog& operator=(const RunLog&) = delete;
  ~RunLog();

  void info(const std::string& text);
  void warning(const std::string& text);
  void error(const std::string& text);

 private:
  struct Logger;
  std::unique_ptr<Logger> logger_;
};

}  // namespace dem
