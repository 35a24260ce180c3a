// SPDX-License-Identifier: BSD-3-Clause
// dem4grm report: tests or a campaign as one page.
#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <fmt/format.h>

#include "dem4grm/case_file/text_file.hpp"
#include "dem4grm/core/error.hpp"
#include "dem4grm/results/file_names.hpp"
#include "dem4grm/results/output_file.hpp"
#include "dem4grm/runs/live_folder.hpp"
#include "read_apart.hpp"
#include "report_writer.hpp"
#include "signals.hpp"
#include "terminal.hpp"
#include "verbs.hpp"

namespace dem {
namespace {

struct ReportOptions {
  std::vector<std::string> folders, laboratory;
  std::string output, page, published;
  int resamples = 200, states = 12, live = 0;
  bool is_data = false, is_quiet = false;
};

ReportRequest request_from(const ReportOptions& options) {
  ReportRequest request = new_report_request();
  if (!options.page.empty()) request.page = page_in(options.page);
  if (!options.published.empty()) {
    request.published = parse_published_values(read_text_file(options.published), options.published);
  }
  request.command = "dem4grm report";
  for (const std::string& folder : options.folders) {
    request.folders.emplace_back(folder);
    request.command += " " + folder;
  }
  for (const std::string& file : options.laboratory) {
    request.laboratory.push_back(read_laboratory_curve(file));
    request.command += " --lab " + file;
    if (!options.is_quiet) print_note(fmt::format("{}: {}", file, request.laboratory.back().note));
  }
  request.resamples = options.resamples;
  request.states_in_view = static_cast<std::size_t>(options.states);
  return request;
}

std::filesystem::path place_of(const ReportOptions& options) {
  if (!options.output.empty()) return options.output;
  return options.folders.size() == 1 ? std::filesystem::path(options.folders.front()) / k_report_file
                                     : std::filesystem::path(k_report_file);
}

/// True while a process works in one of the folders.
bool is_any_at_work(const ReportOptions& options) {
  for (const std::string& folder : options.folders) {
    if (is_folder_locked(folder).value_or(false)) return true;
  }
  return false;
}

void write_page(const ReportOptions& options, ReportRequest& request, int live_seconds) {
  request.live_seconds = live_seconds;
  const ReportPage page = report_page(request);
  replace_file(place_of(options), page.html);
  if (options.is_quiet || live_seconds > 0) return;
  for (const std::string& note : page.notes) print_note(note);
  print_result(fmt::format("{}: {} test{}, {:.1f} MB\n", place_of(options).string(), page.tests,
                           page.tests == 1 ? "" : "s", 1e-6 * static_cast<double>(page.html.size())));
}

void report(const ReportOptions& options) {
  ReportRequest request = request_from(options);
  if (options.is_data) {
    std::vector<std::string> notes;
    print_result(compact_json_text(report_data(request, notes)) + "\n");
    return;
  }
  if (options.live > 0) {
    install_signals();
    if (!options.is_quiet) {
      print_note(fmt::format("{} is written anew every {} s while the test runs; Ctrl-C ends that",
                             place_of(options).string(), options.live));
    }
    while (stop_requested == 0 && is_any_at_work(options)) {
      write_page(options, request, options.live);
      for (int k = 0; k < 10 * options.live && stop_requested == 0 && is_any_at_work(options); ++k) {
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
      }
    }
  }
  write_page(options, request, 0);
}

}  // namespace

void add_report(CLI::App& app) {
  CLI::App* verb = app.add_subcommand("report", "tests or a campaign as one page to look at and mail");
  const auto options = std::make_shared<ReportOptions>();
  verb->add_option("DIR", options->folders, "output folders of tests, or the folder of one campaign")->required();
  verb->add_option("-o,--output", options->output, "file; default DIR/report.html, or ./report.html")
      ->type_name("FILE")
      ->check(not_empty());
  verb->add_option("--lab", options->laboratory, "a laboratory's curve (CSV) to draw beside ours")
      ->type_name("FILE")
      ->allow_extra_args(false);
  verb->add_option("--published", options->published, "values to compare with; default those of the article")
      ->type_name("FILE.csv");
  verb->add_option("--live", options->live, "write it anew every S seconds while the test runs")
      ->type_name("S")
      ->check(CLI::Range(1, 3600).description(""));
  verb->add_option("--bootstrap", options->resamples, "resamples for the confidence bands; default 200")
      ->type_name("N")
      ->check(CLI::Range(0, 10000).description(""));
  verb->add_option("--states", options->states, "of the 3D view at most; default 12, 0: no view")
      ->type_name("N")
      ->check(CLI::Range(0, 200).description(""));
  verb->add_option("--page", options->page, "folder with another page.js and page.css")->type_name("FOLDER");
  verb->add_flag("--data", options->is_data, "the data of the page as JSON on stdout, no page");
  verb->add_flag("-q,--quiet", options->is_quiet, "errors only");
  verb->footer("Example:\n  dem4grm report runs/quick --lab measured.csv");
  verb->callback([options] {
    if (options->live > 0) {
      report(*options);  // signals must reach it
    } else {
      read_apart(options->folders.front(), [&] { report(*options); });
    }
  });
}

}  // namespace dem
