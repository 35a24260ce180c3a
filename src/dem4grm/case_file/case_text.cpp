// SPDX-License-Identifier: BSD-3-Clause
// Cases and their keys as text: resolved copy, template, table of the manual.
#include <algorithm>

#include <fmt/format.h>

#include "dem4grm/case_file/case_file.hpp"
#include "dem4grm/case_file/case_schema.hpp"
#include "dem4grm/core/error.hpp"

namespace dem {
namespace {

/// Help, range and published value in one line.
std::string key_comment(const Key& key) {
  std::string text(key.help);
  if (!key.choices.empty()) text += fmt::format(": {}", fmt::join(key.choices, ", "));
  std::vector<std::string> remarks;
  if (const std::string range = range_text(key); !range.empty()) remarks.push_back(range);
  if (!key.published.empty()) remarks.push_back(fmt::format("published: {}", key.published));
  if (!remarks.empty()) text += fmt::format(" ({})", fmt::join(remarks, "; "));
  return text;
}

std::string section_header(const Schema& schema, std::string_view name) {
  const auto found = std::find_if(schema.sections.begin(), schema.sections.end(),
                                  [name](const Section& section) { return section.name == name; });
  return fmt::format("\n[{}]  # {}\n", name, found->help);
}

/// The keys with their values below their section headers. Keys of one section need not stand together in the table.
template <class WriteKey>
std::string sections_text(const Schema& schema, const WriteKey& write_key) {
  std::vector<std::string_view> names{""};
  for (const Section& section : schema.sections) names.push_back(section.name);
  std::string text;
  for (const std::string_view name : names) {
    std::string body;
    for (const Key& key : schema.keys) {
      if (key.section == name) body += write_key(key);
    }
    if (body.empty()) continue;
    if (!name.empty()) text += section_header(schema, name);
    text += body;
  }
  return text;
}

std::string resolved_line(const Key& key) {
  const std::optional<std::string> value = value_text(key);
  if (!value) return fmt::format("# {} is not set: {}  # {}\n", key.name, key.default_words, key_comment(key));
  if (value->find('\n') != std::string::npos) return fmt::format("# {}\n{} = {}\n", key_comment(key), key.name, *value);
  return fmt::format("{} = {}  # {}\n", key.name, *value, key_comment(key));
}

template <class Test>
std::string resolved_text(Test test) {
  const Schema schema = case_schema(test);
  return "# Resolved case: every key with its final value. It can be run like any other case.\n" +
         sections_text(schema, resolved_line);
}

/// Template lines: short comments in one column.
std::string template_line(const Key& key) {
  if (!key.is_in_template) return {};
  const std::optional<std::string> value = value_text(key);
  if (!value) return {};
  if (value->find('\n') != std::string::npos) {
    return fmt::format("{} = {}  # {}\n", key.name, *value, "sieve size, fraction passing by mass");
  }
  std::string comment(key.help);
  if (!key.choices.empty()) comment += fmt::format(": {}", fmt::join(key.choices, ", "));
  if (!key.published.empty()) comment += fmt::format(" (published: {})", key.published);
  return fmt::format("{:<36} # {}\n", fmt::format("{} = {}", key.name, *value), comment);
}

/// The gradings of cases/gradings, so that a new case needs no other file (a test holds them equal).
Grading standard_gravel_grading() {
  return {{3.0e-3, 0.0},    {3.5e-3, 0.0483}, {4.0e-3, 0.1274}, {4.5e-3, 0.2325}, {5.0e-3, 0.3528},
          {5.5e-3, 0.4766}, {5.6e-3, 0.5},    {6.0e-3, 0.594},  {6.5e-3, 0.6987}, {7.0e-3, 0.7879},
          {7.5e-3, 0.8611}, {8.0e-3, 0.9195}, {8.5e-3, 0.9651}, {8.8e-3, 1.0}};
}
Grading standard_rubber_grading() { return {{3.65e-3, 0.0}, {3.75e-3, 1.0}}; }

std::string without_blanks(std::string text) {
  std::erase_if(text, [](char c) { return c == ' ' || c == '\t'; });
  return text;
}

DirectShearCase new_direct_shear(const NewCase& wanted) {
  if (!(wanted.rubber_content_percent >= 0.0 && wanted.rubber_content_percent <= 100.0)) {
    throw InputError(fmt::format("--vrc {} is outside [0, 100]: rubber content in per cent of the solid volume",
                                 wanted.rubber_content_percent));
  }
  const ParsedQuantity stress = parse_quantity(wanted.normal_stress, Dimension::stress);
  if (!stress.value) throw InputError(fmt::format("--stress \"{}\" {}", wanted.normal_stress, stress.problem));
  DirectShearCase test;
  test.specimen.rubber_content = wanted.rubber_content_percent / 100.0;
  test.specimen.gravel_grading = standard_gravel_grading();
  test.specimen.rubber_grading = standard_rubber_grading();
  test.specimen.relative_density = k_default_relative_density;
  test.shear.normal_stress = *stress.value;
  test.name = fmt::format("vrc{}-{}", format_decimal(wanted.rubber_content_percent),
                          without_blanks(format_quantity(*stress.value, Dimension::stress)));
  return test;
}

template <class Test>
std::string template_text(Test test) {
  std::string text =
      "# Every key has its unit, range and meaning in the manual; keys left out keep their "
      "published value.\n" +
      sections_text(case_schema(test), template_line);
  parse_case(text, "new case");  // throws for a stress outside its range
  return text;
}

std::string default_words(const Key& key) {
  if (key.is_required) return "required";
  if (!key.default_words.empty()) return std::string(key.default_words);
  const std::optional<std::string> value = value_text(key);
  return value && *value != "\"\"" ? fmt::format("`{}`", *value) : "";
}

template <class Test>
std::string markdown_tables() {
  Test test;
  const Schema schema = case_schema(test);
  std::string text;
  std::string_view section = "none yet";
  std::vector<std::string_view> names{""};
  for (const Section& known : schema.sections) names.push_back(known.name);
  for (const std::string_view name : names) {
    section = name;
    text += name.empty() ? std::string("\n### Before the first section\n") : fmt::format("\n### `[{}]`\n", name);
    text += "\n| key | meaning | unit | default | allowed | published |\n| --- | --- | --- | --- | --- | --- |\n";
    for (const Key& key : schema.keys) {
      if (key.section != section) continue;
      const std::string allowed =
          key.choices.empty() ? range_text(key) : fmt::format("{}", fmt::join(key.choices, ", "));
      text +=
          fmt::format("| `{}` | {} | {} | {} | {} | {} |\n", key.name, key.help,
                      key.has_unit() ? accepted_units(key.dimension) : "", default_words(key), allowed, key.published);
    }
  }
  return text;
}

}  // namespace

std::string resolved_toml(const TestCase& test) {
  return std::visit([](const auto& concrete) { return resolved_text(concrete); }, test);
}

std::string new_case_text(const NewCase& wanted) {
  if (wanted.test == "direct_shear") return template_text(new_direct_shear(wanted));
  if (wanted.test == "grain_compression") return template_text(GrainCompressionCase{});
  throw InputError(fmt::format("\"{}\" is not a test; known are direct_shear and grain_compression", wanted.test));
}

std::string key_table_markdown() {
  return "## `test = \"direct_shear\"`\n" + markdown_tables<DirectShearCase>() +
         "\n## `test = \"grain_compression\"`\n" + markdown_tables<GrainCompressionCase>();
}

}  // namespace dem
