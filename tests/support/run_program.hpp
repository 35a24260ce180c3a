// SPDX-License-Identifier: BSD-3-Clause
// Runs a program as a user would and keeps what it said; and folders that vanish after a test.
#pragma once

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace dem::test {

/// A new folder, removed with all its content at the end of its life.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "dem4grm-test-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    path_ = name;
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

inline std::string read_all(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

inline void write_all(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

/// Waits until the file is there; false after the time.
inline bool wait_for_file(const std::filesystem::path& path, double seconds) {
  for (int k = 0; k < static_cast<int>(seconds * 100.0); ++k) {
    if (std::filesystem::exists(path)) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

struct ProgramResult {
  int exit_code = -1;  ///< -1 when it died of a signal
  int signal = 0;
  std::string out, err;
};

/// A program on its way; its output goes to files, so it never waits for a reader.
class RunningProgram {
 public:
  /// arguments: program first. It runs in `folder`.
  RunningProgram(const std::vector<std::string>& arguments, const std::filesystem::path& folder) {
    const std::string out = (streams_ / "out").string(), err = (streams_ / "err").string();
    std::vector<char*> words;
    words.reserve(arguments.size() + 1);
    for (const std::string& word : arguments) words.push_back(const_cast<char*>(word.c_str()));
    words.push_back(nullptr);
    process_ = ::fork();
    if (process_ != 0) return;
    const int mode = O_WRONLY | O_CREAT | O_TRUNC;
    const bool is_ready = ::chdir(folder.c_str()) == 0 && ::dup2(::open(out.c_str(), mode, 0600), 1) == 1 &&
                          ::dup2(::open(err.c_str(), mode, 0600), 2) == 2;
    // As in a terminal, even when the tests run in the background of a shell that ignores them.
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) ::signal(signal, SIG_DFL);
    if (is_ready) ::execv(words[0], words.data());
    ::_exit(127);
  }
  RunningProgram(const RunningProgram&) = delete;
  RunningProgram& operator=(const RunningProgram&) = delete;
  ~RunningProgram() {
    if (process_ > 0) {
      ::kill(process_, SIGKILL);
      ::waitpid(process_, nullptr, 0);
    }
  }

  [[nodiscard]] pid_t process() const { return process_; }
  void send(int signal) const { ::kill(process_, signal); }

  ProgramResult wait() {
    int status = 0;
    while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) {
    }
    process_ = 0;
    ProgramResult result;
    if (WIFEXITED(status)) result.exit_code = WEXITSTATUS(status);
    if (WIFSIGNALED(status)) result.signal = WTERMSIG(status);
    result.out = read_all(streams_ / "out");
    result.err = read_all(streams_ / "err");
    return result;
  }

 private:
  TemporaryFolder streams_;
  pid_t process_ = 0;
};

inline ProgramResult run_program(const std::vector<std::string>& arguments, const std::filesystem::path& folder) {
  return RunningProgram(arguments, folder).wait();
}

}  // namespace dem::test
