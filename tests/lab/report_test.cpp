// SPDX-License-Identifier: BSD-3-Clause
// Reports as a user makes them: what a run and a campaign write at their end, numbers equal to those of the files, nothing of a
// user's text taken for HTML, and what happens to damaged, running and missing folders. How a page looks and works is tested in
// web/test, in a browser.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include "support/command_line.hpp"

namespace dem {
namespace {

using test::CommandLine;
using test::ProgramResult;
using test::read_all;
using test::RunningProgram;
using test::write_all;

class Report : public CommandLine {
 protected:
  [[nodiscard]] JsonObject data_of(std::vector<std::string> folders) const {
    std::vector<std::string> words{"report", "--data", "--bootstrap", "0"};
    words.insert(words.end(), folders.begin(), folders.end());
    const ProgramResult result = run(words);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return parse_json(result.out, "data");
  }
  [[nodiscard]] static const JsonObject& test_in(const JsonObject& data, std::size_t place) {
    return std::get<JsonObject>(std::get<JsonList>(find_field(data, "tests")->data).at(place).data);
  }
  /// A page with a script that can be told from everything else.
  void write_page_bundle() const {
    std::filesystem::create_directory(folder_ / "page");
    write_all(folder_ / "page/page.js", "show();");
    write_all(folder_ / "page/page.css", "body { margin: 0 }");
  }
};

std::size_t count_of(const std::string& text, const std::string& words) {
  std::size_t n = 0;
  for (std::size_t at = text.find(words); at != std::string::npos; at = text.find(words, at + 1)) ++n;
  return n;
}

TEST_F(Report, NumbersAreThoseOfTheFilesAndTextStaysText) {
  const std::string name = "</script><script>alert(1)</script><b>&'";
  const ProgramResult ran =
      run({"run", "tiny.toml", "-o", "out", "-q", "--no-report", "--set", fmt::format("name=\"{}\"", name)});
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out/report.html"));

  const JsonObject data = data_of({"out"});
  const JsonObject& test = test_in(data, 0);
  EXPECT_EQ(json_text(std::get<JsonObject>(find_field(test, "summary")->data)), read_all(folder_ / "out/summary.json"));
  const auto& tables = std::get<JsonObject>(find_field(test, "tables")->data);
  for (const char* table : {"shear", "micro", "profiles", "walls"}) {
    const auto& shown = std::get<JsonObject>(find_field(tables, table)->data);
    const auto& columns = std::get<JsonList>(find_field(shown, "columns")->data);
    const auto& values = std::get<JsonList>(find_field(shown, "values")->data);
    // Written again as the file has it: the same bytes, but that JSON has no nan.
    std::string text;
    for (const JsonValue& column : columns) text += (text.empty() ? "" : ",") + std::get<std::string>(column.data);
    text += '\n';
    const std::size_t rows = std::get<JsonList>(values.front().data).size();
    for (std::size_t row = 0; row < rows; ++row) {
      for (std::size_t c = 0; c < values.size(); ++c) {
        const JsonValue& cell = std::get<JsonList>(values[c].data)[row];
        text += c == 0 ? "" : ",";
        if (std::holds_alternative<std::monostate>(cell.data)) text += "nan";
        if (const auto* number = std::get_if<double>(&cell.data)) text += fmt::format("{}", *number);
      }
      text += '\n';
    }
    EXPECT_EQ(text, read_all(folder_ / (std::string("out/") + table + ".csv"))) << table;
  }

  write_page_bundle();
  const ProgramResult made = run({"report", "out", "--page", "page"});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  const std::string page = read_all(folder_ / "out/report.html");
  EXPECT_EQ(count_of(page, "<script"), 2U);  // the data and ours
  EXPECT_EQ(count_of(page, "</script>"), 2U);
  EXPECT_EQ(page.find("alert(1)</script>"), std::string::npos);
  EXPECT_NE(page.find("default-src 'none'"), std::string::npos);
  EXPECT_EQ(page.find("http://"), std::string::npos);
  EXPECT_EQ(page.find("https://"), std::string::npos);
}

TEST_F(Report, ARunAndACampaignWriteItAtTheirEnd) {
  if (run({"report", "nowhere"}).err.find("carries no page") != std::string::npos) {
    GTEST_SKIP() << "this build carries no page";
  }
  write_all(folder_ / "study.toml", "base = \"tiny.toml\"\n[axes]\nrubber_content = [0, 0.2]\n");
  const ProgramResult ran = run({"campaign", "run", "study.toml", "-o", "out", "-w", "2", "-j", "1"});
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  for (const char* file : {"out/report.html", "out/tests/vrc000/report.html", "out/tests/vrc020/report.html"}) {
    EXPECT_TRUE(read_all(folder_ / file).ends_with("</html>\n")) << file;
  }
  const JsonObject data = data_of({"out"});
  EXPECT_EQ(text_in(data, "kind"), "campaign");
  const auto& campaign = std::get<JsonObject>(find_field(data, "campaign")->data);
  EXPECT_EQ(std::get<JsonList>(find_field(campaign, "tests")->data).size(), 2U);
  const auto& envelopes = std::get<JsonList>(find_field(campaign, "envelopes")->data);
  ASSERT_FALSE(envelopes.empty());
  const auto& points = std::get<JsonList>(find_field(std::get<JsonObject>(envelopes.front().data), "points")->data);
  ASSERT_EQ(points.size(), 1U);
  EXPECT_EQ(number_in(std::get<JsonObject>(points.front().data), "shear_stress_kPa"),
            number_in(json("out/tests/vrc000/summary.json"), "peak_shear_stress_kPa"));
  // A finished run is only reported: its page stays as it is.
  const auto written = std::filesystem::last_write_time(folder_ / "out/tests/vrc020/report.html");
  EXPECT_EQ(run({"run", "out/cases/vrc020.toml", "-o", "out/tests/vrc020"}).exit_code, 0);
  EXPECT_EQ(std::filesystem::last_write_time(folder_ / "out/tests/vrc020/report.html"), written);
}

TEST_F(Report, SaysWhatItCannotShow) {
  ASSERT_EQ(run({"run", "tiny.toml", "-o", "out", "-q", "--no-report"}).exit_code, 0);
  std::filesystem::copy(folder_ / "out", folder_ / "hurt", std::filesystem::copy_options::recursive);
  std::filesystem::resize_file(folder_ / "hurt/results.h5", 3000);
  const JsonObject data = data_of({"out", "hurt"});
  EXPECT_TRUE(std::holds_alternative<JsonObject>(find_field(test_in(data, 0), "view")->data));
  EXPECT_TRUE(std::holds_alternative<std::monostate>(find_field(test_in(data, 1), "view")->data));
  const auto& notes = std::get<JsonList>(find_field(data, "notes")->data);
  ASSERT_FALSE(notes.empty());
  EXPECT_NE(std::get<std::string>(notes.front().data).find("hurt/results.h5"), std::string::npos);

  expect(66, "holds no test", {"report", "page-less", "--data"});
  write_page_bundle();
  expect(66, "page.js", {"report", "out", "--page", "out"});
  expect(65, "no line names the columns", {"report", "out", "--page", "page", "--lab", "tiny.toml"});
  expect(66, "none.csv", {"report", "out", "--page", "page", "--lab", "none.csv"});
  write_all(folder_ / "lab.csv", "displacement_mm;shear_stress_kPa\n0;0\n0,5;40\n");
  const ProgramResult lab = run({"report", "out", "--page", "page", "--lab", "lab.csv"});
  EXPECT_EQ(lab.exit_code, 0) << lab.err;
  EXPECT_NE(lab.err.find("read as displacement in mm"), std::string::npos) << lab.err;
}

TEST_F(Report, FollowsARunningTest) {
  write_page_bundle();
  RunningProgram running(
      words({"run", "tiny.toml", "-o", "out", "-q", "--no-report", "--set", "shear.velocity=20 mm/s"}), folder_.path());
  ASSERT_TRUE(test::wait_for_file(folder_ / "out/shear.csv", 60.0));
  RunningProgram live(words({"report", "out", "--page", "page", "--live", "1", "-o", "live.html"}), folder_.path());
  RunningProgram watch(words({"watch", "out"}), folder_.path());
  ASSERT_TRUE(test::wait_for_file(folder_ / "live.html", 30.0));
  EXPECT_NE(read_all(folder_ / "live.html").find("\"live_seconds\":1,"), std::string::npos);
  ASSERT_EQ(running.wait().exit_code, 0);
  EXPECT_EQ(live.wait().exit_code, 0);
  const ProgramResult watched = watch.wait();
  EXPECT_EQ(watched.exit_code, 0) << watched.err;
  EXPECT_NE(watched.out.find("peak shear stress"), std::string::npos) << watched.out;
  EXPECT_NE(read_all(folder_ / "live.html").find("\"live_seconds\":null"), std::string::npos);
}

}  // namespace
}  // namespace dem
