// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/results/specimen_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "dem4grm/case_file/case_differences.hpp"
#include "dem4grm/case_file/case_file.hpp"
#include "dem4grm/core/error.hpp"
#include "dem4grm/results/file_names.hpp"
#include "dem4grm/results/hdf5_handle.hpp"
#include "dem4grm/results/output_file.hpp"
#include "dem4grm/results/results_file.hpp"
#include "dem4grm/results/state_group.hpp"

namespace dem {
namespace {

constexpr const char* k_state = "state";

/// The case without what may differ between a specimen and a test on it.
std::string specimen_text(DirectShearCase test) {
  const double stress = test.shear.normal_stress;
  test.name = DirectShearCase{}.name;
  test.shear = {};
  test.shear.normal_stress = stress;
  test.recording = {};
  test.servo.shear_speed_cap = ServoSettings{}.shear_speed_cap;
  return resolved_toml(test);
}

void check_origin(const std::filesystem::path& path, const std::string& stored_case, const DirectShearCase& test) {
  const LoadedCase stored = parse_case(stored_case, path);
  const auto* made_for = std::get_if<DirectShearCase>(&stored.test);
  if (made_for == nullptr) throw IoError("holds no specimen of a shear test");
  const std::string made = specimen_text(*made_for), wanted = specimen_text(test);
  if (made == wanted) return;
  throw InputError(fmt::format(
      "{}: the specimen was made for another case; only the name, the record, servo.shear_speed_cap and the "
      "shear apart from its normal stress may differ:\n  {}",
      path.string(), fmt::join(case_differences(made, wanted), "\n  ")));
}

}  // namespace

bool has_same_specimen(const std::string& stored_case, const DirectShearCase& test) {
  try {
    const LoadedCase stored = parse_case(stored_case, file_name::k_resolved);
    const auto* made_for = std::get_if<DirectShearCase>(&stored.test);
    return made_for != nullptr && specimen_text(*made_for) == specimen_text(test);
  } catch (const Error&) {
    return false;
  }
}

void add_specimen_state(const std::filesystem::path& path, const StateArchive& state) {
  change_sealed_file(path, [&](const hdf5::Handle& file) {
    const hdf5::Handle group = hdf5::create_group(file, k_state);
    hdf5::write_attribute(group, "format", k_state_format);
    write_state(group, state);
  });
}

StoredSpecimen read_specimen(const std::filesystem::path& path) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) {
    throw MissingFileError(fmt::format("{}: no such file; dem4grm specimen makes one", path.string()));
  }
  return naming_file(path, [&] {
    const hdf5::Handle file = open_results(path);
    const std::vector<std::string> groups = hdf5::names_in(file);
    if (std::find(groups.begin(), groups.end(), k_state) == groups.end()) {
      throw IoError("holds no complete specimen to start from");
    }
    const hdf5::Handle meta = hdf5::open_group(file, "meta"), state = hdf5::open_group(file, k_state);
    const double format = hdf5::read_number_attribute(state, "format");
    if (format != static_cast<double>(k_state_format)) {
      throw IoError(fmt::format("its state has format {}, this program reads {}", format, k_state_format));
    }
    return StoredSpecimen{read_state(state), hdf5::read_text_attribute(meta, "commit"),
                          hdf5::read_text(meta, "resolved_toml")};
  });
}

StoredSpecimen read_specimen(const std::filesystem::path& given, const DirectShearCase& test) {
  std::error_code ignored;
  const std::filesystem::path path =
      std::filesystem::is_directory(given, ignored) ? given / file_name::k_specimen : given;
  StoredSpecimen specimen = read_specimen(path);
  naming_file(path, [&] { check_origin(path, specimen.resolved_toml, test); });
  return specimen;
}

}  // namespace dem
