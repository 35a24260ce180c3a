// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/io/specimen_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <string>
#include <variant>
#include <vector>

#include "dem4grm/core/error.hpp"
#include "dem4grm/io/case_file.hpp"
#include "dem4grm/io/hdf5_handle.hpp"
#include "dem4grm/io/output_folder.hpp"
#include "dem4grm/io/state_group.hpp"

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

/// "normal_stress = "60 kPa"" of a line of a resolved case, without its comment.
std::string setting_of(const std::string& line) {
  const std::size_t end = line.find("  # ");
  return line.substr(0, end);
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// One sentence for each line that only one of the two has.
std::vector<std::string> differences(const std::string& stored, const std::string& wanted) {
  const std::vector<std::string> a = lines_of(stored), b = lines_of(wanted);
  std::vector<std::string> out;
  for (const std::string& line : a) {
    if (std::find(b.begin(), b.end(), line) == b.end()) out.push_back("made with  " + setting_of(line));
  }
  for (const std::string& line : b) {
    if (std::find(a.begin(), a.end(), line) == a.end()) out.push_back("the case has  " + setting_of(line));
  }
  return out;
}

void check_origin(const std::filesystem::path& path, const std::string& stored_case, const DirectShearCase& test) {
  const LoadedCase stored = parse_case(stored_case, path);
  const auto* made_for = std::get_if<DirectShearCase>(&stored.test);
  if (made_for == nullptr) throw IoError("holds no specimen of a shear test");
  const std::string made = specimen_text(*made_for), wanted = specimen_text(test);
  if (made == wanted) return;
  throw InputError(fmt::format(
      "{}: the specimen was made for another case; only the name, the record and the shear apart from its normal "
      "stress may differ:\n  {}",
      path.string(), fmt::join(differences(made, wanted), "\n  ")));
}

}  // namespace

void add_specimen_state(const std::filesystem::path& path, const StateArchive& state) {
  hdf5::Handle file = hdf5::open_file(path, hdf5::Access::write);
  write_state(hdf5::create_group(file, k_state), state);
  file.close(path.string() + ": cannot be written");
}

StateArchive read_specimen(const std::filesystem::path& given, const DirectShearCase& test) {
  std::error_code ignored;
  const std::filesystem::path path =
      std::filesystem::is_directory(given, ignored) ? given / file_name::k_specimen : given;
  if (!std::filesystem::exists(path, ignored)) {
    throw MissingFileError(fmt::format("{}: no such file; dem4grm specimen makes one", path.string()));
  }
  try {
    const hdf5::Handle file = hdf5::open_file(path, hdf5::Access::read);
    const std::vector<std::string> groups = hdf5::names_in(file);
    if (std::find(groups.begin(), groups.end(), k_state) == groups.end()) {
      throw IoError("holds no complete specimen to start from");
    }
    check_origin(path, hdf5::read_text(hdf5::open_group(file, "meta"), "resolved_toml"), test);
    return read_state(hdf5::open_group(file, k_state));
  } catch (const IoError& e) {
    const std::string shown = path.string();
    if (std::string_view(e.what()).starts_with(shown)) throw;
    throw IoError(fmt::format("{}: {}", shown, e.what()));
  }
}

}  // namespace dem
