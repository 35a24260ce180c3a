// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/results/sealed_file.hpp"

#include <fmt/format.h>

#include <sys/stat.h>

#include <array>
#include <charconv>
#include <fstream>
#include <mutex>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "dem4grm/core/error.hpp"
#include "dem4grm/core/state_hash.hpp"
#include "dem4grm/results/output_file.hpp"

namespace dem {
namespace {

constexpr std::string_view k_first_line = "dem4grm sealed file 1\n", k_length = "length ";
constexpr std::size_t k_piece = std::size_t{1} << 20U;

struct Content {
  std::string head;          ///< the first k_seal_bytes, or what there is
  std::uint64_t length = 0;  ///< bytes
  std::string fingerprint;   ///< of what follows the head
};

Content read_content(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw_io_error(path, "cannot be read");
  Content out;
  out.head.resize(k_seal_bytes);
  file.read(out.head.data(), static_cast<std::streamsize>(k_seal_bytes));
  out.head.resize(static_cast<std::size_t>(file.gcount()));
  out.length = out.head.size();
  StateHash hash;
  std::vector<char> piece(k_piece);
  while (file) {
    file.read(piece.data(), static_cast<std::streamsize>(piece.size()));
    const auto n = static_cast<std::size_t>(file.gcount());
    hash.add_bytes(piece.data(), n);
    out.length += n;
  }
  if (file.bad()) throw_io_error(path, "cannot be read");
  out.fingerprint = hash.text();
  return out;
}

std::string seal_of(const Content& content) {
  std::string seal = fmt::format("{}{}{}\nxxh3-128 {}\n", k_first_line, k_length, content.length, content.fingerprint);
  seal.resize(k_seal_bytes, '\0');
  return seal;
}

/// Which file, and which content of it, as far as the operating system tells: file system, number, length and last change.
using FileContent = std::array<std::int64_t, 5>;

FileContent identity_of(const std::filesystem::path& path) {
  struct stat found {};
  if (::stat(path.c_str(), &found) != 0) throw_io_error(path, "cannot be read");
  return {static_cast<std::int64_t>(found.st_dev), static_cast<std::int64_t>(found.st_ino), found.st_size,
          found.st_ctim.tv_sec, found.st_ctim.tv_nsec};
}

/// Files that were found whole. A report reads the states of one file one after the other, each through a function that checks.
class KnownFiles {
 public:
  bool has(const FileContent& content) {
    const std::lock_guard lock(mutex_);
    return whole_.contains(content);
  }
  void add(const FileContent& content) {
    const std::lock_guard lock(mutex_);
    whole_.insert(content);
  }

 private:
  std::mutex mutex_;
  std::set<FileContent> whole_;
};

/// The length that a seal tells; 0 when it tells none.
std::uint64_t told_length(std::string_view head) {
  std::uint64_t length = 0;
  const std::size_t at = k_first_line.size() + k_length.size();
  if (head.substr(k_first_line.size()).starts_with(k_length)) {
    std::from_chars(head.data() + at, head.data() + head.size(), length);
  }
  return length;
}

}  // namespace

void seal_file(const std::filesystem::path& path) {
  const std::string seal = seal_of(read_content(path));
  std::fstream file(path, std::ios::binary | std::ios::in | std::ios::out);
  file.write(seal.data(), static_cast<std::streamsize>(seal.size()));
  file.close();
  if (!file) throw_io_error(path, "cannot be written");
}

void check_seal(const std::filesystem::path& path) {
  const Content content = read_content(path);
  const std::string shown = path.string();
  if (!std::string_view(content.head).starts_with(k_first_line)) {
    throw IoError(fmt::format("{}: has no seal of dem4grm: damaged at its beginning, or another file", shown));
  }
  if (content.head == seal_of(content)) return;
  const std::uint64_t told = told_length(content.head);
  if (told != content.length) {
    throw IoError(fmt::format("{}: is damaged: {} bytes where its seal tells {}", shown, content.length, told));
  }
  throw IoError(fmt::format("{}: is damaged: its content does not fit its seal", shown));
}

bool has_seal(const std::filesystem::path& path) {
  constexpr std::string_view k_signature = "\x89HDF\r\n\x1a\n";
  std::ifstream file(path, std::ios::binary);
  if (!file) throw_io_error(path, "cannot be read");
  std::string head(k_signature.size(), '\0');
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  return head != k_signature;
}

void check_seal_once(const std::filesystem::path& path) {
  static KnownFiles known;
  const FileContent content = identity_of(path);
  if (known.has(content) || !has_seal(path)) return;
  check_seal(path);
  known.add(content);
}

}  // namespace dem
