// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/campaign/child_process.hpp"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include <fmt/format.h>

#include "dem4grm/core/error.hpp"

namespace dem {
namespace {

/// Between fork and exec: nothing here may allocate.
[[noreturn]] void become(char* const* arguments, int log, pid_t parent) {
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);
  const int nothing = ::open("/dev/null", O_RDWR | O_CLOEXEC);
  // The parent may have died before the request was in force.
  if (nothing < 0 || ::getppid() != parent) ::_exit(127);
  ::dup2(nothing, STDIN_FILENO);
  ::dup2(nothing, STDOUT_FILENO);
  ::dup2(log, STDERR_FILENO);
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
  std::signal(SIGUSR1, SIG_IGN);  // until it can answer
  ::execv(arguments[0], arguments);
  ::_exit(127);
}

}  // namespace

ChildProcess::ChildProcess(const std::vector<std::string>& command, const std::filesystem::path& log) : pid_(0) {
  const int messages = ::open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  const auto fail = [&](const std::filesystem::path& path) {
    throw IoError(fmt::format("{}: {}", path.string(), std::error_code(errno, std::generic_category()).message()));
  };
  if (messages < 0) fail(log);
  std::vector<std::string> words = command;
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const pid_t parent = ::getpid();
  const pid_t pid = ::fork();
  if (pid == 0) become(arguments.data(), messages, parent);
  const int reason = errno;
  ::close(messages);
  errno = reason;
  if (pid < 0) fail(command.front());
  pid_ = pid;
}

ChildProcess::~ChildProcess() {
  if (pid_ <= 0) return;
  ask_for_end();
  while (::waitpid(pid_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

void ChildProcess::ask_for_end() {
  if (pid_ <= 0 || is_asked_) return;
  is_asked_ = true;
  ::kill(pid_, SIGTERM);
}

void ChildProcess::ask_for_checkpoint() {
  if (pid_ > 0) ::kill(pid_, SIGUSR1);
}

std::optional<ProcessEnd> ChildProcess::poll() {
  int status = 0;
  if (pid_ <= 0 || ::waitpid(pid_, &status, WNOHANG) != pid_) return std::nullopt;
  pid_ = 0;
  if (WIFSIGNALED(status)) return ProcessEnd{128 + WTERMSIG(status), WTERMSIG(status)};
  return ProcessEnd{WEXITSTATUS(status), 0};
}

}  // namespace dem
