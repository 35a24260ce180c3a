// SPDX-License-Identifier: BSD-3-Clause
// Walk through the tree of a case against the schema.
#include "dem4grm/case_file/case_keys.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include <fmt/format.h>

#include "dem4grm/case_file/nearest_name.hpp"

namespace dem {
namespace {

/// Names from papers and other programs, with the key that stands for them here.
struct OtherName {
  std::string_view theirs, ours;
};
constexpr std::array k_other_names{
    OtherName{"mu", "friction"},
    OtherName{"friction_coefficient", "friction"},
    OtherName{"vrc", "rubber_content"},
    OtherName{"dr", "relative_density"},
    OtherName{"d_r", "relative_density"},
    OtherName{"sigma_n", "normal_stress"},
    OtherName{"sigma", "normal_stress"},
    OtherName{"g", "shear_modulus"},
    OtherName{"nu", "poisson_ratio"},
    OtherName{"poisson", "poisson_ratio"},
    OtherName{"rho", "density"},
    OtherName{"e", "modulus"},
    OtherName{"young_modulus", "modulus"},
    OtherName{"kn_ks", "stiffness_ratio"},
    OtherName{"kratio", "stiffness_ratio"},
    OtherName{"speed", "velocity"},
    OtherName{"shear_rate", "velocity"},
    OtherName{"damping", "local_damping"},
    OtherName{"time_step", "time_step_safety"},
    OtherName{"dt", "time_step_safety"},
};

std::string lower(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return result;
}

std::string joined(std::string_view section, std::string_view name) {
  return section.empty() ? std::string(name) : fmt::format("{}.{}", section, name);
}

std::string home_of(const Key& key) {
  return key.section.empty() ? "before the first section" : fmt::format("in [{}]", key.section);
}

class KeyFinder {
 public:
  KeyFinder(const Schema& schema, const Schema& other, CaseProblems& problems)
      : schema_(schema), other_(other), problems_(problems) {}

  GivenKeys run(const TomlNode& root) {
    walk(root, "");
    report_missing();
    return std::move(given_);
  }

 private:
  void walk(const TomlNode& table, std::string_view section) {
    for (const TomlMember& member : table.members) {
      const std::string path = joined(section, member.key);
      if (schema_.has_section(path)) {
        take_section(member, path);
      } else if (const Key* key = schema_.find(path)) {
        take_key(member, *key);
      } else if (member.value.kind == TomlKind::table) {
        unknown_section(member, path);
      } else {
        unknown_key(member, section);
      }
    }
  }

  void take_section(const TomlMember& member, const std::string& path) {
    given_.sections[path] = member.key_place;
    if (member.value.kind == TomlKind::table) return walk(member.value, path);
    given_.bad.insert(path);
    const bool is_list = member.value.kind == TomlKind::array;
    problems_.error(member.key_place, fmt::format("{} is a section: write [{}] on a line of its own, {}", path, path,
                                                  is_list ? "once and with single brackets" : "then its keys below"));
  }

  void take_key(const TomlMember& member, const Key& key) {
    given_.nodes[key.path()] = &member.value;
    if (problems_.ignores(member.value.place)) given_.bad.insert(key.path());
    if (member.value.kind != TomlKind::table) return;
    given_.bad.insert(key.path());
    problems_.error(member.key_place, fmt::format("{} is a key, not a section", key.path()), key_note(key));
  }

  void unknown_section(const TomlMember& member, const std::string& path) {
    const std::vector<std::string_view> names = section_names(schema_);
    std::string hint;
    if (other_.has_section(path)) {
      hint = fmt::format("; it belongs to test = \"{}\"", test_of(other_));
    } else if (const auto near = nearest_name(path, names)) {
      hint = fmt::format("; did you mean [{}]?", *near);
    } else if (const auto elsewhere = nearest_name(path, section_names(other_))) {
      hint = fmt::format("; did you mean [{}] of test = \"{}\"?", *elsewhere, test_of(other_));
    } else {
      hint = fmt::format("; known are {}", fmt::join(names, ", "));
    }
    problems_.error(member.key_place, fmt::format("unknown section [{}]{}", printable(path), hint));
  }

