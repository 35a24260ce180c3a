// SPDX-License-Identifier: BSD-3-Clause
// One HTML file that shows tests or a campaign: opens from disk, asks for nothing from anywhere, can be mailed and printed.
//
//     dem::ReportRequest request;
//     request.folders = {"runs/quick"};
//     dem::replace_file("report.html", dem::report_page(request).html);
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "dem4grm/report/laboratory_curve.hpp"
#include "dem4grm/report/page_bundle.hpp"
#include "dem4grm/report/published_values.hpp"
#include "dem4grm/results/json_text.hpp"

namespace dem {

inline constexpr const char* k_report_file = "report.html";
/// Tests of which a page holds the 3D views; in a page of more it would be the sum of all.
inline constexpr std::size_t k_most_views = 4;

struct ReportRequest {
  std::vector<std::filesystem::path> folders;  ///< of tests, or one of a campaign
  std::vector<LaboratoryCurve> laboratory;
  std::vector<PublishedValue> published;
  PageBundle page;
  std::string command;              ///< that makes the page again
  int live_seconds = 0;             ///< > 0: the page loads itself anew so often
  int resamples = 200;              ///< of the confidence bands
  std::size_t states_in_view = 12;  ///< of each 3D view; 0: no views
};

struct ReportPage {
  std::string html;
  std::vector<std::string> notes;  ///< what could not be shown and why
  std::size_t tests = 0;
};

/// Everything that a user gave stands in the page as text, never as HTML. Throws MissingFileError for a folder that holds neither a
/// test nor a campaign, or when a campaign is given beside other folders, and for a request without a page bundle.
ReportPage report_page(const ReportRequest& request);

/// The data of the page alone (interface PageData of web/src/data.ts).
JsonObject report_data(const ReportRequest& request, std::vector<std::string>& notes);

/// Text that may stand between HTML tags and in attributes.
std::string html_text(std::string_view text);

}  // namespace dem
