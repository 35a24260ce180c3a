// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/report/report_page.hpp"

#include <chrono>
#include <cmath>
#include <set>
#include <utility>

#include <fmt/chrono.h>
#include <fmt/format.h>

#include "dem4grm/core/error.hpp"
#include "dem4grm/report/campaign_data.hpp"
#include "dem4grm/report/test_data.hpp"
#include "dem4grm/version.hpp"

namespace dem {
namespace {

/// Everything is inside the page, so nothing else may be asked for, whatever stands in the data. Pictures and films that the page
/// makes itself have addresses of their own (blob).
constexpr std::string_view k_policy =
    "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: blob:; media-src blob:; "
    "base-uri 'none'; form-action 'none'";

std::string utc_text() {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(now));
}

bool is_campaign(const std::filesystem::path& folder) {
  std::error_code ignored;
  return std::filesystem::exists(CampaignFolder(folder).record(), ignored);
}

/// The last part of a path, also of one that ends with a slash.
std::string name_of_folder(const std::filesystem::path& folder) {
  const std::filesystem::path whole = std::filesystem::absolute(folder).lexically_normal();
  return whole.has_filename() ? whole.filename().string() : whole.parent_path().filename().string();
}

/// A name that no other test of the page has.
std::string unused_name(const std::string& wanted, std::set<std::string>& used) {
  std::string name = wanted;
  for (int k = 2; !used.insert(name).second; ++k) name = fmt::format("{} ({})", wanted, k);
  return name;
}

/// Numbers of grains compare only in the published box.
bool has_published_box(const JsonObject& test) {
  const JsonValue* inputs = find_field(test, "inputs");
  const auto* sections = inputs == nullptr ? nullptr : std::get_if<JsonList>(&inputs->data);
  if (sections == nullptr) return false;
  int same = 0;
  for (const JsonValue& section : *sections) {
    const auto* fields = std::get_if<JsonObject>(&section.data);
    if (fields == nullptr || text_in(*fields, "section") != "box") continue;
    for (const JsonValue& row : std::get<JsonList>(find_field(*fields, "rows")->data)) {
      const auto& cells = std::get<JsonObject>(row.data);
      const std::string key = text_in(cells, "key"), value = text_in(cells, "value");
      same += (key == "length" || key == "width") && value == "100 mm" ? 1 : 0;
      same += key == "height" && value == "53 mm" ? 1 : 0;
    }
  }
  return same == 3;
}

struct CampaignParts {
  CampaignRecord record;
  std::vector<TestStatus> states;
  Collection collection;
  std::vector<std::filesystem::path> folders;  ///< of the tests that have something to show
  std::vector<std::string> names;
};

CampaignParts read_parts(const std::filesystem::path& root, std::vector<std::string>& notes) {
  const CampaignFolder folder(root);
  CampaignParts out;
  out.record = read_campaign(folder);
  out.states = status_of_all(folder, out.record);
  std::vector<CollectedTest> finished;
  for (std::size_t k = 0; k < out.record.tests.size(); ++k) {
    const RecordedTest& test = out.record.tests[k];
    if (out.states[k].state == TestState::done) finished.push_back({test.name, test.values, folder.test(test.name)});
    if (out.states[k].state == TestState::done || out.states[k].displacement > 0.0) {
      out.folders.push_back(folder.test(test.name));
      out.names.push_back(test.name);
    }
  }
  out.collection = read_collection(finished);
  notes.insert(notes.end(), out.collection.warnings.begin(), out.collection.warnings.end());
  return out;
}

JsonList laboratory_list(const ReportRequest& request, const JsonList& tests) {
  JsonList out;
  for (const LaboratoryCurve& curve : request.laboratory) {
    const std::string only =
        tests.size() == 1 ? text_in(std::get<JsonObject>(tests.front().data), "name") : std::string();
    out.emplace_back(laboratory_as_json(curve, only));
  }
  return out;
}

JsonList published_list(const ReportRequest& request, const JsonList& tests) {
  bool is_full_size = false;
  for (const JsonValue& test : tests) is_full_size = is_full_size || has_published_box(std::get<JsonObject>(test.data));
  std::vector<PublishedValue> rows;
  for (const PublishedValue& row : request.published) {
    const bool is_count = row.quantity == "clumps" || row.quantity == "rubber_grains";
    if (is_full_size || !is_count) rows.push_back(row);
  }
  return published_as_json(rows);
}

/// The key numbers for a reader without scripts, and for search in mails and folders.
std::string plain_table(const JsonObject& data) {
  std::string rows;
  for (const JsonValue& value : std::get<JsonList>(find_field(data, "tests")->data)) {
    const auto& test = std::get<JsonObject>(value.data);
    const auto& summary = std::get<JsonObject>(find_field(test, "summary")->data);
    rows += fmt::format("<tr><th colspan=\"2\">{}</th></tr>", html_text(text_in(test, "name")));
    for (const char* name :
         {"normal_stress_mean_kPa", "peak_shear_stress_kPa", "displacement_at_peak_mm", "residual_shear_stress_kPa",
          "dilation_angle_deg", "void_ratio_before_shear", "load_at_end_N"}) {
      if (has_number(summary, name))
        rows += fmt::format("<tr><td>{}</td><td>{}</td></tr>", name, number_in(summary, name));
    }
  }
  return fmt::format(
      "<p>This page draws its figures with a script; without it only these numbers can be shown.</p><table>{}</table>",
      rows);
}

/// JSON inside a script element: nothing in it may look like the end of the element.
std::string script_safe(const std::string& text) {
  std::string out;
  out.reserve(text.size());
  for (const char c : text) {
    if (c == '<')
      out += "\\u003c";
    else
      out += c;
  }
  return out;
}

}  // namespace

