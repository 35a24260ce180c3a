// SPDX-License-Identifier: BSD-3-Clause
// dem4grm info: what a file of results or an output folder holds, and whether it is whole.
#include <filesystem>
#include <memory>

#include <fmt/format.h>

#include "dem4grm/core/error.hpp"
#include "dem4grm/results/results_check.hpp"
#include "dem4grm/results/results_file.hpp"
#include "dem4grm/results/stored_grains.hpp"
#include "dem4grm/results/summary.hpp"
#include "dem4grm/runs/output_folder.hpp"
#include "read_apart.hpp"
#include "run_report.hpp"
#include "terminal.hpp"
#include "verbs.hpp"

namespace dem {
namespace {

struct InfoOptions {
  std::string path;
};

std::string outline_text(const std::filesystem::path& path, const StoredResults& stored) {
  std::string text = fmt::format("{}: {} \"{}\", written by dem4grm {}, commit {}\n", path.string(), stored.test,
                                 stored.case_name, stored.version, stored.commit);
  if (!stored.frames.empty()) {
    const StoredFrame& f = stored.frames.front();
    text += fmt::format("  {} balls, {} clumps, {} rubber grains, {} bonds; {} rows of the record\n", f.balls, f.clumps,
                        f.rubber_grains, f.bonds, stored.table_rows);
  }
  for (const StoredFrame& f : stored.frames) {
    text += fmt::format("  state {}  {:8.3f} mm  {:6} contacts  hash {}\n", f.name, f.displacement * 1e3, f.contacts,
                        f.state_hash);
  }
  return text;
}

/// Throws IoError when the last state is not the one that the summary names.
void compare(const std::filesystem::path& folder, const JsonObject& summary, const StoredResults& stored) {
  const std::string expected = text_in(summary, "state_hash");
  const std::string found = stored.frames.empty() ? "no state" : stored.frames.back().state_hash;
  if (expected == found) return;
  throw IoError(fmt::format("{}: {} ends with {} but {} says {}; the files are not of one run", folder.string(),
                            file_name::k_results, found, file_name::k_summary, expected));
}

/// Throws IoError when the file is damaged.
std::string integrity_line(const std::filesystem::path& path) {
  return fmt::format("  {}: {}\n", path.filename().string(), verdict_of(path, check_results(path)));
}

void show_folder(const std::filesystem::path& folder) {
  const std::filesystem::path status_path = folder / file_name::k_status;
  std::error_code ignored;
  if (!std::filesystem::exists(status_path, ignored)) {
    throw MissingFileError(fmt::format("{}: is no output folder, it has no {}", folder.string(), file_name::k_status));
  }
  const JsonObject status = read_json_file(status_path);
  const bool is_complete = std::filesystem::exists(folder / file_name::k_summary, ignored);
  std::string text = fmt::format("{}: {}", folder.string(), is_complete ? "finished" : text_in(status, "state"));
  if (!is_complete) {
    text +=
        fmt::format(" in stage \"{}\", last sign of life {} from process {:.0f} on host {}", text_in(status, "stage"),
                    text_in(status, "time"), number_in(status, "pid"), text_in(status, "host"));
    const std::string cause = text_in(status, "cause");
    if (!cause.empty()) text += "\n  cause: " + cause;
  }
  text += '\n';
  const std::filesystem::path results = folder / file_name::k_results;
  if (is_complete) {
    const JsonObject summary = read_json_file(folder / file_name::k_summary);
    const StoredResults stored = read_outline(results);
    compare(folder, summary, stored);
    text += summary_lines(summary) + homogeneity_lines(summary) + outline_text(results, stored) +
            "  the last state is that of the summary\n";
  } else if (std::filesystem::exists(folder / file_name::k_branch, ignored)) {
    text += branch_lines(read_json_file(folder / file_name::k_branch));
  }
  if (!is_complete && std::filesystem::exists(results, ignored)) {
    text += outline_text(results, read_outline(results));
  }
  for (const std::filesystem::path& file : {results, folder / file_name::k_specimen}) {
    if (std::filesystem::exists(file, ignored)) text += integrity_line(file);
  }
  print_result(text);
}

void show(const InfoOptions& options) {
  const std::filesystem::path path = options.path;
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) {
    show_folder(path);
  } else {
    const StoredResults stored = read_outline(path);
    const bool is_before_shear =
        stored.test == "direct_shear" && !stored.frames.empty() && stored.frames.front().displacement == 0.0;
    print_result(
        outline_text(path, stored) + integrity_line(path) +
        (is_before_shear ? homogeneity_lines(homogeneity_fields(homogeneity_of(read_stored_grains(path)))) : ""));
  }
}

}  // namespace

void add_info(CLI::App& app) {
  CLI::App* verb = app.add_subcommand("info", "verifies and summarises what a run has written");
  const auto options = std::make_shared<InfoOptions>();
  verb->add_option("PATH", options->path, "output folder, results.h5 or specimen.h5")->required();
  verb->footer("Example:\n  dem4grm info runs/quick");
  verb->callback([options] { read_apart(options->path, [&] { show(*options); }); });
}

}  // namespace dem
