// SPDX-License-Identifier: BSD-3-Clause
// The tables of a study: keys of a case with one value each, or with all the values of an axis.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "dem4grm/campaign/study.hpp"
#include "dem4grm/case_file/case_problems.hpp"
#include "dem4grm/case_file/case_schema.hpp"
#include "dem4grm/case_file/toml_guard.hpp"

namespace dem {

/// What tests have in common in one place of an axis: one value, of paired keys one of each.
using StudyValues = std::vector<StudyValue>;
using StudyAxis = std::vector<StudyValues>;

/// Checks every value as the case file would, and reports at the line of the study.
class StudyTables {
 public:
  /// `schema` is bound to a case that only serves to check values. Files that values name lie beside the study and are named
  /// in its tests as seen from `case_folder`.
  StudyTables(const Schema& schema, std::filesystem::path study_folder, std::filesystem::path case_folder,
              CaseProblems& problems)
      : schema_(schema),
        study_folder_(std::move(study_folder)),
        case_folder_(std::move(case_folder)),
        problems_(problems) {}

  /// [set] or one of [[tests]]: one value for each key.
  StudyValues read_values(const TomlNode& table);
  /// [axes]: each key is an axis.
  std::vector<StudyAxis> read_axes(const TomlNode& table);
  /// One of [[paired]]: all keys together are one axis.
  StudyAxis read_paired(const TomlMember& member, const TomlNode& table);

 private:
  struct Found {
    const Key* key = nullptr;
    const TomlMember* member = nullptr;
  };
  std::vector<Found> keys_of(const TomlNode& table, const std::string& section = {});
  const Key* find_key(const TomlMember& member, const std::string& path);
  StudyAxis read_axis(const Key& key, const TomlMember& member);
  StudyAxis read_range(const Key& key, const TomlMember& member);
  StudyAxis read_list(const Key& key, const TomlMember& member);
  std::optional<StudyValue> read_one(const Key& key, const TomlNode& node);

  const Schema& schema_;
  std::filesystem::path study_folder_, case_folder_;
  CaseProblems& problems_;
};

/// "normal_stress_kPa": the name of the key, with its section where two keys have one name, and the usual unit.
std::string study_column(const Schema& schema, const Key& key);

/// What a value adds to the name of a test: "vrc025", "060kPa", "seed3", "velocity-20mm_s".
std::string name_part(const StudyValue& value);

}  // namespace dem
