// SPDX-License-Identifier: BSD-3-Clause
// The guard in front of toml++, and the words about what is not TOML.
#include "dem4grm/case_file/toml_guard.hpp"

#include <gtest/gtest.h>

#include "dem4grm/case_file/case_file.hpp"
#include "dem4grm/core/error.hpp"

namespace dem {
namespace {

/// "line:column message" of the first problem; "" for a text without one.
std::string first_problem(std::string_view text) {
  const TomlDocument document = parse_toml(text);
  if (document.problems.empty()) return {};
  const TomlProblem& problem = document.problems.front();
  return std::to_string(problem.place.line) + ":" + std::to_string(problem.place.column) + " " + problem.message;
}

TEST(TomlGuard, KeepsValuesAndPlaces) {
  const TomlDocument document = parse_toml("b = 1\na = \"x\u00e4\" # \u03c3\n[s]\nc = [1.5, true]\n");
  ASSERT_TRUE(document.problems.empty());
  ASSERT_EQ(document.root.members.size(), 3u);
  EXPECT_EQ(document.root.members[0].key, "b");
  EXPECT_EQ(document.root.members[1].value.text, "x\u00e4");
  EXPECT_EQ(document.root.members[1].value.place.line, 2);
  EXPECT_EQ(document.root.members[1].value.place.column, 5);
  EXPECT_EQ(document.root.members[1].value.place.length, 4);
  const TomlNode* section = find_member(document.root, "s");
  ASSERT_NE(section, nullptr);
  const TomlNode* list = find_member(*section, "c");
  ASSERT_NE(list, nullptr);
  EXPECT_EQ(list->items.at(0).number, 1.5);
  EXPECT_TRUE(list->items.at(1).flag);
}

TEST(TomlGuard, AnyLetterBehindABackslashIsAnErrorAndNothingWorse) {
  // The sanitizer of undefined behaviour looks on: the library's tables of Unicode have holes (toml_guard.cpp).
  for (unsigned c = 0x80; c < 0x3100; c += 7) {
    std::string text = "a = \"\"\"\\ ";
    if (c < 0x800) {
      text += {static_cast<char>(0xC0 | c >> 6), static_cast<char>(0x80 | (c & 0x3F))};
    } else {
      text += {static_cast<char>(0xE0 | c >> 12), static_cast<char>(0x80 | (c >> 6 & 0x3F)),
               static_cast<char>(0x80 | (c & 0x3F))};
    }
    EXPECT_NE(first_problem(text + " \"\"\"\n"), "") << std::hex << c;
  }
}

TEST(TomlGuard, ForeignCharactersOutsideStrings) {
  EXPECT_EQ(first_problem("a = 1\n\u00b5 = 0.72\n"),
            "2:1 \"\u00b5\" (U+00B5) outside a comment or quotes: keys and numbers are plain ASCII");
  EXPECT_EQ(first_problem("\u03c3_n = 3\n"),
            "1:1 \"\u03c3\" (U+03C3) outside a comment or quotes: keys and numbers are plain ASCII");
  EXPECT_EQ(first_problem("a = \u201c60 kPa\u201d\n"),
            "1:5 \"\u201c\" (U+201C) outside a comment or quotes: keys and numbers are plain ASCII");
  EXPECT_EQ(first_problem(
                "a = \"\u00b5\" # \u00b5\nb = '\u00b5'\nc = \"\"\"\u00b5\n\u00b5\"\"\"\nd = '''\u00b5'\n\u00b5'''\n"),
            "");
  EXPECT_EQ(first_problem("a = \"\\\"\u00b5\"\nb = \"\"\"x\"\"\"\"\"\n\"k\u00b5\" = '\\'\n"), "");
  // A quote that is escaped does not end the string; an unclosed one ends with its line.
  EXPECT_TRUE(first_problem("a = \"x\n\u00b5 = 1\n").starts_with("2:1 \"\u00b5\""));
}

TEST(TomlGuard, BytesThatAreNotText) {
  EXPECT_EQ(first_problem("a = 1\nb = \"\xff\"\n"), "2:6 byte 0xff is not UTF-8; save the file as UTF-8 text");
  EXPECT_EQ(first_problem("# \xc3"), "1:3 byte 0xc3 is not UTF-8; save the file as UTF-8 text");
  EXPECT_EQ(first_problem("# \xed\xa0\x80"), "1:3 byte 0xed is not UTF-8; save the file as UTF-8 text");
  EXPECT_EQ(first_problem("# \xc0\xaf"), "1:3 byte 0xc0 is not UTF-8; save the file as UTF-8 text");
  EXPECT_EQ(first_problem(std::string_view("a = 1\n\0b", 8)), "2:1 a NUL byte: this is not a text file");
  EXPECT_EQ(first_problem("\xEF\xBB\xBF"
                          "a = 1\n"),
            "");
  EXPECT_EQ(first_problem(std::string(k_largest_case_file + 1, '#')),
            "1:1 the file is larger than 1 MiB: this is not a case file");
  EXPECT_EQ(first_problem(std::string(k_largest_case_file, '#')), "");
}

TEST(TomlGuard, NestingIsLimited) {
  EXPECT_EQ(first_problem(std::string(100000, '[')), "1:65 more than 64 brackets are open here");
  EXPECT_EQ(first_problem("a = " + std::string(100000, '[')), "1:69 more than 64 brackets are open here");
  EXPECT_EQ(first_problem("a = " + std::string(100000, '{')), "1:69 more than 64 brackets are open here");
  EXPECT_EQ(parse_toml(std::string(100000, '[')).problems.size(), 1u);
  std::string dotted;
  for (int i = 0; i < 400000; ++i) dotted += "a.";
  EXPECT_EQ(first_problem(dotted + "a = 1\n"), "1:34 a key of more than 16 parts");
  EXPECT_EQ(first_problem("[" + dotted + "a]\n"), "1:35 a key of more than 16 parts");
}

TEST(TomlGuard, SayWhatWasMeant) {
  EXPECT_EQ(first_problem("a = 60 kPa\n"), "1:5 a value with a unit is text and needs quotes: a = \"60 kPa\"");
  EXPECT_EQ(first_problem("a = 2mm # x\n"), "1:5 a value with a unit is text and needs quotes: a = \"2mm\"");
  EXPECT_EQ(first_problem("a = lower\n"), "1:5 text needs quotes: a = \"lower\"");
  EXPECT_EQ(first_problem("a = yes\n"), "1:5 yes is not a value here; write true or false");
  EXPECT_EQ(first_problem("a = 25 %\n"), "1:5 fractions are not written in per cent: a = 0.25");
  EXPECT_EQ(first_problem("a = 5,6\n"), "1:5 write 5,6 with a decimal point instead of the comma");
  EXPECT_EQ(first_problem("a = .5\n"), "1:5 .5: a number needs a digit on both sides of its point");
  EXPECT_EQ(first_problem("a =\n"), "1:4 a has no value");
  EXPECT_EQ(first_problem("a = 1\nb = 2\na = 3\n"), "3:1 \"a\" is given twice");
  EXPECT_EQ(first_problem("[s]\n[s]\n"), "2:1 \"s\" is given twice");
  EXPECT_TRUE(first_problem("a\n").starts_with("1:2 not valid TOML: expected '='")) << first_problem("a\n");
  EXPECT_TRUE(first_problem("[[[[x\n").starts_with("1:3 not valid TOML: "));
}

TEST(TomlGuard, OneBadLineDoesNotHideTheNext) {
  const TomlDocument document = parse_toml("a = 60 kPa\nb = lower\nc = 3\nc = 4\n[s]\nd = 1\n");
  ASSERT_TRUE(document.is_usable);
  ASSERT_EQ(document.problems.size(), 3u);
  EXPECT_EQ(document.reported_lines, (std::set<int>{1, 2, 4}));
  EXPECT_NE(find_member(document.root, "s"), nullptr);
  EXPECT_EQ(find_member(document.root, "c")->integer, 3);
}

TEST(TomlGuard, OutputIsSafeForATerminal) {
  EXPECT_EQ(printable("a\x1b[31mb\tc\x7f"), "a?[31mb c?");
  EXPECT_EQ(printable("\u202egnp"), "?gnp");
  EXPECT_EQ(printable("\xff\u00e4"), "?\u00e4");
  EXPECT_EQ(printable("abcdef", 3), "abc...");
  try {
    parse_case("\"\\u001b[31m\" = 1\n", "case.toml");
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()).find('\x1b'), std::string::npos);
  }
}

}  // namespace
}  // namespace dem
