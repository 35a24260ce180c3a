// SPDX-License-Identifier: BSD-3-Clause
#include "report_writer.hpp"

#include <fmt/format.h>

#include "dem4grm/core/error.hpp"
#include "dem4grm/results/output_file.hpp"
#include "terminal.hpp"

namespace dem {

ReportRequest new_report_request() {
  ReportRequest request;
  request.page = built_in_page();
  request.published = parse_published_values(shipped_published_values(), "published.csv");
  return request;
}

std::filesystem::path write_report_at_end(const std::filesystem::path& folder, bool is_quiet) {
  try {
    ReportRequest request = new_report_request();
    if (!request.page.is_there()) {
      if (!is_quiet)
        print_note("no report: this build carries no page, node and npm were not there (tools/build_page.sh)");
      return {};
    }
    request.folders = {folder};
    request.command = fmt::format("dem4grm report {}", folder.string());
    std::filesystem::path path = folder / k_report_file;
    replace_file(path, report_page(request).html);
    return path;
  } catch (const Error& error) {
    print_warning(fmt::format("no report was written, all results are there: {}", error.what()));
    return {};
  }
}

}  // namespace dem
