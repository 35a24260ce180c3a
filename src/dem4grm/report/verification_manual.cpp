// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/report/verification_manual.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace dem {
namespace {

struct ComparisonText {
  const char* word;       // in tables and JSON
  const char* tolerance;  // {} is the number
};

ComparisonText text_of(Comparison c) {
  switch (c) {
    case Comparison::relative:
      return {"relative", "{:.1e} rel."};
    case Comparison::absolute:
      return {"absolute", "{:.1e} abs."};
    case Comparison::at_most:
      return {"at most", "at most"};
    case Comparison::at_least:
      return {"at least", "at least"};
  }
  return {"", ""};
}

std::string tolerance_text(const Check& c) {
  return fmt::format(fmt::runtime(text_of(c.comparison).tolerance), c.tolerance);
}

std::string value_text(double value) { return fmt::format("{:.6g}", value); }

/// A cell of a Markdown table.
std::string cell(std::string text) {
  for (std::size_t at = text.find('|'); at != std::string::npos; at = text.find('|', at + 2)) text.insert(at, "\\");
  return text;
}

int count_checks(const std::vector<CaseOutcome>& outcomes) {
  int n = 0;
  for (const CaseOutcome& o : outcomes) n += static_cast<int>(o.findings.checks().size());
  return n;
}

int count_missed(const std::vector<CaseOutcome>& outcomes) {
  int n = 0;
  for (const CaseOutcome& o : outcomes) n += o.missed();
  return n;
}

std::string section(const CaseOutcome& o) {
  std::string text =
      fmt::format("## {}\n\n`dem4grm verify --only {}`\n\n{}\n\n", o.tested->title, o.tested->name, o.tested->text);
  for (const Picture& p : o.findings.pictures()) text += fmt::format("![{}](pictures/{}.png)\n\n", p.title, p.name);
  text +=
      "| quantity | unit | expected | obtained | error | tolerance | source |\n| --- | --- | --- | --- | --- | --- | "
      "--- |\n";
  for (const Check& c : o.findings.checks()) {
    text += fmt::format("| {} | {} | {} | {} | {:.1e} | {} | {}{} |\n", cell(c.quantity), c.unit,
                        value_text(c.expected), value_text(c.obtained), c.error(), tolerance_text(c), cell(c.source),
                        c.passes() ? "" : " **MISSED**");
  }
  text += '\n';
  for (const std::string& remark : o.findings.remarks()) text += remark + "\n\n";
  return text;
}

}  // namespace

std::string verification_table_head() {
  return fmt::format("     {:<22} {:<62} {:>12} {:>12} {:<6} {:>8} {:>12}  {}\n", "case", "quantity", "expected",
                     "obtained", "unit", "error", "tolerance", "source");
}

std::string verification_table_rows(const CaseOutcome& outcome) {
  std::string text;
  for (const Check& c : outcome.findings.checks()) {
    text += fmt::format("{:<4} {:<22} {:<62} {:>12} {:>12} {:<6} {:>8.1e} {:>12}  {}\n", c.passes() ? "ok" : "MISS",
                        outcome.tested->name, c.quantity, value_text(c.expected), value_text(c.obtained), c.unit,
                        c.error(), tolerance_text(c), c.source);
  }
  return text;
}

std::string verification_verdict(const std::vector<CaseOutcome>& outcomes) {
  return fmt::format("{} quantities in {} cases, {} missed\n", count_checks(outcomes), outcomes.size(),
                     count_missed(outcomes));
}

JsonList verification_json(const std::vector<CaseOutcome>& outcomes) {
  JsonList list;
  for (const CaseOutcome& o : outcomes) {
    for (const Check& c : o.findings.checks()) {
      list.emplace_back(JsonObject{{"case", o.tested->name},
                                   {"quantity", c.quantity},
                                   {"unit", c.unit},
                                   {"expected", c.expected},
                                   {"obtained", c.obtained},
                                   {"error", c.error()},
                                   {"tolerance", c.tolerance},
                                   {"comparison", text_of(c.comparison).word},
                                   {"passed", c.passes()},
                                   {"source", c.source}});
    }
  }
  return list;
}

std::string verification_manual(const std::vector<CaseOutcome>& outcomes) {
  std::string text = fmt::format(
      "# Verification manual\n\n"
      "Written by `tools/make_verification_manual.py` from a run of `dem4grm verify`; not edited by hand. Every case\n"
      "runs the engine that runs the tests, and every expected value comes from outside the engine: a closed form, "
      "a\n"
      "published benchmark or an independent calculation named in the column `source`.\n\n"
      "Relative errors are |obtained / expected - 1|, absolute ones |obtained - expected| in the unit of the row; a "
      "limit\n"
      "(`at most`, `at least`) has the error 0 when it is kept.\n\n"
      "{}\n",
      verification_verdict(outcomes));
  text += "| case | quantities | largest error over tolerance |\n| --- | --- | --- |\n";
  for (const CaseOutcome& o : outcomes) {
    double worst = 0.0;
    for (const Check& c : o.findings.checks()) {
      if (c.tolerance > 0.0) worst = std::max(worst, c.error() / c.tolerance);
    }
    text += fmt::format("| [{}](#{}) | {} | {:.2f} |\n", o.tested->title, o.tested->name, o.findings.checks().size(),
                        worst);
  }
  text += '\n';
  for (const CaseOutcome& o : outcomes) text += fmt::format("<a id=\"{}\"></a>\n\n", o.tested->name) + section(o);
  text.pop_back();
  return text;
}

JsonList verification_curves(const std::vector<CaseOutcome>& outcomes) {
  const auto numbers = [](const std::vector<double>& values) {
    JsonList list;
    for (const double v : values) list.emplace_back(v);
    return list;
  };
  JsonList pictures;
  for (const CaseOutcome& o : outcomes) {
    for (const Picture& p : o.findings.pictures()) {
      JsonList series;
      for (const Series& s : p.series) {
        series.emplace_back(
            JsonObject{{"label", s.label}, {"is_reference", s.is_reference}, {"x", numbers(s.x)}, {"y", numbers(s.y)}});
      }
      pictures.emplace_back(JsonObject{
          {"name", p.name}, {"title", p.title}, {"x_label", p.x_label}, {"y_label", p.y_label}, {"series", series}});
    }
  }
  return pictures;
}

}  // namespace dem
