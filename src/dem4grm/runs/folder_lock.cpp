// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/runs/folder_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <ctime>
#include <string_view>
#include <thread>
#include <utility>

#include <fmt/format.h>

#include "dem4grm/results/output_file.hpp"

namespace dem {
namespace {

/// What a lock file says: "host=...\npid=...\nstart=...\njob=...\n".
struct Owner {
  std::string host, start, job;
  pid_t pid = 0;
};

std::string value_after(std::string_view text, std::string_view name) {
  const std::size_t at = text.find(name);
  if (at == std::string_view::npos) return {};
  text.remove_prefix(at + name.size());
  return std::string(text.substr(0, text.find('\n')));
}

Owner read_owner(int descriptor) {
  std::array<char, 512> bytes{};
  const ssize_t n = ::pread(descriptor, bytes.data(), bytes.size(), 0);
  const std::string_view text(bytes.data(), n > 0 ? static_cast<std::size_t>(n) : 0);
  Owner owner{value_after(text, "host="), value_after(text, "start="), value_after(text, "job="), 0};
  const std::string pid = value_after(text, "pid=");
  if (!pid.empty() && pid.size() < 10 && pid.find_first_not_of("0123456789") == std::string::npos) {
    owner.pid = static_cast<pid_t>(std::stol(pid));
  }
  return owner;
}

/// The owner writes its name just after it took the lock; it is given a moment for that.
Owner read_live_owner(int descriptor) {
  Owner owner = read_owner(descriptor);
  for (int k = 0; k < 20 && owner.pid == 0; ++k) {
    std::this_thread::sleep_for(std::chrono::milliseconds(25));
    owner = read_owner(descriptor);
  }
  return owner;
}

bool is_alive(pid_t pid) { return pid > 0 && (::kill(pid, 0) == 0 || errno == EPERM); }

[[noreturn]] void throw_in_use(const std::filesystem::path& path, const Owner& owner, std::string_view hint) {
  throw FolderInUseError(fmt::format("{} is in use by process {} on host {} since {}{}", path.parent_path().string(),
                                     owner.pid, owner.host.empty() ? "unknown" : owner.host,
                                     owner.start.empty() ? "a moment ago" : owner.start, hint));
}

/// True while the descriptor still is the file of that name; its owner may have removed it in the meantime.
bool is_same_file(int descriptor, const std::filesystem::path& path) {
  struct stat open_file {};
  struct stat named_file {};
  return ::fstat(descriptor, &open_file) == 0 && ::stat(path.c_str(), &named_file) == 0 &&
         open_file.st_dev == named_file.st_dev && open_file.st_ino == named_file.st_ino;
}

/// True when the process that works in the folder has not written its status for so long that it must have ended.
bool is_silent(const std::filesystem::path& folder) {
  struct stat status {};
  if (::stat((folder / "status.json").c_str(), &status) != 0) return true;
  return utc_now() - static_cast<double>(status.st_mtime) > FolderLock::k_silence_of_lost_node;
}

}  // namespace

FolderLock::FolderLock(const std::filesystem::path& folder, std::string job)
    : path_(folder / k_name), job_(std::move(job)) {
  try {
    while (!try_once()) {
    }
    write_owner();
  } catch (...) {
    if (descriptor_ >= 0) ::close(descriptor_);
    throw;
  }
}

/// False when the file vanished meanwhile and the attempt must be repeated.
bool FolderLock::try_once() {
  bool is_new = true;
  descriptor_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0644);
  if (descriptor_ < 0 && errno == EEXIST) {
    is_new = false;
    descriptor_ = ::open(path_.c_str(), O_RDWR | O_CLOEXEC);
    if (descriptor_ < 0 && errno == ENOENT) return false;
  }
  if (descriptor_ < 0) throw_io_error(path_, "cannot be written");
  const bool is_locked = ::flock(descriptor_, LOCK_EX | LOCK_NB) == 0;
  if (!is_locked && errno == EWOULDBLOCK) throw_in_use(path_, read_live_owner(descriptor_), "");
  if (is_locked && !is_same_file(descriptor_, path_)) {
    ::close(descriptor_);
    descriptor_ = -1;
    return false;
  }
  if (is_new) return true;
  const Owner owner = read_owner(descriptor_);
  if (!owner.host.empty() && owner.host != host_name()) {
    if (!job_.empty() && owner.job == job_ && is_silent(path_.parent_path())) {
      note_ = fmt::format("took over the lock of host {}: batch job {} was put back into the queue", owner.host, job_);
      return true;
    }
    throw_in_use(path_, owner, fmt::format("; if that process is dead for certain, remove {}", path_.string()));
  }
  // File systems without locks: the process number is all there is.
  if (!is_locked && is_alive(owner.pid)) throw_in_use(path_, owner, "");
  note_ = fmt::format("took over the lock of process {}, which ended without releasing it", owner.pid);
  return true;
}

void FolderLock::write_owner() {
  const std::string text = fmt::format("host={}\npid={}\nstart={}\njob={}\n", host_name(),
                                       static_cast<long>(::getpid()), utc_text(utc_now()), job_);
  const bool is_written = ::ftruncate(descriptor_, 0) == 0 &&
                          ::pwrite(descriptor_, text.data(), text.size(), 0) == static_cast<ssize_t>(text.size());
  if (is_written) return;
  const int reason = errno;
  ::unlink(path_.c_str());
  errno = reason;
  throw_io_error(path_, "cannot be written");
}

FolderLock::~FolderLock() {
  ::unlink(path_.c_str());
  ::close(descriptor_);
}

std::string host_name() {
  std::array<char, 256> name{};
  if (::gethostname(name.data(), name.size() - 1) != 0) return "unknown";
  return name.data();
}

std::string utc_text(double seconds_since_1970) {
  const auto seconds = static_cast<std::time_t>(seconds_since_1970);
  std::tm parts{};
  if (::gmtime_r(&seconds, &parts) == nullptr) return "unknown";
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text.data();
}

double utc_now() { return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count(); }

}  // namespace dem
