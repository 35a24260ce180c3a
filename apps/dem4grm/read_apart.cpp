// SPDX-License-Identifier: BSD-3-Clause
#include "read_apart.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <exception>
#include <iostream>
#include <new>

#include <fmt/format.h>

#include "dem4grm/core/error.hpp"
#include "terminal.hpp"

namespace dem {
namespace {

int number_of(ExitCode code) { return static_cast<int>(code); }

int exit_code_of(const std::function<void()>& work) {
  try {
    work();
    return number_of(std::cout.flush() ? ExitCode::done : ExitCode::io);
  } catch (const Error& error) {
    print_error(error.what());
    return number_of(error.code());
  } catch (const std::bad_alloc&) {
    print_error("out of memory");
    return number_of(ExitCode::memory);
  } catch (const std::exception& error) {
    print_error(fmt::format("internal error: {}; please report it", error.what()));
    return number_of(ExitCode::internal);
  }
}

}  // namespace

void read_apart(const std::string& what, const std::function<void()>& work) {
  std::cout.flush();
  const pid_t reader = ::fork();
  if (reader < 0) {
    work();
    return;
  }
  if (reader == 0) {
    const int code = exit_code_of(work);
    std::cerr.flush();
    std::fflush(nullptr);
    ::_exit(code);
  }
  int status = 0;
  while (::waitpid(reader, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return;
  if (WIFEXITED(status)) throw ReaderEnded{WEXITSTATUS(status)};
  if (WTERMSIG(status) == SIGINT || WTERMSIG(status) == SIGTERM) throw ReaderEnded{number_of(ExitCode::interrupted)};
  throw IoError(fmt::format(
      "{}: the HDF5 library crashed while it read the file (signal {}): it is damaged, or was made to do harm", what,
      WTERMSIG(status)));
}

}  // namespace dem
