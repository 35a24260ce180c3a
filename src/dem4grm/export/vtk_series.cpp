// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/export/vtk_series.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <optional>
#include <set>
#include <string_view>
#include <system_error>
#include <thread>

#include "dem4grm/core/error.hpp"
#include "dem4grm/export/paraview_view.hpp"
#include "dem4grm/export/state_geometry.hpp"
#include "dem4grm/results/file_names.hpp"
#include "dem4grm/results/micro_state_file.hpp"
#include "dem4grm/results/output_file.hpp"
#include "dem4grm/results/results_file.hpp"

namespace dem {
namespace {

constexpr const char* k_default_folder = "vtk";
constexpr const char* k_states = "states";
constexpr const char* k_view = "view.py";
constexpr int k_attempts = 5;
constexpr std::chrono::milliseconds k_pause{50};

/// The file itself; of a folder its results, or its specimen when shear has stored nothing yet.
std::filesystem::path source_file(const std::filesystem::path& path) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) throw MissingFileError(fmt::format("{}: no such file", path.string()));
  if (!std::filesystem::is_directory(path, ignored)) return path;
  if (std::filesystem::exists(path / "campaign.json", ignored)) {
    throw MissingFileError(
        fmt::format("{}: is a campaign; export one of its tests, {}/tests/NAME", path.string(), path.string()));
  }
  std::filesystem::path results = path / file_name::k_results, specimen = path / file_name::k_specimen;
  const bool has_specimen = std::filesystem::exists(specimen, ignored);
  if (std::filesystem::exists(results, ignored) && !(has_specimen && read_outline(results).frames.empty())) {
    return results;
  }
  if (has_specimen) return specimen;
  throw MissingFileError(fmt::format("{}: holds neither {} nor {}; a run writes them when its specimen is ready",
                                     path.string(), file_name::k_results, file_name::k_specimen));
}

/// The states that were asked for, each once, in the order of the file.
std::vector<StoredFrame> chosen_frames(const std::filesystem::path& file, const std::vector<StoredFrame>& frames,
                                       std::span<const double> at) {
  choose_frame(file, frames, std::nullopt);  // refuses a file without a state
  std::set<std::string> wanted;
  for (const double displacement : at) wanted.insert(choose_frame(file, frames, displacement).name);
  std::vector<StoredFrame> chosen;
  std::copy_if(frames.begin(), frames.end(), std::back_inserter(chosen),
               [&](const StoredFrame& frame) { return at.empty() || wanted.contains(frame.name); });
  return chosen;
}

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw IoError(fmt::format("{}: the folder cannot be made: {}", folder.string(), error.message()));
}

std::string state_file_name(const char* series, const StoredFrame& frame) {
  return fmt::format("{}/{}_{}.vtp", k_states, series, frame.name);
}

std::string pvd_text(const char* series, std::span<const StoredFrame> frames) {
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
      "<Collection>\n";
  for (const StoredFrame& frame : frames) {
    text += "<DataSet timestep=\"";
    append_number(text, frame.displacement * 1e3);
    text += fmt::format("\" part=\"0\" name=\"{}\" file=\"{}\"/>\n", series, state_file_name(series, frame));
  }
  return text + "</Collection>\n</VTKFile>\n";
}

/// Kinds of picture that the grains of a test give: a series of nothing would only be in the way.
std::vector<SeriesKind> series_of(const StoredFrame& frame) {
  std::vector<SeriesKind> out;
  for (const SeriesKind& kind : k_series) {
    const std::string_view name = kind.name;
    const bool is_rubber = name == "rubber_grains" || name == "bonds";
    if ((is_rubber && frame.rubber_grains == 0) || (name == "clumps" && frame.clumps == 0)) continue;
    out.push_back(kind);
  }
  return out;
}

void write_state(const ShownState& state, const StoredFrame& frame, std::span<const SeriesKind> series,
                 VtkExport& out) {
  for (const SeriesKind& kind : series) {
    VtkPolyData data = kind.make(state);
    data.field_data = {{"displacement_mm", VtkArray::Reals{static_cast<float>(frame.displacement * 1e3)}},
                       {"state", VtkArray::Texts{frame.name}},
                       {"state_hash", VtkArray::Texts{frame.state_hash}}};
    const std::string text = vtp_text(data);
    replace_file(out.folder / state_file_name(kind.name, frame), text);
    out.bytes += text.size();
  }
}

void write_states(const std::vector<StoredFrame>& all, std::span<const StoredFrame> chosen,
                  std::span<const SeriesKind> series, VtkExport& out) {
  const hdf5::Handle file = open_results(out.source);
  const GrainDensities densities = read_densities(file);
  const StoredState first = read_stored_state(file, all.front().name);
  for (const StoredFrame& frame : chosen) {
    const StoredState now = frame.name == first.name ? first : read_stored_state(file, frame.name);
    write_state(shown_state(first, now, densities), frame, series, out);
  }
}

VtkExport export_once(const VtkExportOptions& options) {
  VtkExport out;
  out.source = source_file(options.source);
  const StoredResults outline = read_outline(out.source);
  const std::vector<StoredFrame> frames = chosen_frames(out.source, outline.frames, options.at);
  const std::vector<SeriesKind> series = series_of(frames.front());
  out.folder = options.folder.empty() ? out.source.parent_path() / k_default_folder : options.folder;
  make_folder(out.folder / k_states);
  try {
    write_states(outline.frames, frames, series, out);
  } catch (const Error& e) {
    const std::string shown = out.source.string();
    if (e.code() != ExitCode::io && e.code() != ExitCode::bad_case) throw;
    if (std::string_view(e.what()).starts_with(out.folder.string())) throw;
    throw IoError(fmt::format("{}: {}", shown, e.what()));
  }
  for (const StoredFrame& frame : frames) out.displacements.push_back(frame.displacement);
  for (const SeriesKind& kind : series) {
    replace_file(out.folder / fmt::format("{}.pvd", kind.name), pvd_text(kind.name, frames));
    out.series.emplace_back(kind.name);
  }
  replace_file(out.folder / k_view, view_script(out.series, std::filesystem::absolute(out.folder)));
  return out;
}

}  // namespace

VtkExport export_vtk(const VtkExportOptions& options) {
  // A running test writes a state in some milliseconds, and who reads in the midst of it finds half of it.
  for (int attempt = 1; attempt < k_attempts; ++attempt) {
    try {
      return export_once(options);
    } catch (const IoError&) {
      std::this_thread::sleep_for(k_pause);
    }
  }
  return export_once(options);
}

}  // namespace dem
