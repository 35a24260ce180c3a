// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/report/published_values.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "dem4grm/case_file/csv_text.hpp"
#include "dem4grm/core/error.hpp"
#include "dem4grm/core/quantity.hpp"
#include "dem4grm/report/page_bundle.hpp"

namespace dem {
namespace {

constexpr std::string_view k_published_header = "rubber_content,normal_stress_kPa,quantity,value,source";

class PublishedReader {
 public:
  PublishedReader(std::string_view text, std::string_view name) : text_(without_mark(text), name) {}

  std::vector<PublishedValue> run() {
    bool has_header = false;
    for (std::size_t line = 0; line < text_.line_count(); ++line) {
      const std::vector<CsvField> fields = text_.fields_of(line);
      if (is_blank_or_comment(fields)) continue;
      if (has_header) {
        take(line, fields);
      } else if (text_.whole(line).text == k_published_header) {
        has_header = true;
      } else {
        problems_.push_back(text_.problem(line, text_.whole(line),
                                          fmt::format("the first line must be the header \"{}\"", k_published_header)));
        break;
      }
    }
    if (!problems_.empty()) throw InputError(fmt::format("{}", fmt::join(problems_, "\n")));
    return std::move(values_);
  }

 private:
  void take(std::size_t line, const std::vector<CsvField>& fields) {
    if (fields.size() != 5) {
      problems_.push_back(text_.problem(line, text_.whole(line), fmt::format("{} fields instead of 5", fields.size())));
      return;
    }
    PublishedValue row;
    const std::optional<double> content = number(line, fields[0]), value = number(line, fields[3]);
    if (!fields[1].text.empty()) row.normal_stress_kPa = number(line, fields[1]);
    if (content && (*content < 0.0 || *content > 1.0)) {
      problems_.push_back(
          text_.problem(line, fields[0], fmt::format("rubber content {} is outside [0, 1]", fields[0].text)));
    }
    if (fields[2].text.empty()) {
      problems_.push_back(text_.problem(line, fields[2], "a name of summary.json is missing"));
    }
    row.rubber_content = content.value_or(0.0);
    row.value = value.value_or(0.0);
    row.quantity = fields[2].text;
    row.source = fields[4].text;
    values_.push_back(std::move(row));
  }

  std::optional<double> number(std::size_t line, const CsvField& field) {
    const std::optional<double> value = parse_decimal(field.text);
    if (!value) problems_.push_back(text_.problem(line, field, not_a_number(field)));
    return value;
  }

  CsvText text_;
  std::vector<PublishedValue> values_;
  std::vector<std::string> problems_;
};

}  // namespace

std::vector<PublishedValue> parse_published_values(std::string_view text, std::string_view name) {
  return PublishedReader(text, name).run();
}

std::string_view shipped_published_values() { return built_in_published_values(); }

JsonList published_as_json(const std::vector<PublishedValue>& values) {
  JsonList out;
  for (const PublishedValue& row : values) {
    out.emplace_back(
        JsonObject{{"rubber_content", row.rubber_content},
                   {"normal_stress_kPa", row.normal_stress_kPa ? JsonValue(*row.normal_stress_kPa) : JsonValue()},
                   {"quantity", row.quantity},
                   {"value", row.value},
                   {"source", row.source}});
  }
  return out;
}

}  // namespace dem
