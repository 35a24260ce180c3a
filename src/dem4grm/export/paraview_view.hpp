// SPDX-License-Identifier: BSD-3-Clause
// The script that opens an export in ParaView.
#pragma once

#include <filesystem>
#include <span>
#include <string>

namespace dem {

/// view.py for these series (k_series), which lie beside it. ParaView's window does not tell a script where it lies, so it
/// also knows the folder (absolute) that it was written to; run by pvpython it may be moved.
std::string view_script(std::span<const std::string> series, const std::filesystem::path& folder);

}  // namespace dem
