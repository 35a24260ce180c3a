// SPDX-License-Identifier: BSD-3-Clause
// Writes the page of a test or campaign where a run or campaign has ended.
#pragma once

#include <filesystem>

#include "dem4grm/report/report_page.hpp"

namespace dem {

/// A request with what this build carries: page, published values.
ReportRequest new_report_request();

/// report.html in the folder. A page is for looking at results that lie there already, so what stops it from being written is a
/// warning and no failure. Returns the path, or nothing.
std::filesystem::path write_report_at_end(const std::filesystem::path& folder, bool is_quiet);

}  // namespace dem
