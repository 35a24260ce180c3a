// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/campaign/study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "dem4grm/campaign/study_axes.hpp"
#include "dem4grm/case_file/nearest_name.hpp"
#include "dem4grm/case_file/text_file.hpp"
#include "dem4grm/core/error.hpp"

namespace dem {
namespace {

constexpr std::size_t k_most_bad_tests = 3;  // shown with all their problems; the others have the same ones as a rule

/// A case that tests are made from.
struct BaseCase {
  std::filesystem::path path;
  std::string text;
  Place place;
};

/// A test before its case is read.
struct Draft {
  const BaseCase* base = nullptr;
  StudyValues values;
  Place place;
};

class StudyReader {
 public:
  StudyReader(const std::filesystem::path& path, std::string text)
      : path_(path), shown_(printable(path.string(), 300)), text_(std::move(text)), problems_(shown_, text_, {}) {}

  Study run() {
    TomlDocument document = parse_toml(text_);
    for (const TomlProblem& problem : document.problems) problems_.error(problem.place, problem.message, problem.note);
    if (document.is_usable) {
      problems_.ignore_lines(std::move(document.reported_lines));
      read_head(document.root);
    }
    problems_.throw_errors();
    if (is_grain_compression_text(bases_.front().text)) {
      GrainCompressionCase scratch;
      read_tables(document.root, case_schema(scratch));
    } else {
      DirectShearCase scratch;
      read_tables(document.root, case_schema(scratch));
    }
    problems_.throw_errors();
    load_tests();
    study_.source_text = text_;
    return std::move(study_);
  }

 private:
  // ---- what the file says before its tables

  void read_head(const TomlNode& root) {
    if (const TomlNode* specimen = find_member(root, "specimen");
        specimen != nullptr && find_member(root, "base") == nullptr) {
      problems_.error(specimen->place, "this is a case, not a study; a study names it: base = \"case.toml\"");
      return;
    }
    constexpr std::array<std::string_view, 7> k_known{"name", "base", "cases", "set", "axes", "paired", "tests"};
    for (const TomlMember& member : root.members) {
      if (std::find(k_known.begin(), k_known.end(), member.key) != k_known.end()) continue;
      const auto near = nearest_name(member.key, k_known);
      problems_.error(member.key_place,
                      fmt::format("unknown word \"{}\" in a study{}", printable(member.key),
                                  near ? fmt::format("; did you mean \"{}\"?", *near)
                                       : fmt::format("; keys of the case belong into [axes] or [set], known are {}",
                                                     fmt::join(k_known, ", "))));
    }
    study_.name = path_.stem().string();
    if (const TomlNode* name = find_member(root, "name")) {
      if (name->kind == TomlKind::text && !name->text.empty())
        study_.name = name->text;
      else
        problems_.error(name->place, "name must be text in quotes");
    }
    const TomlNode* base = find_member(root, "base");
    const TomlNode* cases = find_member(root, "cases");
    if ((base == nullptr) == (cases == nullptr)) {
      problems_.error(base != nullptr ? cases->place : Place{},
                      "a study names either its base, as base = \"case.toml\", or its cases, as cases = [\"a.toml\"]");
      return;
    }
    if (base != nullptr) return add_base(*base);
    if (cases->kind != TomlKind::array || cases->items.empty()) {
      problems_.error(cases->place, "cases must be a list of case files, as cases = [\"a.toml\", \"b.toml\"]");
      return;
    }
    for (const TomlNode& item : cases->items) add_base(item);
  }

  void add_base(const TomlNode& node) {
    if (node.kind != TomlKind::text || node.text.empty()) {
      problems_.error(node.place, "the name of a case file in quotes is wanted here");
      return;
    }
    BaseCase base{path_.parent_path() / node.text, {}, node.place};
    try {
      base.text = read_text_file(base.path);
    } catch (const MissingFileError& error) {
      problems_.error(node.place, error.what());
      return;
    }
    if (!bases_.empty() && is_grain_compression_text(base.text) != is_grain_compression_text(bases_.front().text)) {
      problems_.error(node.place, "the cases of one study must all be of one kind of test");
    }
    bases_.push_back(std::move(base));
  }

