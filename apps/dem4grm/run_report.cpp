// SPDX-License-Identifier: BSD-3-Clause
#include "run_report.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <system_error>
#include <variant>

#include "dem4grm/report/report_page.hpp"
#include "dem4grm/runs/branch_source.hpp"

namespace dem {
namespace {

/// A line with its name in the first 26 columns.
std::string line(const std::string& name, const std::string& value) {
  return fmt::format("  {:<24} {}\n", name, value);
}

/// How the density was found.
std::string density_lines(const JsonObject& s) {
  const auto n = [&](const char* name) { return number_in(s, name); };
  const JsonValue* branches = find_field(s, "branches");
  const auto* list = branches == nullptr ? nullptr : std::get_if<JsonList>(&branches->data);
  if (list == nullptr || list->empty()) {
    return line("preparation friction", fmt::format("{:g}, as given", n("preparation_friction")));
  }
  return line("relative density", fmt::format("{:.1f} % with friction {:g}, found in {} branches",
                                              100.0 * n("relative_density"), n("preparation_friction"), list->size())) +
         line("e_min, e_max", fmt::format("{:.4f}, {:.4f}", n("void_ratio_min"), n("void_ratio_max")));
}

/// The number with its unit, or that the record was too short for it.
std::string measured(const JsonObject& s, const char* name, const char* unit, int digits = 2) {
  if (!has_number(s, name)) return "not measured: the record is too short";
  return fmt::format("{:.{}f} {}", number_in(s, name), digits, unit);
}

std::string shear_lines(const JsonObject& s) {
  const auto n = [&](const char* name) { return number_in(s, name); };
  std::string text;
  std::string peak = measured(s, "peak_shear_stress_kPa", "kPa");
  if (has_number(s, "displacement_at_peak_mm")) peak += fmt::format(" at {:.2f} mm", n("displacement_at_peak_mm"));
  text += line("peak shear stress", peak + (is_set_in(s, "hardening") ? " (still rising: hardening)" : ""));
  text += line("residual shear stress", measured(s, "residual_shear_stress_kPa", "kPa"));
  text += line("dilation angle", measured(s, "dilation_angle_deg", "degrees"));
  text +=
      line("void ratio", fmt::format("{:.3f} prepared, {:.3f} before shear, {:.3f} at the end",
                                     n("void_ratio_prepared"), n("void_ratio_before_shear"), n("void_ratio_at_end")));
  text += line("normal stress", fmt::format("{:.3f} kPa mean, largest error {:.2f} %", n("normal_stress_mean_kPa"),
                                            100.0 * n("normal_stress_max_error")));
  text += density_lines(s);
  const double inertial = n("inertial_number_max");
  text += line("inertial number",
               fmt::format("{:.2e} at most{}", inertial, inertial > 1e-3 ? ": too fast to be quasi-static" : ""));
  const double target = n("inertial_number_target");
  text += line("shear velocity",
               fmt::format("{:g} mm/s{}", n("shear_velocity_mm_per_s"),
                           target > 0.0 ? fmt::format(", chosen for an inertial number of {:g}", target) : ""));
  text += line("grains", fmt::format("{:.0f} clumps, {:.0f} rubber grains; lost: {:.0f}", n("clumps"),
                                     n("rubber_grains"), n("lost_grains")));
  return text;
}

std::string compression_lines(const JsonObject& s) {
  const auto n = [&](const char* name) { return number_in(s, name); };
  std::string text;
  text += line("load at the end", fmt::format("{:.3f} N at {:.1f} % strain", n("load_at_end_N"), 100.0 * n("strain")));
  text += line("initial stiffness", measured(s, "initial_stiffness_N_per_mm", "N/mm", 3));
  text += line("late stiffness", measured(s, "late_stiffness_N_per_mm", "N/mm", 3));
  text += line("second neighbours meet",
               n("knee_strain") > 0.0 ? fmt::format("at {:.1f} % strain", 100.0 * n("knee_strain")) : "never");
  text += line("Poisson's ratio", measured(s, "poisson_ratio_initial", "at first", 3));
  return text;
}

/// Where the page lies that shows all of it.
std::string report_line(const std::filesystem::path& folder) {
  std::error_code ignored;
  const std::filesystem::path page = folder / k_report_file;
  return std::filesystem::exists(page, ignored) ? line("report", fmt::format("{}, for a browser", page.string())) : "";
}

}  // namespace

std::string branch_lines(const JsonObject& origin) {
  if (origin.empty()) return {};
  std::string text = line("branched from", text_in(origin, "source"));
  text += line("at", branch_place_words(origin));
  text += line("with", branch_changes_words(origin));
  const double begin = number_in(origin, "numbers_from_mm");
  return begin > 0.0 ? text + line("curve and means", fmt::format("of what came after {:.3f} mm", begin)) : text;
}

std::string summary_lines(const JsonObject& summary) {
  std::string text =
      text_in(summary, "test") == "grain_compression" ? compression_lines(summary) : shear_lines(summary);
  const JsonValue* branch = find_field(summary, "branch");
  if (const auto* origin = branch == nullptr ? nullptr : std::get_if<JsonObject>(&branch->data)) {
    text += branch_lines(*origin);
  }
  text += line("energy not accounted for",
               fmt::format("{:.3g} % of the boundary work", number_in(summary, "energy_closure_per_cent")));
  text += line("state hash", text_in(summary, "state_hash"));
  text += line("wall time", fmt::format("{:.1f} s, {:.0f} steps, {:.0f} thread(s)", number_in(summary, "wall_time_s"),
                                        number_in(summary, "steps"), number_in(summary, "threads")));
  return text;
}

std::string homogeneity_lines(const JsonObject& fields) {
  if (find_field(fields, "homogeneity_cells") == nullptr) return {};
  // A box may be too small for some of the numbers.
  const auto shown = [&](const char* name, int digits) {
    const double value = number_in(fields, name, std::numeric_limits<double>::quiet_NaN());
    return std::isfinite(value) ? fmt::format("{:.{}f}", value, digits) : std::string("-");
  };
  std::string text;
  text += line("scatter over cells",
               fmt::format("void ratio {}, rubber content {}, in {} cells", shown("homogeneity_void_ratio_scatter", 3),
                           shown("homogeneity_rubber_content_scatter", 3), shown("homogeneity_cells", 0)));
  text += line("void ratio by place",
               fmt::format("{} inside, {} at the plates, {} at the side walls", shown("void_ratio_inside", 3),
                           shown("void_ratio_at_plates", 3), shown("void_ratio_at_side_walls", 3)));
  text += line("layering", fmt::format("{} at the plates, {} at the side walls", shown("layering_at_plates", 3),
                                       shown("layering_at_side_walls", 3)));
  text += line("fabric before shear", fmt::format("deviator {} (noise {})", shown("fabric_deviator_before_shear", 3),
                                                  shown("fabric_deviator_noise", 3)));
  text += line("largest overlap", fmt::format("{} of a radius; caught: {}", shown("largest_overlap_before_shear", 4),
                                              shown("caught_balls_before_shear", 0)));
  return text;
}

std::string run_report(const JsonObject& summary, const std::filesystem::path& folder, bool was_complete) {
  std::string text = was_complete
                         ? fmt::format("{} is complete (dem4grm {}, commit {}); nothing was computed\n",
                                       folder.string(), text_in(summary, "version"), text_in(summary, "commit"))
                         : fmt::format("{} is done\n", text_in(summary, "case"));
  text += summary_lines(summary);
  text += line("written to", folder.string());
  text += report_line(folder);
  text += line("next", fmt::format("dem4grm info {}", folder.string()));
  return text;
}

std::string specimen_report(const JsonObject& summary, const std::filesystem::path& folder,
                            const std::string& case_path, bool was_complete) {
  const auto n = [&](const char* name) { return number_in(summary, name); };
  std::string text =
      fmt::format("{} {}\n", folder.string(),
                  was_complete ? "already holds the specimen; nothing was computed" : "holds the specimen");
  text += line("grains", fmt::format("{:.0f} clumps, {:.0f} rubber grains, rubber content {:.4f}", n("clumps"),
                                     n("rubber_grains"), n("rubber_content")));
  text += density_lines(summary);
  text += line("void ratio",
               fmt::format("{:.4f} generated, {:.4f} prepared, {:.4f} before shear", n("void_ratio_generated"),
                           n("void_ratio_prepared"), n("void_ratio_before_shear")));
  text += line("height",
               fmt::format("{:.2f} mm under {:g} kPa", n("height_before_shear_mm"), n("normal_stress_target_kPa")));
  text += line("state hash", text_in(summary, "state_hash"));
  text += line("wall time",
               fmt::format("{:.1f} s, {:.0f} steps, {:.0f} thread(s)", n("wall_time_s"), n("steps"), n("threads")));
  text += report_line(folder);
  text += line("next", fmt::format("dem4grm run {} -o {}", case_path, folder.string()));
  return text;
}

}  // namespace dem
