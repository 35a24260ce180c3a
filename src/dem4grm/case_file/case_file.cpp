// SPDX-License-Identifier: BSD-3-Clause
// Reading of a case: guard, parser, options, keys, values, rules.
#include "dem4grm/case_file/case_file.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "dem4grm/case_file/case_keys.hpp"
#include "dem4grm/case_file/case_problems.hpp"
#include "dem4grm/case_file/case_rules.hpp"
#include "dem4grm/case_file/case_schema.hpp"
#include "dem4grm/case_file/case_values.hpp"
#include "dem4grm/case_file/text_file.hpp"
#include "dem4grm/case_file/toml_guard.hpp"

namespace dem {
namespace {

/// Which test the keys are of. A wrong name is reported later, with the other values; until then the sections decide.
bool is_grain_compression(const TomlNode& root) {
  const TomlNode* test = find_member(root, "test");
  if (test == nullptr) return false;
  const bool is_text = test->kind == TomlKind::text || test->kind == TomlKind::option_text;
  if (is_text && test->text.find("direct_shear") != std::string::npos) return false;
  if (is_text && test->text.find("grain_compression") != std::string::npos) return true;
  return find_member(root, "compression") != nullptr && find_member(root, "shear") == nullptr;
}

/// What a case never has and a study must; nullptr without it.
const TomlMember* word_of_a_study(const TomlNode& root) {
  for (const TomlMember& member : root.members) {
    if (member.key == "base" || member.key == "cases" || member.key == "axes") return &member;
  }
  return nullptr;
}

template <class Other, class Test>
void read_test(Test& test, const TomlNode& root, const std::filesystem::path& folder, CaseProblems& problems) {
  Other other;
  const Schema schema = case_schema(test);
  GivenKeys given = find_keys(root, schema, case_schema(other), problems);
  for (const Key& key : schema.keys) {
    const auto found = given.nodes.find(key.path());
    if (found == given.nodes.end() || given.bad.contains(key.path())) continue;
    if (!read_value(key, *found->second, folder, problems)) given.bad.insert(key.path());
  }
  check_rules(test, given, problems);
}

TestCase read_case(const TomlNode& root, const std::filesystem::path& folder, CaseProblems& problems) {
  if (is_grain_compression(root)) {
    GrainCompressionCase test;
    read_test<DirectShearCase>(test, root, folder, problems);
    return test;
  }
  DirectShearCase test;
  read_test<GrainCompressionCase>(test, root, folder, problems);
  SpecimenSettings& specimen = test.specimen;
  if (!specimen.preparation_friction && !specimen.relative_density) {
    specimen.relative_density = k_default_relative_density;
  }
  if (!test.shear.velocity && !test.shear.inertial_number) test.shear.inertial_number = k_default_inertial_number;
  return test;
}

}  // namespace

const std::string& case_name(const TestCase& test) {
  return std::visit([](const auto& t) -> const std::string& { return t.name; }, test);
}

LoadedCase parse_case(std::string_view text, const std::filesystem::path& name, std::span<const Override> overrides) {
  std::string_view body = text;
  if (body.starts_with("\xEF\xBB\xBF")) body.remove_prefix(3);
  // A hostile file is not cut into lines for its message.
  const std::string_view shown = body.size() > k_largest_case_file ? std::string_view() : body;
  CaseProblems problems(printable(name.string(), 300), shown, overrides);
  TomlDocument document = parse_toml(body);
  for (const TomlProblem& problem : document.problems) {
    const bool has_text = !shown.empty();
    Place place = problem.place;
    if (!has_text) place.length = 0;
    problems.error(place, problem.message, problem.note);
  }
  LoadedCase loaded;
  if (document.is_usable) {
    problems.ignore_lines(std::move(document.reported_lines));
    if (const TomlMember* word = word_of_a_study(document.root)) {
      problems.error(word->key_place,
                     "this is a study, which makes many tests of a case: dem4grm campaign plan shows them");
    } else {
      apply_overrides(document.root, overrides, problems);
      loaded.test = read_case(document.root, name.parent_path(), problems);
    }
  }
  problems.throw_errors();
  loaded.source_text = std::string(text);
  loaded.resolved_toml = resolved_toml(loaded.test);
  loaded.warnings = problems.take_warnings();
  return loaded;
}

bool is_grain_compression_text(std::string_view text) { return is_grain_compression(parse_toml(text).root); }

LoadedCase load_case(const std::filesystem::path& path, std::span<const Override> overrides) {
  return parse_case(read_text_file(path), path, overrides);
}

}  // namespace dem
