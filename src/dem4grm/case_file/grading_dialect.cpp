// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/case_file/grading_dialect.hpp"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <initializer_list>

#include "dem4grm/case_file/csv_text.hpp"

namespace dem {
namespace {

std::string lower(std::string_view text) {
  std::string out(text);
  std::transform(out.begin(), out.end(), out.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return out;
}

bool has_one_of(const std::string& text, std::initializer_list<std::string_view> words) {
  return std::any_of(words.begin(), words.end(),
                     [&](std::string_view word) { return text.find(word) != std::string::npos; });
}

/// The word by itself: "m" in "size (m)" or "size_m", not in "mm".
bool has_word(const std::string& text, std::string_view word) {
  const auto is_letter = [&](std::size_t k) {
    return k < text.size() && std::isalpha(static_cast<unsigned char>(text[k])) != 0;
  };
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
    if (!(at > 0 && is_letter(at - 1)) && !is_letter(at + word.size())) return true;
  }
  return false;
}

bool read_size(const std::string& name, GradingDialect& dialect) {
  if (!has_one_of(name, {"size", "sieve", "opening", "aperture", "diameter", "mesh"}) && !has_word(name, "d"))
    return false;
  if (has_word(name, "mm")) return true;
  if (has_one_of(name, {"\xc2\xb5m", "\xce\xbcm", "micron", "micrometer", "micrometre"}) || has_word(name, "um")) {
    dialect.size_exponent = -6;
    dialect.notes.emplace_back("sizes in micrometres");
  } else if (has_word(name, "cm")) {
    dialect.size_exponent = -2;
    dialect.notes.emplace_back("sizes in cm");
  } else if (has_word(name, "m")) {
    dialect.size_exponent = 0;
    dialect.notes.emplace_back("sizes in m");
  } else {
    dialect.notes.emplace_back("sizes in mm, since no unit is named");
  }
  return true;
}

bool read_share(const std::string& name, GradingDialect& dialect) {
  if (has_one_of(name, {"retained"})) {
    // What lies on one sieve alone is another number, and the two cannot be told apart by looking.
    if (!has_one_of(name, {"cum"}) || has_one_of(name, {"non", "not", "individual", "partial"})) return false;
    dialect.is_retained = true;
    dialect.notes.emplace_back("shares are those retained, added up from the coarsest sieve");
  } else if (!has_one_of(name, {"passing", "finer", "undersize"})) {
    return false;
  }
  if (has_one_of(name, {"percent", "per cent", "%"})) return true;
  if (has_one_of(name, {"fraction"}) || has_word(name, "-")) {
    dialect.share_exponent = 0;
    dialect.notes.emplace_back("shares as fractions of 1");
  } else {
    dialect.notes.emplace_back("shares in per cent, since the header does not say");
  }
  return true;
}

void append_utf8(std::string& out, std::uint32_t c) {
  const auto put = [&](std::uint32_t byte) { out += static_cast<char>(byte); };
  if (c < 0x80) {
    put(c);
  } else if (c < 0x800) {
    put(0xC0 | c >> 6), put(0x80 | (c & 0x3F));
  } else if (c < 0x10000) {
    put(0xE0 | c >> 12), put(0x80 | (c >> 6 & 0x3F)), put(0x80 | (c & 0x3F));
  } else {
    put(0xF0 | c >> 18), put(0x80 | (c >> 12 & 0x3F)), put(0x80 | (c >> 6 & 0x3F)), put(0x80 | (c & 0x3F));
  }
}

}  // namespace

std::optional<GradingDialect> grading_dialect(std::string_view header) {
  GradingDialect dialect;
  for (const char separator : {';', '\t'}) {
    if (header.find(separator) == std::string_view::npos) continue;
    dialect.separator = separator;
    dialect.has_decimal_commas = true;
    dialect.notes.emplace_back(separator == ';' ? "columns parted by semicolons" : "columns parted by tabs");
    break;
  }
  const std::vector<CsvField> names = fields_of_line(header, dialect.separator);
  if (names.size() != 2 || !read_size(lower(names[0].text), dialect) || !read_share(lower(names[1].text), dialect)) {
    return std::nullopt;
  }
  return dialect;
}

std::string without_utf16(std::string_view bytes) {
  const bool is_little = bytes.starts_with("\xFF\xFE"), is_big = bytes.starts_with("\xFE\xFF");
  if (!is_little && !is_big) return std::string(bytes);
  const auto unit = [&](std::size_t k) {
    const auto a = static_cast<unsigned char>(bytes[k]), b = static_cast<unsigned char>(bytes[k + 1]);
    return static_cast<std::uint32_t>(is_little ? a | b << 8 : a << 8 | b);
  };
  std::string out;
  for (std::size_t k = 2; k + 1 < bytes.size(); k += 2) {
    std::uint32_t c = unit(k);
    const bool is_pair =
        c >= 0xD800 && c < 0xDC00 && k + 3 < bytes.size() && unit(k + 2) >= 0xDC00 && unit(k + 2) < 0xE000;
    if (is_pair) {
      c = 0x10000 + ((c - 0xD800) << 10) + (unit(k + 2) - 0xDC00);
      k += 2;
    }
    append_utf8(out, c);
  }
  return out;
}

}  // namespace dem
