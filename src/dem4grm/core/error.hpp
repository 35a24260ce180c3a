// SPDX-License-Identifier: BSD-3-Clause
// The errors that leave the library. Each knows the exit code that the command line returns for it.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace dem {

/// Exit codes of the program; the meaning is part of the public interface (docs/reference/command-line.md).
enum class ExitCode : int {
  done = 0,
  missed = 1,
  usage = 64,
  bad_case = 65,
  missing_file = 66,
  internal = 70,
  memory = 71,
  folder_in_use = 73,
  io = 74,
  stopped = 75,
  physics = 76,
  interrupted = 130,
};

/// Base of all errors that the library throws on purpose; what() is one complete message for the user.
class Error : public std::runtime_error {
 public:
  Error(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  [[nodiscard]] ExitCode code() const { return code_; }

 private:
  ExitCode code_;
};

/// The case file, a grading or an option is wrong; the message lists every problem.
struct InputError : Error {
  explicit InputError(const std::string& message, std::vector<std::string> each = {})
      : Error(ExitCode::bad_case, message), problems(std::move(each)) {}
  /// One by one, where a file was read as a whole; empty: the message is the one.
  std::vector<std::string> problems;
};
/// A file that was asked for is not there or cannot be read.
struct MissingFileError : Error {
  explicit MissingFileError(const std::string& message) : Error(ExitCode::missing_file, message) {}
};
/// Writing failed: disk full, no permission, broken file.
struct IoError : Error {
  explicit IoError(const std::string& message) : Error(ExitCode::io, message) {}
};
/// The physics went wrong: not-a-number, lost grain, runaway overlap, no equilibrium.
struct PhysicsError : Error {
  explicit PhysicsError(const std::string& message) : Error(ExitCode::physics, message) {}
};
/// A rule of the program itself is broken: a bug.
struct InternalError : Error {
  explicit InternalError(const std::string& message) : Error(ExitCode::internal, message) {}
};

/// Throws InternalError with the text when the condition does not hold. Not for hot loops.
inline void require(bool condition, const char* what) {
  if (!condition) throw InternalError(std::string("internal check failed: ") + what);
}

}  // namespace dem
