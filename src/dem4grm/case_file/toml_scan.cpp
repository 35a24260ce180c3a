// SPDX-License-Identifier: BSD-3-Clause
// The scan in front of toml++: its parser is safe on what passes here (tests/property/case_file_property_test.cpp).
#include "dem4grm/case_file/toml_scan.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include <fmt/format.h>

namespace dem {
namespace {

constexpr int k_most_brackets = 64;          // open at once; a case needs three
constexpr int k_most_key_parts = 16;         // of one dotted key; a case needs three
constexpr std::size_t k_most_problems = 20;  // of foreign characters; nobody reads more

struct NamedCharacter {
  char32_t code;
  std::string_view hint;
};
// What people type or paste, with what they should write.
constexpr std::array k_named_characters{
    NamedCharacter{0x00B5, "micro sign; write \"friction\" for a friction coefficient, \"um\" for micrometres"},
    NamedCharacter{0x03BC, "Greek mu; write \"friction\" for a friction coefficient"},
    NamedCharacter{0x03C3, "Greek sigma; write \"normal_stress\""},
    NamedCharacter{0x03C1, "Greek rho; write \"density\""},
    NamedCharacter{0x03BD, "Greek nu; write \"poisson_ratio\""},
    NamedCharacter{0x00A0, "a blank that does not break; write a plain blank"},
    NamedCharacter{0x2212, "minus sign of typesetting; write -"},
    NamedCharacter{0x2013, "dash of typesetting; write -"},
    NamedCharacter{0x201C, "quotation mark of typesetting; write \""},
    NamedCharacter{0x201D, "quotation mark of typesetting; write \""},
    NamedCharacter{0x201E, "quotation mark of typesetting; write \""},
    NamedCharacter{0x2018, "quotation mark of typesetting; write \""},
    NamedCharacter{0x2019, "quotation mark of typesetting; write \""},
    NamedCharacter{0x200B, "a blank without width; remove it"},
    NamedCharacter{0xFEFF, "a byte-order mark inside the file; remove it"},
};

/// One decoded character; a length of 0 marks a byte that is not valid UTF-8.
struct Decoded {
  char32_t code = 0;
  std::size_t length = 0;
};

Decoded decode(std::string_view text, std::size_t at) {
  const auto byte = [text](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(at);
  if (first < 0x80) return {first, 1};
  std::size_t length = 0;
  char32_t code = 0;
  if (first >= 0xC2 && first <= 0xDF) {
    length = 2, code = first & 0x1Fu;
  } else if (first >= 0xE0 && first <= 0xEF) {
    length = 3, code = first & 0x0Fu;
  } else if (first >= 0xF0 && first <= 0xF4) {
    length = 4, code = first & 0x07u;
  }
  if (length == 0 || at + length > text.size()) return {};
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(at + i) & 0xC0u) != 0x80u) return {};
    code = (code << 6) | (byte(at + i) & 0x3Fu);
  }
  const bool is_overlong = (length == 3 && code < 0x800) || (length == 4 && code < 0x10000);
  const bool is_surrogate = code >= 0xD800 && code <= 0xDFFF;
  if (is_overlong || is_surrogate || code > 0x10FFFF) return {};
  return {code, length};
}

/// Walks through the text once, knowing whether it is inside a comment or a string.
class Scanner {
 public:
  explicit Scanner(std::string_view text) : text_(text) { result_.text.reserve(text.size()); }

  TomlScan run() {
    while (at_ < text_.size() && !result_.is_fatal) {
      const Decoded character = decode(text_, at_);
      if (character.length == 0 || character.code == 0) {
        fatal(character.length == 0 ? fmt::format("byte 0x{:02x} is not UTF-8; save the file as UTF-8 text",
                                                  static_cast<unsigned char>(text_[at_]))
                                    : "a NUL byte: this is not a text file");
        break;
      }
      take(character);
    }
    return std::move(result_);
  }

 private:
  enum class Inside : std::uint8_t { nothing, comment, basic, literal, long_basic, long_literal };

  void take(const Decoded& character) {
    const std::string_view bytes = text_.substr(at_, character.length);
    std::size_t also = 0;  // characters that belong to this one, all ASCII on the same line
    if (inside_ == Inside::nothing) {
      if (character.length > 1) return take_foreign(character);
      also = take_plain(static_cast<char>(character.code));
    } else {
      also = take_inside(static_cast<char>(character.length == 1 ? character.code : U'x'));
    }
    is_in_foreign_run_ = false;
    result_.text += bytes;
    result_.text += text_.substr(at_ + character.length, also);
    at_ += character.length + also;
    column_ += 1 + static_cast<int>(also);
    if (character.code == U'\n') ++line_, column_ = 1;
  }

  std::size_t take_plain(char c) {
    if (c == '#') inside_ = Inside::comment;
    if (c == '"' || c == '\'') {
      const bool is_long = text_.substr(at_).starts_with(c == '"' ? "\"\"\"" : "'''");
      inside_ = c == '"' ? (is_long ? Inside::long_basic : Inside::basic)
                         : (is_long ? Inside::long_literal : Inside::literal);
      return is_long ? 2 : 0;
    }
    count_nesting(c);
    return 0;
  }

