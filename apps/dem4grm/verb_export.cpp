// SPDX-License-Identifier: BSD-3-Clause
// dem4grm export: stored states as files for ParaView.
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "dem4grm/core/error.hpp"
#include "dem4grm/core/quantity.hpp"
#include "dem4grm/export/vtk_series.hpp"
#include "read_apart.hpp"
#include "terminal.hpp"
#include "verbs.hpp"

namespace dem {
namespace {

struct ExportVerbOptions {
  std::string path, folder;
  std::vector<std::string> at;
  bool is_vtk = false;
};

/// Displacements in m. Throws Error with ExitCode::usage that names every text that is none.
std::vector<double> displacements_from(const std::vector<std::string>& texts) {
  std::vector<double> out;
  std::string problems;
  for (const std::string& text : texts) {
    const ParsedQuantity at = parse_quantity(text, Dimension::length);
    if (at.value) {
      out.push_back(*at.value);
    } else {
      problems += fmt::format("\n--at: \"{}\" {}", text, at.problem);
    }
  }
  if (!problems.empty()) throw Error(ExitCode::usage, problems.substr(1));
  return out;
}

std::string size_text(double bytes) {
  return bytes < 1e6 ? fmt::format("{:.0f} kB", bytes / 1e3) : fmt::format("{:.1f} MB", bytes / 1e6);
}

std::string report_text(const VtkExport& done) {
  std::string series, states;
  for (const std::string& name : done.series) series += fmt::format("{}{}", series.empty() ? "" : ", ", name);
  for (const double at : done.displacements) states += fmt::format("{}{:.3g}", states.empty() ? "" : ", ", at * 1e3);
  return fmt::format(
      "{}: written from {}\n"
      "  states    {} mm\n"
      "  series    {}\n"
      "  size      {}\n"
      "  next      paraview --script={}\n",
      done.folder.string(), done.source.string(), states, series, size_text(static_cast<double>(done.bytes)),
      (done.folder / "view.py").string());
}

void run_export(const ExportVerbOptions& given) {
  if (!given.is_vtk) throw Error(ExitCode::usage, "export: name a format; today there is --vtk, for ParaView");
  print_result(report_text(export_vtk({given.path, given.folder, displacements_from(given.at)})));
}

}  // namespace

void add_export(CLI::App& app) {
  CLI::App* verb = app.add_subcommand("export", "stored states as files for ParaView");
  const auto options = std::make_shared<ExportVerbOptions>();
  verb->add_option("DIR", options->path, "output folder, results.h5 or specimen.h5")->required();
  verb->add_flag("--vtk", options->is_vtk, "series of .vtp files and view.py for ParaView");
  verb->add_option("-o,--output", options->folder, "folder to write; default DIR/vtk")
      ->type_name("OUT")
      ->check(not_empty());
  verb->add_option("--at", options->at, "displacements of the states, as 0mm,8mm; default all")
      ->type_name("LIST")
      ->allow_extra_args(false)
      ->delimiter(',');
  verb->footer("Example:\n  dem4grm export runs/quick --vtk --at 0mm,8mm");
  verb->callback([options] { read_apart(options->path, [&] { run_export(*options); }); });
}

}  // namespace dem
