// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/runs/live_folder.hpp"

#include <cerrno>
#include <charconv>
#include <csignal>
#include <fstream>
#include <string>

#include "dem4grm/runs/folder_lock.hpp"

namespace dem {

std::optional<bool> is_folder_locked(const std::filesystem::path& folder) {
  std::ifstream file(folder / FolderLock::k_name);
  if (!file) return false;
  std::string host;
  pid_t pid = 0;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("host=")) host = line.substr(5);
    if (line.starts_with("pid=")) std::from_chars(line.data() + 4, line.data() + line.size(), pid);
  }
  if (pid <= 0) return true;  // made a moment ago; the owner is about to write its name
  if (host != host_name()) return std::nullopt;
  return ::kill(pid, 0) == 0 || errno == EPERM;
}

}  // namespace dem