  void unknown_key(const TomlMember& member, std::string_view section) {
    const std::string where = section.empty() ? " before the first section" : fmt::format(" in [{}]", section);
    problems_.error(member.key_place, fmt::format("unknown key \"{}\"{}{}", printable(member.key), where,
                                                  suggestion(member.key, section)));
  }

  /// The nearest name in the same section, then the same name elsewhere, then the nearest name anywhere.
  std::string suggestion(std::string_view name, std::string_view section) const {
    if (problems_.error_count() > 100) return {};  // nobody reads them, and a hostile file could make them slow
    std::vector<std::string_view> here, everywhere;
    for (const Key& key : schema_.keys) {
      everywhere.push_back(key.name);
      if (key.section == section) here.push_back(key.name);
    }
    if (const auto ours = name_here(name, here)) return fmt::format("; did you mean \"{}\"?", *ours);
    if (const Key* key = key_named(schema_, name)) return fmt::format("; it belongs {}", home_of(*key));
    if (const auto near = nearest_name(name, here)) return fmt::format("; did you mean \"{}\"?", *near);
    if (const Key* key = key_named(other_, name)) {
      return fmt::format("; it belongs {} of test = \"{}\"", home_of(*key), test_of(other_));
    }
    const auto near = nearest_name(name, everywhere);
    if (!near) return {};
    return fmt::format("; did you mean \"{}\" {}?", *near, home_of(*key_named(schema_, *near)));
  }

  static std::optional<std::string_view> name_here(std::string_view name, const std::vector<std::string_view>& here) {
    const std::string wanted = lower(name);
    for (const OtherName& other : k_other_names) {
      if (other.theirs == wanted && std::find(here.begin(), here.end(), other.ours) != here.end()) return other.ours;
    }
    return std::nullopt;
  }

  static std::vector<std::string_view> section_names(const Schema& schema) {
    std::vector<std::string_view> names;
    for (const Section& section : schema.sections) names.push_back(section.name);
    return names;
  }

  static const Key* key_named(const Schema& schema, std::string_view name) {
    const auto found =
        std::find_if(schema.keys.begin(), schema.keys.end(), [name](const Key& key) { return key.name == name; });
    return found == schema.keys.end() ? nullptr : &*found;
  }

  static std::string_view test_of(const Schema& schema) {
    const Key* test = schema.find("test");
    return std::get<TestName>(test->slot).name;
  }

  void report_missing() {
    for (const Key& key : schema_.keys) {
      if (!key.is_required || given_.has(key.path())) continue;
      given_.bad.insert(key.path());
      const std::string section(key.section);
      if (given_.bad.contains(section)) continue;
      const auto header = given_.sections.find(section);
      if (header == given_.sections.end()) {
        problems_.error({}, fmt::format("section [{}] is missing; it must give {}", section, key.name), key_note(key));
      } else {
        problems_.error(header->second, fmt::format("[{}] does not give {}", section, key.name), key_note(key));
      }
    }
  }

