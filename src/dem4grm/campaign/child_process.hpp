// SPDX-License-Identifier: BSD-3-Clause
// A program that runs beside this one.
#pragma once

#include <sys/types.h>

#include <csignal>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace dem {

/// How a process ended.
struct ProcessEnd {
  int exit_code = 0;  ///< 128 + number of a signal that killed it
  int signal = 0;     ///< 0: it ended by itself
};

class ChildProcess {
 public:
  /// Starts `command` (program and arguments) in a process group of its own, so that the signals of a terminal reach only this
  /// program, which passes them on once. Its standard input and output are empty, its messages go to `log`, which begins anew.
  /// When this program dies, it is asked to end (SIGTERM). Throws IoError when it cannot be started.
  ChildProcess(const std::vector<std::string>& command, const std::filesystem::path& log);
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;
  ChildProcess(ChildProcess&& other) noexcept : pid_(other.pid_) { other.pid_ = 0; }
  ChildProcess& operator=(ChildProcess&&) = delete;
  /// Asks it to end and waits for that.
  ~ChildProcess();

  /// Asks for an end; a second request would end the program without its checkpoint, so there is only one.
  void ask_for_end();
  /// By SIGUSR1, which dem4grm run understands.
  void ask_for_checkpoint();
  /// Does not wait; nothing while it runs.
  std::optional<ProcessEnd> poll();

 private:
  pid_t pid_;
  bool is_asked_ = false;
};

}  // namespace dem
