// SPDX-License-Identifier: BSD-3-Clause
// The case reader on thousands of damaged files, and the resolved copy on random values.
#include <gtest/gtest.h>
// rapidcheck's bridge needs GoogleTest in front of it.
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include "dem4grm/case_file/case_file.hpp"
#include "dem4grm/case_file/case_schema.hpp"
#include "dem4grm/case_file/grading_file.hpp"
#include "dem4grm/case_file/toml_scan.hpp"
#include "dem4grm/core/error.hpp"
#include "unit/case_file/case_bits.hpp"

namespace dem {
namespace {

const std::filesystem::path k_cases = std::filesystem::path(DEM_SOURCE_DIR) / "cases";

std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Good cases to damage: short, long, and of both tests.
const std::vector<std::string>& good_cases() {
  static const std::vector<std::string> texts{
      text_of(k_cases / "quick.toml"), text_of(k_cases / "grain_compression.toml"), new_case_text({}),
      new_case_text({"grain_compression"}), load_case(k_cases / "quick.toml").resolved_toml};
  return texts;
}

/// Pieces that hurt parsers, and pieces that people really type.
const std::vector<std::string> k_pieces{"[",
                                        "]",
                                        "[[",
                                        "]]",
                                        "{",
                                        "}",
                                        "\"",
                                        "'",
                                        "\"\"\"",
                                        "'''",
                                        "=",
                                        ".",
                                        ",",
                                        "#",
                                        "\n",
                                        "\r",
                                        "\r\n",
                                        "\t",
                                        "\\",
                                        "\\u",
                                        "\\U0010ffff",
                                        std::string(1, '\0'),
                                        "\x01",
                                        "\x7f",
                                        "\xff",
                                        "\xc3",
                                        "\xc2\xb5",
                                        "\xcf\x83",
                                        "\xe2\x80\x9c",
                                        "\xf0\x9f\x98\x80",
                                        "\xef\xbb\xbf",
                                        "\xe2\x80\xa8",
                                        "1e999",
                                        "-",
                                        "+",
                                        "_",
                                        "0x",
                                        "1979-05-27",
                                        "inf",
                                        "nan",
                                        "true",
                                        "60 kPa",
                                        "\"60 kPa\"",
                                        "5,6",
                                        "25 %",
                                        "T1",
                                        "[shear]",
                                        "[[shear]]",
                                        "[a.b.c]",
                                        "a = 1",
                                        "friction = 1\n",
                                        "test = 3\n",
                                        "= =",
                                        " "};

/// Damages a text in one to six places.
std::string damaged(std::string text) {
  const int count = *rc::gen::inRange(1, 7);
  for (int i = 0; i < count; ++i) {
    const auto at = static_cast<std::size_t>(*rc::gen::inRange(0, static_cast<int>(text.size()) + 1));
    const auto length = static_cast<std::size_t>(*rc::gen::inRange(1, 12));
    switch (*rc::gen::inRange(0, 6)) {
      case 0:
        text.insert(at, *rc::gen::elementOf(k_pieces));
        break;
      case 1:
        text.erase(at, length);
        break;
      case 2:
        text.replace(at, std::min(length, text.size() - at), *rc::gen::elementOf(k_pieces));
        break;
      case 3:
        text.insert(at,
                    text.substr(static_cast<std::size_t>(*rc::gen::inRange(0, static_cast<int>(text.size()) + 1)), 40));
        break;
      case 4:
        if (at < text.size()) text[at] = static_cast<char>(*rc::gen::inRange(0, 256));
        break;
      default:
        text.resize(at);
        break;
    }
  }
  return text;
}

/// Takes digits from the front and says whether there were any.
bool take_number(std::string_view& text) {
  const std::size_t digits = std::min(text.find_first_not_of("0123456789"), text.size());
  text.remove_prefix(digits);
  return digits > 0;
}

bool take(std::string_view& text, std::string_view expected) {
  if (!text.starts_with(expected)) return false;
  text.remove_prefix(expected.size());
  return true;
}

/// "case.toml:12:9: error: ..."; the file may be a grading whose name ends with .csv as well.
bool is_headline(std::string_view line) {
  if (!take(line, "case.toml")) {
    const std::size_t end = line.find(".csv:");
    if (end == std::string_view::npos) return false;
    line.remove_prefix(end + 4);
  }
  return take(line, ":") && take_number(line) && take(line, ":") && take_number(line) && take(line, ": error: ");
}

/// "   12 | text", or the caret line below it, or the line about problems that are not shown.
bool is_excerpt(std::string_view line) {
  if (line.starts_with("and ") && line.ends_with(" more")) return true;
  line.remove_prefix(std::min(line.find_first_not_of(' '), line.size()));
  take_number(line);
  return take(line, " |") || take(line, "|");
}

/// Every problem of a refusal must carry a place, and the last line the count.
void check_refusal(const std::string& message) {
  const std::vector<std::string_view> lines = split_lines(message);
  RC_ASSERT(lines.size() >= 2u);
  int errors = 0;
  for (std::size_t i = 0; i + 1 < lines.size(); ++i) {
    const bool has_place = is_headline(lines[i]);
    RC_ASSERT(has_place || is_excerpt(lines[i]));
    errors += has_place ? 1 : 0;
  }
  for (const char c : message) RC_ASSERT(c == '\n' || static_cast<unsigned char>(c) >= 0x20);
  RC_ASSERT(errors >= 1);
  if (errors < 100) {
    const std::string count = std::to_string(errors) + (errors == 1 ? " error" : " errors");
    RC_ASSERT(lines.back() == count + ", nothing was run");
  }
}

RC_GTEST_PROP(CaseFileProperty, DamagedFilesAreReadOrRefusedWithPlaces, ()) {
  constexpr int k_files_per_round = 50;  // times the 100 rounds of rapidcheck
  for (int i = 0; i < k_files_per_round; ++i) {
    const std::string text = damaged(*rc::gen::elementOf(good_cases()));
    try {
      const LoadedCase loaded = parse_case(text, "case.toml");
      RC_ASSERT(parse_case(loaded.resolved_toml, "resolved.toml").resolved_toml == loaded.resolved_toml);
    } catch (const InputError& error) {
      check_refusal(error.what());
    }
  }
}

RC_GTEST_PROP(CaseFileProperty, AnyBytesAreRefusedWithPlaces, (const std::string& text)) {
  try {
    parse_case(text, "case.toml");
    RC_FAIL("a case without its required keys was accepted");
  } catch (const InputError& error) {
    check_refusal(error.what());
  }
}

RC_GTEST_PROP(CaseFileProperty, DamagedGradingsNeverCrash, ()) {
  const std::string text = damaged(text_of(k_cases / "gradings" / "gravel-rounded.csv"));
  const GradingFile file = parse_grading(text, "g.csv");
  if (file.problems.empty()) {
    RC_ASSERT(grading_faults(file.points, PassingUnit::percent).empty());
  } else {
    for (const std::string& problem : file.problems) RC_ASSERT(problem.starts_with("g.csv:"));
  }
}

RC_GTEST_PROP(CaseFileProperty, OptionsWithAnyTextAreReadOrRefused, ()) {
  DirectShearCase bound;
  std::vector<std::string> paths;
  for (const Key& known : case_schema(bound).keys) paths.push_back(known.path());
  const std::string key = *rc::gen::elementOf(paths);
  const std::string value = *rc::gen::oneOf(rc::gen::elementOf(k_pieces), rc::gen::arbitrary<std::string>());
  const std::vector<Override> options{{key, value}};
  try {
    parse_case(new_case_text({}), "case.toml", options);
  } catch (const InputError& error) {
    const std::string message = error.what();
    RC_ASSERT(message.find(": error: ") != std::string::npos);
  }
}

/// A case whose numbers carry all 53 bits: every value of a good case, lowered by at most 5 %.
DirectShearCase random_case() {
  auto test = std::get<DirectShearCase>(load_case(k_cases / "quick.toml").test);
  const auto lower = [](double& value) { value *= 1.0 - 0.05 * *rc::gen::inRange(0, 1 << 30) / (1 << 30); };
  for (const Key& key : case_schema(test).keys) {
    if (auto* const* slot = std::get_if<double*>(&key.slot)) lower(**slot);
    if (auto* const* slot = std::get_if<std::vector<double>*>(&key.slot)) {
      for (double& value : **slot) lower(value);
    }
    if (auto* const* slot = std::get_if<std::optional<double>*>(&key.slot)) {
      **slot = std::min(0.7, key.range.most);
      lower(***slot);
    }
    // The inertial number stays beside a velocity: that it has no effect is a warning only.
    if (auto* const slot = std::get_if<QuantityOrWord>(&key.slot); slot != nullptr && *rc::gen::arbitrary<bool>()) {
      slot->value->reset();
    } else if (slot != nullptr) {
      lower(**slot->value);
    }
  }
  auto& either = *rc::gen::arbitrary<bool>() ? test.specimen.relative_density : test.specimen.preparation_friction;
  either.reset();  // a case gives one of them
  const double factor = 1.0 - 0.05 * *rc::gen::inRange(0, 1 << 30) / (1 << 30);
  for (GradingPoint& point : test.specimen.gravel_grading) {
    point.size *= factor;
    if (point.passing < 1.0) point.passing *= factor;
  }
  test.seed = static_cast<std::uint64_t>(*rc::gen::inRange<std::int64_t>(0, std::int64_t{1} << 62));
  test.name = "n" + *rc::gen::container<std::string>(rc::gen::inRange<char>(' ', '~'));
  return test;
}

RC_GTEST_PROP(CaseFileProperty, ResolvedCopyKeepsEveryBit, ()) {
  const DirectShearCase test = random_case();
  const LoadedCase loaded = parse_case(resolved_toml(test), "resolved.toml");
  RC_ASSERT(testing_support::all_bits(std::get<DirectShearCase>(loaded.test)) == testing_support::all_bits(test));
}

}  // namespace
}  // namespace dem
