// SPDX-License-Identifier: BSD-3-Clause
#include "fault/failing_calls.hpp"

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/uio.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdarg>
#include <new>
#include <string_view>

#include "dem4grm/core/error.hpp"

namespace dem::test {
namespace {

/// Of the child; in memory that the parent sees.
struct Plan {
  bool is_armed = false, was_due = false;
  Fault fault = Fault::kill;
  int at = 0, calls = 0;
  std::array<char, 1 << 16> log{};  ///< names of the calls, a space behind each
  std::size_t logged = 0;
};
Plan* plan = nullptr;

/// True when this call must fail; does not return when it must kill.
bool is_hit(std::string_view name) {
  if (plan == nullptr || !plan->is_armed) return false;
  if (plan->logged + name.size() + 1 < plan->log.size()) {
    plan->logged += name.copy(plan->log.data() + plan->logged, name.size());
    plan->log[plan->logged++] = ' ';
  }
  if (++plan->calls != plan->at) return false;
  plan->was_due = true;
  if (plan->fault == Fault::kill) ::kill(::getpid(), SIGKILL);
  errno = plan->fault == Fault::full_disk ? ENOSPC : EIO;
  return true;
}

template <class Function>
Function* real(const char* name) {
  return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

}  // namespace

FaultEnd run_with_fault(Fault fault, int at, const std::function<void()>& work) {
  void* shared = ::mmap(nullptr, sizeof(Plan), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  plan = new (shared) Plan{.is_armed = true, .fault = fault, .at = at};
  const pid_t child = ::fork();
  if (child == 0) {
    int code = 0;
    try {
      work();
    } catch (const Error& e) {
      code = static_cast<int>(e.code());
    }
    plan->is_armed = false;
    ::_exit(code);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  FaultEnd end{plan->was_due, WIFSIGNALED(status), WIFEXITED(status) ? WEXITSTATUS(status) : -1,
               std::string(plan->log.data(), plan->logged)};
  plan = nullptr;
  ::munmap(shared, sizeof(Plan));
  return end;
}

}  // namespace dem::test

// The linker lets these come before those of the C library.
extern "C" {

ssize_t write(int descriptor, const void* data, std::size_t bytes) {
  static auto* const next = dem::test::real<ssize_t(int, const void*, std::size_t)>("write");
  return dem::test::is_hit("write") ? -1 : next(descriptor, data, bytes);
}

ssize_t writev(int descriptor, const iovec* pieces, int count) {
  static auto* const next = dem::test::real<ssize_t(int, const iovec*, int)>("writev");
  return dem::test::is_hit("writev") ? -1 : next(descriptor, pieces, count);
}

ssize_t pwrite(int descriptor, const void* data, std::size_t bytes, off_t at) {
  static auto* const next = dem::test::real<ssize_t(int, const void*, std::size_t, off_t)>("pwrite");
  return dem::test::is_hit("pwrite") ? -1 : next(descriptor, data, bytes, at);
}

ssize_t pwrite64(int descriptor, const void* data, std::size_t bytes, off64_t at) {
  static auto* const next = dem::test::real<ssize_t(int, const void*, std::size_t, off64_t)>("pwrite64");
  return dem::test::is_hit("pwrite64") ? -1 : next(descriptor, data, bytes, at);
}

int fsync(int descriptor) {
  static auto* const next = dem::test::real<int(int)>("fsync");
  return dem::test::is_hit("fsync") ? -1 : next(descriptor);
}

int ftruncate(int descriptor, off_t length) noexcept {
  static auto* const next = dem::test::real<int(int, off_t)>("ftruncate");
  return dem::test::is_hit("ftruncate") ? -1 : next(descriptor, length);
}

int ftruncate64(int descriptor, off64_t length) noexcept {
  static auto* const next = dem::test::real<int(int, off64_t)>("ftruncate64");
  return dem::test::is_hit("ftruncate64") ? -1 : next(descriptor, length);
}

int rename(const char* from, const char* to) noexcept {
  static auto* const next = dem::test::real<int(const char*, const char*)>("rename");
  return dem::test::is_hit("rename") ? -1 : next(from, to);
}

int close(int descriptor) {
  static auto* const next = dem::test::real<int(int)>("close");
  const bool fails = dem::test::is_hit("close");
  const int reason = errno;
  const int result = next(descriptor);  // it is closed all the same, as the system does
  if (!fails) return result;
  errno = reason;
  return -1;
}

int open(const char* path, int flags, ...) {
  static auto* const next = dem::test::real<int(const char*, int, ...)>("open");
  va_list arguments;
  va_start(arguments, flags);
  const int mode = (flags & O_CREAT) != 0 ? va_arg(arguments, int) : 0;
  va_end(arguments);
  return dem::test::is_hit("open") ? -1 : next(path, flags, mode);
}

int open64(const char* path, int flags, ...) {
  static auto* const next = dem::test::real<int(const char*, int, ...)>("open64");
  va_list arguments;
  va_start(arguments, flags);
  const int mode = (flags & O_CREAT) != 0 ? va_arg(arguments, int) : 0;
  va_end(arguments);
  return dem::test::is_hit("open64") ? -1 : next(path, flags, mode);
}

}  // extern "C"