  const Schema& schema_;
  const Schema& other_;
  CaseProblems& problems_;
  GivenKeys given_;
};

/// The table for a section, made when it is not there; nullptr when something else has its name.
TomlNode* section_table(TomlNode& root, std::string_view path, const Place& place) {
  TomlNode* table = &root;
  while (!path.empty()) {
    const std::size_t dot = std::min(path.find('.'), path.size());
    const std::string_view name = path.substr(0, dot);
    path.remove_prefix(std::min(dot + 1, path.size()));
    auto member = std::find_if(table->members.begin(), table->members.end(),
                               [name](const TomlMember& candidate) { return candidate.key == name; });
    if (member == table->members.end()) {
      TomlNode made;
      made.place = place;
      table->members.push_back({std::string(name), place, std::move(made)});
      member = std::prev(table->members.end());
    }
    if (member->value.kind != TomlKind::table) return nullptr;
    table = &member->value;
  }
  return table;
}

/// Keys that exclude each other: an option for one of them takes the place of the other in the file as well.
constexpr std::string_view k_section_of_density = "specimen";
struct Exclusion {
  std::string_view chosen, excluded;
};
constexpr std::array k_exclusions{Exclusion{"preparation_friction", "relative_density"},
                                  Exclusion{"relative_density", "preparation_friction"}};

void drop_excluded(TomlNode& root, std::span<const Override> overrides) {
  const auto is_option = [&](std::string_view name) {
    const std::string path = fmt::format("{}.{}", k_section_of_density, name);
    return std::any_of(overrides.begin(), overrides.end(), [&](const Override& o) { return o.key == path; });
  };
  for (const Exclusion& pair : k_exclusions) {
    if (!is_option(pair.chosen) || is_option(pair.excluded)) continue;
    for (TomlMember& section : root.members) {
      if (section.key != k_section_of_density) continue;
      std::erase_if(section.value.members, [&](const TomlMember& member) { return member.key == pair.excluded; });
    }
  }
}

}  // namespace

bool GivenKeys::are_good(std::initializer_list<std::string_view> paths) const {
  return std::none_of(paths.begin(), paths.end(), [this](std::string_view path) { return bad.contains(path); });
}

Place GivenKeys::place_of(std::initializer_list<std::string_view> paths) const {
  for (const std::string_view path : paths) {
    if (const auto found = nodes.find(path); found != nodes.end()) return found->second->place;
  }
  for (const std::string_view path : paths) {
    const auto found = sections.find(path.substr(0, path.rfind('.')));
    if (found != sections.end()) return found->second;
  }
  return {};
}

void apply_overrides(TomlNode& root, std::span<const Override> overrides, CaseProblems& problems) {
  for (std::size_t i = 0; i < overrides.size(); ++i) {
    const std::string& key = overrides[i].key;
    const std::string& value = overrides[i].value;
    const Place place{1, 1, 1, static_cast<int>(i)};
    // A line break in the comment would end it, so that the scan would see the rest as TOML.
    const bool has_break = value.find_first_of("\r\n") != std::string::npos;
    if (has_break || value.size() >= k_largest_case_file || !scan_toml("#" + value).problems.empty()) {
      problems.error(place, "the value is not one line of UTF-8 text");
      continue;
    }
    const std::size_t dot = key.rfind('.');
    const std::string_view section =
        dot == std::string::npos ? std::string_view() : std::string_view(key).substr(0, dot);
    const std::string name = dot == std::string::npos ? key : key.substr(dot + 1);
    const bool has_empty_part = name.empty() || key.starts_with('.') || key.find("..") != std::string::npos;
    TomlNode* table = has_empty_part || key.size() > 200 ? nullptr : section_table(root, section, place);
    if (table == nullptr) {
      problems.error(place, "not a key; write it as section.key=value, for example shear.normal_stress=60kPa");
      continue;
    }
    const TomlNode* old = find_member(*table, name);
    if (old != nullptr && old->kind == TomlKind::table) {
      problems.error(place, fmt::format("{} is a section, not a key", printable(key)));
      continue;
    }
    std::erase_if(table->members, [&name](const TomlMember& member) { return member.key == name; });
    TomlNode node;
    node.kind = TomlKind::option_text;
    node.text = value;
    node.place = place;
    table->members.push_back({name, place, std::move(node)});
  }
  drop_excluded(root, overrides);
}

GivenKeys find_keys(const TomlNode& root, const Schema& schema, const Schema& other, CaseProblems& problems) {
  return KeyFinder(schema, other, problems).run(root);
}

}  // namespace dem