  // ---- the tables

  static const TomlNode& table_of(const TomlNode& root, std::string_view name) {
    static const TomlNode k_empty;
    const TomlNode* found = find_member(root, name);
    return found == nullptr ? k_empty : *found;
  }

  bool is_table(const TomlNode& node, std::string_view name) {
    if (node.kind == TomlKind::table) return true;
    problems_.error(node.place,
                    fmt::format("{} is a table: write [{}] on a line of its own, then its keys below", name, name));
    return false;
  }

  /// The tables [[name]].
  std::vector<const TomlNode*> tables_of(const TomlNode& root, std::string_view name) {
    std::vector<const TomlNode*> tables;
    const TomlNode* list = find_member(root, name);
    if (list == nullptr) return tables;
    const bool is_list = list->kind == TomlKind::array && !list->items.empty() &&
                         std::all_of(list->items.begin(), list->items.end(),
                                     [](const TomlNode& item) { return item.kind == TomlKind::table; });
    if (!is_list)
      problems_.error(list->place,
                      fmt::format("{} is a list of tables: write [[{}]], then its keys below", name, name));
    if (!is_list) return tables;
    for (const TomlNode& item : list->items) tables.push_back(&item);
    return tables;
  }

  void read_tables(const TomlNode& root, const Schema& schema) {
    StudyTables tables(schema, path_.parent_path(), bases_.front().path.parent_path(), problems_);
    if (is_table(table_of(root, "set"), "set")) set_ = tables.read_values(table_of(root, "set"));
    std::vector<StudyAxis> axes;
    if (is_table(table_of(root, "axes"), "axes")) axes = tables.read_axes(table_of(root, "axes"));
    for (const TomlNode* table : tables_of(root, "paired")) {
      axes.push_back(tables.read_paired({"paired", table->place, {}}, *table));
    }
    std::vector<Draft> rows;
    for (const TomlNode* table : tables_of(root, "tests")) {
      for (const BaseCase& base : bases_) rows.push_back({&base, tables.read_values(*table), table->place});
    }
    if (problems_.error_count() > 0) return;
    check_keys(axes);
    check_number(axes, rows.size());
    if (problems_.error_count() > 0) return;
    const bool has_grid = !axes.empty() || rows.empty();
    if (has_grid) {
      for (const BaseCase& base : bases_) combine(base, axes, 0, {});
    }
    drafts_.insert(drafts_.end(), rows.begin(), rows.end());
  }

  /// One key must not be given in two places.
  void check_keys(const std::vector<StudyAxis>& axes) {
    std::set<std::string> seen;
    const auto take = [&](const StudyValues& values, std::string_view where) {
      for (const StudyValue& value : values) {
        if (!seen.insert(value.key).second) {
          problems_.error({}, fmt::format("{} is given twice, the second time in {}", value.key, where));
        }
      }
    };
    take(set_, "[set]");
    for (const StudyAxis& axis : axes) {
      if (!axis.empty()) take(axis.front(), "an axis");
    }
  }

  void check_number(const std::vector<StudyAxis>& axes, std::size_t rows) {
    double number = static_cast<double>(bases_.size());
    for (const StudyAxis& axis : axes) number *= static_cast<double>(axis.size());
    number += static_cast<double>(rows);
    if (number > static_cast<double>(k_most_tests)) {
      problems_.error({}, fmt::format("the study has {:.0f} tests, {} are allowed", number, k_most_tests));
    }
  }

  void combine(const BaseCase& base, const std::vector<StudyAxis>& axes, std::size_t k, const StudyValues& values) {
    if (k == axes.size()) {
      drafts_.push_back({&base, values, base.place});
      return;
    }
    for (const StudyValues& step : axes[k]) {
      StudyValues more = values;
      more.insert(more.end(), step.begin(), step.end());
      combine(base, axes, k + 1, more);
    }
  }

