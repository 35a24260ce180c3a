// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/report/case_inputs.hpp"

#include <string>
#include <utility>

namespace dem {
namespace {

constexpr std::string_view k_not_set = " is not set: ";

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view k_blanks = " \t\r";
  const std::size_t begin = text.find_first_not_of(k_blanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(k_blanks) - begin + 1);
}

/// Where a comment begins in a line of values, outside of texts; npos without one.
std::size_t comment_of(std::string_view line) {
  bool is_in_text = false;
  for (std::size_t k = 0; k < line.size(); ++k) {
    if (line[k] == '\\' && is_in_text)
      ++k;
    else if (line[k] == '"')
      is_in_text = !is_in_text;
    else if (line[k] == '#' && !is_in_text)
      return k;
  }
  return std::string_view::npos;
}

class InputReader {
 public:
  JsonList run(std::string_view text) {
    while (!text.empty()) {
      const std::size_t end = std::min(text.find('\n'), text.size());
      take(trimmed(text.substr(0, end)));
      text.remove_prefix(std::min(end + 1, text.size()));
    }
    close_section();
    return std::move(sections_);
  }

 private:
  void take(std::string_view line) {
    if (!list_key_.empty()) {
      take_list_line(line);
    } else if (line.starts_with('#')) {
      take_comment(trimmed(line.substr(1)));
    } else if (line.starts_with('[')) {
      close_section();
      section_ = line.substr(1, line.find(']') - 1);
    } else if (const std::size_t equals = line.find(" = "); equals != std::string_view::npos) {
      take_value(line.substr(0, equals), line.substr(equals + 3));
    }
  }

  void take_comment(std::string_view text) {
    const std::size_t at = text.find(k_not_set);
    if (at == std::string_view::npos) {
      list_comment_ = text;  // that of the list which follows
      return;
    }
    const std::string_view rest = text.substr(at + k_not_set.size());
    const std::size_t comment = rest.find("  # ");
    add(text.substr(0, at), "not set: " + std::string(rest.substr(0, comment)),
        comment == std::string_view::npos ? std::string_view() : trimmed(rest.substr(comment + 4)));
  }

  void take_value(std::string_view key, std::string_view rest) {
    if (trimmed(rest) == "[") {
      list_key_ = key;
      list_text_.clear();
      return;
    }
    const std::size_t comment = comment_of(rest);
    const bool has_comment = comment != std::string_view::npos;
    add(key, std::string(trimmed(rest.substr(0, comment))),
        has_comment ? trimmed(rest.substr(comment + 1)) : std::string_view());
  }

  void take_list_line(std::string_view line) {
    if (line != "]") {
      list_text_ += (list_text_.empty() ? "" : " ") + std::string(line);
      return;
    }
    if (list_text_.ends_with(',')) list_text_.pop_back();
    add(list_key_, std::exchange(list_text_, {}), list_comment_);
    list_key_.clear();
    list_comment_.clear();
  }

  void add(std::string_view key, std::string value, std::string_view comment) {
    if (value.size() >= 2 && value.front() == '"' && value.find('"', 1) == value.size() - 1) {
      value = value.substr(1, value.size() - 2);
    }
    rows_.emplace_back(
        JsonObject{{"key", std::string(key)}, {"value", std::move(value)}, {"comment", std::string(comment)}});
  }

  void close_section() {
    if (!rows_.empty()) sections_.emplace_back(JsonObject{{"section", section_}, {"rows", std::exchange(rows_, {})}});
  }

  JsonList sections_, rows_;
  std::string section_, list_key_, list_text_, list_comment_;
};

}  // namespace

JsonList case_inputs(std::string_view resolved_toml) { return InputReader().run(resolved_toml); }

}  // namespace dem
