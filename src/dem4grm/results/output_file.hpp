// SPDX-License-Identifier: BSD-3-Clause
// Files that are written: every failure becomes an IoError with path and system message.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "dem4grm/core/error.hpp"

namespace dem {

/// "PATH: cannot be written: No space left on device", from errno.
[[noreturn]] void throw_io_error(const std::filesystem::path& path, std::string_view what);

/// Rethrows the error that is being handled, with the name of the file in front when it has none.
[[noreturn]] void rethrow_with_name(const std::filesystem::path& path, const IoError& error);

/// Runs work. Errors of a library name the object; the user needs the file.
template <class Work>
auto naming_file(const std::filesystem::path& path, const Work& work) {
  try {
    return work();
  } catch (const IoError& e) {
    rethrow_with_name(path, e);
  }
}

/// Replaces a file as a whole: written under another name, brought to the disk, then renamed. A reader sees the old
/// text or the new one. Throws IoError and leaves the old file.
void replace_file(const std::filesystem::path& path, std::string_view text);

/// Writes text over what a file holds, with spaces up to its old length: for a full disk, which has the place of the old text
/// but none for a new file. A reader may see half of it. False when it cannot be written.
bool overwrite_file(const std::filesystem::path& path, std::string text);

/// Copies a file to a new one. Throws IoError, also when there is one of that name, and leaves no half of a copy.
void copy_to_new_file(const std::filesystem::path& from, const std::filesystem::path& to);

/// Brings a draft that was written beside `path` to the disk and gives it that name, then the folder to the disk. With
/// `older` the file that has the name now gets that one first. Throws IoError, leaves the old file and removes the draft.
void publish_file(const std::filesystem::path& draft, const std::filesystem::path& path,
                  const std::filesystem::path& older = {});

/// Makes a new file; throws IoError, or Error with ExitCode::usage when it is there already.
void create_file(const std::filesystem::path& path, std::string_view text);

/// A file that grows; what was appended is at the operating system when append returns.
class AppendedFile {
 public:
  /// Opens an empty file, an old one is emptied. Throws IoError.
  explicit AppendedFile(std::filesystem::path path);
  AppendedFile(const AppendedFile&) = delete;
  AppendedFile& operator=(const AppendedFile&) = delete;
  ~AppendedFile();

  /// Throws IoError.
  void append(std::string_view text);
  /// Brings everything to the disk. Throws IoError.
  void sync();

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
};

/// The value in the fewest digits that read back as the same bits, independent of the locale.
void append_number(std::string& text, double value);

}  // namespace dem