  // ---- the tests

  [[nodiscard]] std::string name_of(const Draft& draft, const std::string& own_name) const {
    std::string name;
    if (bases_.size() > 1 || draft.values.empty()) {
      for (const char c : own_name.empty() ? std::string("case") : own_name) {
        const bool is_usual =
            std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_' || c == '.' || c == '+';
        name += is_usual && (c != '.' || !name.empty()) ? c : '_';
      }
    }
    for (const StudyValue& value : draft.values) name += (name.empty() ? "" : "-") + name_part(value);
    return name;
  }

  void load_tests() {
    std::size_t bad = 0;
    std::string messages;
    std::map<std::string, std::string> cases;  // without the name, to find equal ones
    std::set<std::string> names;
    for (const Draft& draft : drafts_) {
      try {
        add_test(draft);
      } catch (const InputError& error) {
        if (++bad <= k_most_bad_tests) {
          messages +=
              fmt::format("{}{}: test {}:\n{}\n", bad > 1 ? "\n" : "", shown_, values_text(draft), error.what());
        }
        continue;
      }
      const StudyTest& test = study_.tests.back();
      const auto [same, is_new] = cases.emplace(text_without_name(test.loaded), test.name);
      if (!is_new) {
        problems_.error(draft.place, fmt::format("two tests are the same case: {} and {}", same->second, test.name));
      } else if (!names.insert(test.name).second) {
        problems_.error(
            draft.place,
            fmt::format("two tests that differ have one name, {}: give their cases other names", test.name));
      }
    }
    if (bad > k_most_bad_tests) messages += fmt::format("\nand {} more tests with errors", bad - k_most_bad_tests);
    if (bad > 0) throw InputError(messages);
    problems_.throw_errors();
    study_.warnings.insert(study_.warnings.end(), warnings_.begin(), warnings_.end());
  }

  static std::string values_text(const Draft& draft) {
    std::vector<std::string> texts;
    for (const StudyValue& value : draft.values) texts.push_back(fmt::format("{} = {}", value.key, value.text));
    return texts.empty() ? draft.base->path.string() : fmt::format("{}", fmt::join(texts, ", "));
  }

  static std::string text_without_name(const LoadedCase& loaded) {
    TestCase test = loaded.test;
    std::visit([](auto& t) { t.name.clear(); }, test);
    return resolved_toml(test);
  }

  void add_test(const Draft& draft) {
    std::vector<Override> overrides;
    for (const StudyValues* values : {static_cast<const StudyValues*>(&set_), &draft.values}) {
      for (const StudyValue& value : *values) {
        std::erase_if(overrides, [&](const Override& earlier) { return earlier.key == value.key; });
        overrides.push_back({value.key, value.text, "set by the study:"});
      }
    }
    StudyTest test;
    test.values = draft.values;
    test.loaded = parse_case(draft.base->text, draft.base->path, overrides);
    test.name = name_of(draft, case_name(test.loaded.test));
    std::visit([&](auto& t) { t.name = test.name; }, test.loaded.test);
    test.loaded.resolved_toml = resolved_toml(test.loaded.test);
    test.loaded.source_text = test.loaded.resolved_toml;
    for (const std::string& text : test.loaded.warnings) {
      if (std::find(warnings_.begin(), warnings_.end(), text) == warnings_.end()) warnings_.push_back(text);
    }
    test.loaded.warnings.clear();
    study_.tests.push_back(std::move(test));
  }

  std::filesystem::path path_;
  std::string shown_, text_;
  CaseProblems problems_;
  Study study_;
  std::vector<BaseCase> bases_;
  StudyValues set_;
  std::vector<Draft> drafts_;
  std::vector<std::string> warnings_;
};

}  // namespace

Study load_study(const std::filesystem::path& path) { return StudyReader(path, read_text_file(path)).run(); }

}  // namespace dem
