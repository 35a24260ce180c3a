// SPDX-License-Identifier: BSD-3-Clause
// A look at an output folder from outside: is a process at work in it?
#pragma once

#include <filesystem>
#include <optional>

namespace dem {

/// Judged by the name in run.lock, without touching its lock: a probe that took it, for however short a moment, would turn a
/// process away that just begins. Nothing when the process belongs to another machine and cannot be seen from here.
std::optional<bool> is_folder_locked(const std::filesystem::path& folder);

}  // namespace dem
