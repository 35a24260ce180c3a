// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/results/output_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <fstream>
#include <string>
#include <system_error>

#include <fmt/format.h>

#include "dem4grm/core/error.hpp"

namespace dem {
namespace {

constexpr int k_file_mode = 0666;  // less what the user's umask takes away

/// A new file at a place where one of an earlier process may lie. A link that somebody put there is not followed.
int open_draft(const std::filesystem::path& draft) {
  ::unlink(draft.c_str());
  return ::open(draft.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, k_file_mode);
}

/// Writes everything; false with errno set when it cannot.
bool write_all(int descriptor, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(descriptor, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    text.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

/// Some file systems (pipes, /dev/stdout) cannot sync; that is no failure to write.
bool sync_descriptor(int descriptor) {
  return ::fsync(descriptor) == 0 || errno == EINVAL || errno == EROFS || errno == ENOTSUP;
}

/// Brings a file or folder to the disk; false with errno set when it cannot.
bool sync_path(const std::filesystem::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return false;
  const bool is_synced = sync_descriptor(descriptor);
  const int reason = errno;
  ::close(descriptor);
  errno = reason;
  return is_synced;
}

/// Writes text and closes; on failure removes the file and throws.
void fill_and_close(int descriptor, const std::filesystem::path& path, std::string_view text) {
  bool is_good = write_all(descriptor, text) && sync_descriptor(descriptor);
  int reason = errno;
  if (::close(descriptor) != 0 && is_good) {
    is_good = false;
    reason = errno;
  }
  if (is_good) return;
  ::unlink(path.c_str());
  errno = reason;
  throw_io_error(path, "cannot be written");
}

void rename_draft(const std::filesystem::path& draft, const std::filesystem::path& path) {
  if (::rename(draft.c_str(), path.c_str()) == 0) return;
  const int reason = errno;
  ::unlink(draft.c_str());
  errno = reason;
  throw_io_error(path, "cannot be replaced");
}

}  // namespace

void throw_io_error(const std::filesystem::path& path, std::string_view what) {
  const int reason = errno == 0 ? EIO : errno;
  throw IoError(fmt::format("{}: {}: {}", path.string(), what, std::generic_category().message(reason)));
}

void rethrow_with_name(const std::filesystem::path& path, const IoError& error) {
  const std::string shown = path.string();
  if (std::string_view(error.what()).starts_with(shown)) throw;
  throw IoError(fmt::format("{}: {}", shown, error.what()));
}

void replace_file(const std::filesystem::path& path, std::string_view text) {
  std::filesystem::path draft = path;
  draft += ".tmp";
  const int descriptor = open_draft(draft);
  if (descriptor < 0) throw_io_error(path, "cannot be written");
  fill_and_close(descriptor, draft, text);
  rename_draft(draft, path);
}

bool overwrite_file(const std::filesystem::path& path, std::string text) {
  const int descriptor = ::open(path.c_str(), O_WRONLY | O_CLOEXEC | O_NOFOLLOW);
  if (descriptor < 0) return false;
  const off_t present = ::lseek(descriptor, 0, SEEK_END);
  if (present > static_cast<off_t>(text.size())) text.append(static_cast<std::size_t>(present) - text.size(), ' ');
  const bool is_good = ::lseek(descriptor, 0, SEEK_SET) == 0 && write_all(descriptor, text);
  return ::close(descriptor) == 0 && is_good;
}

void copy_to_new_file(const std::filesystem::path& from, const std::filesystem::path& to) {
  constexpr std::size_t k_piece = std::size_t{1} << 20U;
  std::ifstream source(from, std::ios::binary);
  if (!source) throw_io_error(from, "cannot be read");
  const int copy = ::open(to.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, k_file_mode);
  if (copy < 0) throw_io_error(to, "cannot be written");
  std::string piece(k_piece, '\0');
  bool is_good = true;
  while (is_good && source) {
    source.read(piece.data(), static_cast<std::streamsize>(piece.size()));
    is_good = write_all(copy, std::string_view(piece).substr(0, static_cast<std::size_t>(source.gcount())));
  }
  int reason = source.bad() ? EIO : errno;
  if (::close(copy) != 0 && is_good) {
    is_good = false;
    reason = errno;
  }
  if (is_good && !source.bad()) return;
  ::unlink(to.c_str());
  errno = reason;
  throw_io_error(to, "cannot be written");
}

void publish_file(const std::filesystem::path& draft, const std::filesystem::path& path,
                  const std::filesystem::path& older) {
  if (!sync_path(draft)) {
    const int reason = errno;
    ::unlink(draft.c_str());
    errno = reason;
    throw_io_error(path, "cannot be written");
  }
  // Between the two renames the file has its older name only: whoever reads looks for both.
  if (!older.empty() && ::rename(path.c_str(), older.c_str()) != 0 && errno != ENOENT) {
    const int reason = errno;
    ::unlink(draft.c_str());
    errno = reason;
    throw_io_error(path, "cannot be renamed");
  }
  rename_draft(draft, path);
  const std::filesystem::path folder = path.parent_path();
  if (!sync_path(folder.empty() ? "." : folder)) throw_io_error(path, "cannot be brought to the disk");
}

void create_file(const std::filesystem::path& path, std::string_view text) {
  const int descriptor = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, k_file_mode);
  if (descriptor < 0 && errno == EEXIST) {
    throw Error(ExitCode::usage, fmt::format("{}: is there already; remove it or choose another name", path.string()));
  }
  if (descriptor < 0) throw_io_error(path, "cannot be written");
  fill_and_close(descriptor, path, text);
}

AppendedFile::AppendedFile(std::filesystem::path path) : path_(std::move(path)) {
  descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, k_file_mode);
  if (descriptor_ < 0) throw_io_error(path_, "cannot be written");
}

AppendedFile::~AppendedFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void AppendedFile::append(std::string_view text) {
  if (!write_all(descriptor_, text)) throw_io_error(path_, "cannot be written");
}

void AppendedFile::sync() {
  if (!sync_descriptor(descriptor_)) throw_io_error(path_, "cannot be written");
}

void append_number(std::string& text, double value) {
  std::array<char, 32> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value);
  text.append(digits.data(), end.ptr);
}

}  // namespace dem