std::string html_text(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\'':
        out += "&#39;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

JsonObject report_data(const ReportRequest& request, std::vector<std::string>& notes) {
  if (request.folders.empty()) throw Error(ExitCode::usage, "a report needs at least one folder");
  const bool shows_campaign = is_campaign(request.folders.front());
  for (const std::filesystem::path& folder : request.folders) {
    if (request.folders.size() > 1 && is_campaign(folder)) {
      throw Error(ExitCode::usage,
                  fmt::format("{}: is a campaign; a report shows one campaign, or tests", folder.string()));
    }
  }
  std::optional<CampaignParts> campaign;
  std::vector<std::filesystem::path> folders = request.folders;
  if (shows_campaign) {
    campaign = read_parts(request.folders.front(), notes);
    folders = campaign->folders;
  }
  TestDataOptions options;
  options.resamples = request.live_seconds > 0 ? 0 : request.resamples;
  const bool has_views = !shows_campaign && folders.size() <= k_most_views && request.states_in_view > 0;
  options.states_in_view = has_views ? request.states_in_view : 0;
  options.has_wall_table = folders.size() <= k_most_views;
  if (!has_views && request.states_in_view > 0 && !folders.empty()) {
    notes.emplace_back("The view of each specimen stands in the report of its own folder.");
  }
  std::set<std::string> used;
  JsonList tests;
  for (std::size_t k = 0; k < folders.size(); ++k) {
    const std::string name = unused_name(shows_campaign ? campaign->names[k] : name_of_folder(folders[k]), used);
    tests.emplace_back(test_data(folders[k], name, options, notes));
  }
  JsonObject out{{"format", 1},
                 {"kind", shows_campaign ? "campaign" : "tests"},
                 {"live_seconds", request.live_seconds > 0 ? JsonValue(request.live_seconds) : JsonValue()},
                 {"title", shows_campaign        ? campaign->record.study
                           : folders.size() == 1 ? text_in(std::get<JsonObject>(tests.front().data), "name")
                                                 : fmt::format("{} tests", folders.size())},
                 {"program", JsonObject{{"version", std::string(k_version)},
                                        {"commit", std::string(k_commit)},
                                        {"written", utc_text()},
                                        {"command", request.command}}}};
  out.push_back({"campaign", shows_campaign
                                 ? JsonValue(campaign_data(campaign->record, campaign->states, campaign->collection))
                                 : JsonValue()});
  out.push_back({"published", published_list(request, tests)});
  out.push_back({"laboratory", laboratory_list(request, tests)});
  out.push_back({"tests", std::move(tests)});
  out.push_back({"notes", JsonValue(notes)});
  return out;
}

ReportPage report_page(const ReportRequest& request) {
  if (!request.page.is_there()) {
    throw MissingFileError(
        "this build of dem4grm carries no page, since node and npm were not there when it was built; run "
        "tools/build_page.sh "
        "and build again, or name a folder with page.js and page.css by --page");
  }
  ReportPage out;
  const JsonObject data = report_data(request, out.notes);
  out.tests = std::get<JsonList>(find_field(data, "tests")->data).size();
  out.html = "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n";
  out.html += fmt::format("<meta http-equiv=\"Content-Security-Policy\" content=\"{}\">\n", k_policy);
  out.html += "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n";
  out.html += "<meta name=\"referrer\" content=\"no-referrer\">\n<link rel=\"icon\" href=\"data:,\">\n";
  out.html += fmt::format("<title>{} - DEM4GRM</title>\n<style>", html_text(text_in(data, "title")));
  out.html += request.page.style;
  out.html += "</style>\n</head>\n<body>\n<main id=\"page\"></main>\n<noscript>" + plain_table(data) + "</noscript>\n";
  out.html += "<script id=\"data\" type=\"application/json\">" + script_safe(compact_json_text(data)) + "</script>\n";
  out.html += "<script>" + request.page.script + "</script>\n</body>\n</html>\n";
  return out;
}

}  // namespace dem