  /// toml++ limits brackets by itself, but recurses without limit into the tables of a dotted key.
  void count_nesting(char c) {
    if (c == '[' || c == '{') {
      if (++brackets_ > k_most_brackets) fatal(fmt::format("more than {} brackets are open here", k_most_brackets));
    }
    if ((c == ']' || c == '}') && brackets_ > 0) --brackets_;
    if (c == '.') {
      if (++key_parts_ > k_most_key_parts) fatal(fmt::format("a key of more than {} parts", k_most_key_parts));
    }
    if (c == '\n' || c == '=' || c == ',' || c == '[' || c == '{') key_parts_ = 0;
  }

  std::size_t take_inside(char c) {
    const bool is_long = inside_ == Inside::long_basic || inside_ == Inside::long_literal;
    if (c == '\n' && !is_long) {
      inside_ = Inside::nothing;
      key_parts_ = 0;
      return 0;
    }
    if (inside_ == Inside::comment) return 0;
    const bool has_escapes = inside_ == Inside::basic || inside_ == Inside::long_basic;
    if (has_escapes && c == '\\') {
      const bool hides_quote = at_ + 1 < text_.size() && (text_[at_ + 1] == '"' || text_[at_ + 1] == '\\');
      return hides_quote ? 1 : 0;
    }
    const char quote = has_escapes ? '"' : '\'';
    if (c != quote) return 0;
    if (!is_long) {
      inside_ = Inside::nothing;
      return 0;
    }
    std::size_t quotes = 1;
    while (quotes < 5 && at_ + quotes < text_.size() && text_[at_ + quotes] == quote) ++quotes;
    if (quotes < 3) return 0;
    inside_ = Inside::nothing;  // up to two quotes may stand in front of the closing three
    return quotes - 1;
  }

  void take_foreign(const Decoded& character) {
    if (!is_in_foreign_run_ && result_.problems.size() < k_most_problems) {
      const auto* named = std::find_if(k_named_characters.begin(), k_named_characters.end(),
                                       [&](const NamedCharacter& known) { return known.code == character.code; });
      const std::string shown = printable(text_.substr(at_, character.length));
      result_.problems.push_back({{line_, column_, 1},
                                  fmt::format("\"{}\" (U+{:04X}) outside a comment or quotes: keys and numbers are "
                                              "plain ASCII",
                                              shown, static_cast<std::uint32_t>(character.code)),
                                  named == k_named_characters.end() ? "" : std::string(named->hint)});
    }
    is_in_foreign_run_ = true;
    result_.text += 'x';
    at_ += character.length;
    ++column_;
  }

  void fatal(std::string message) {
    result_.problems.push_back({{line_, column_, 1}, std::move(message), {}});
    result_.is_fatal = true;
  }

  std::string_view text_;
  TomlScan result_;
  std::size_t at_ = 0;
  int line_ = 1;
  int column_ = 1;
  int brackets_ = 0;
  int key_parts_ = 0;
  Inside inside_ = Inside::nothing;
  bool is_in_foreign_run_ = false;
};

}  // namespace

TomlScan scan_toml(std::string_view bytes) {
  if (bytes.size() > k_largest_case_file) {
    TomlScan result;
    result.problems.push_back({{}, "the file is larger than 1 MiB: this is not a case file", {}});
    result.is_fatal = true;
    return result;
  }
  if (bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);
  return Scanner(bytes).run();
}

std::vector<std::string_view> split_lines(std::string_view text) {
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    std::string_view line = text.substr(0, end);
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    lines.push_back(line);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
  return lines;
}

std::string printable(std::string_view text, std::size_t most) {
  std::string safe;
  std::size_t count = 0;
  for (std::size_t at = 0; at < text.size(); ++count) {
    if (count == most) return safe + "...";
    Decoded character = decode(text, at);
    const bool is_control = character.code < 0x20 || (character.code >= 0x7F && character.code < 0xA0);
    // Marks that turn the writing direction could make a message read as something else.
    const bool is_direction = (character.code >= 0x202A && character.code <= 0x202E) ||
                              (character.code >= 0x2066 && character.code <= 0x2069);
    if (character.code == '\t') {
      safe += ' ';
    } else if (character.length == 0 || is_control || is_direction) {
      safe += '?';
    } else {
      safe += text.substr(at, character.length);
    }
    at += std::max<std::size_t>(1, character.length);
  }
  return safe;
}

int character_count(std::string_view text) {
  return static_cast<int>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0u) != 0x80u; }));
}

std::string_view characters(std::string_view text, int begin, int count) {
  const auto skip = [](std::string_view rest, int n) {
    std::size_t at = 0;
    while (at < rest.size() && n > 0) {
      ++at;
      while (at < rest.size() && (static_cast<unsigned char>(rest[at]) & 0xC0u) == 0x80u) ++at;
      --n;
    }
    return at;
  };
  text.remove_prefix(skip(text, begin));
  return text.substr(0, skip(text, count));
}

}  // namespace dem
