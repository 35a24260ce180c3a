// SPDX-License-Identifier: BSD-3-Clause
// JSON as plain values: what the program writes in JSON goes through here, so that one source file knows the library.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace dem {

struct JsonValue;
struct JsonField;
using JsonList = std::vector<JsonValue>;
/// Names and values in the order in which they are written.
using JsonObject = std::vector<JsonField>;

/// One value; a number that is not finite is written as null.
struct JsonValue {
  std::variant<std::monostate, bool, std::int64_t, double, std::string, JsonList, JsonObject> data;

  JsonValue();
  JsonValue(bool value);
  JsonValue(int value);
  JsonValue(std::int64_t value);
  JsonValue(double value);
  JsonValue(const char* value);
  JsonValue(std::string value);
  JsonValue(JsonList value);
  JsonValue(JsonObject value);
  JsonValue(const std::vector<std::string>& values);
};

struct JsonField {
  std::string name;
  JsonValue value;
};

/// The object as text with two spaces of indent and a final line break. Equal values give equal bytes.
std::string json_text(const JsonObject& object);
/// The same on one line, for programs.
std::string compact_json_text(const JsonObject& object);
/// The same for a list.
std::string json_text(const JsonList& list);

/// Reads a JSON object from text. Throws IoError that names `source` when the text is none.
JsonObject parse_json(std::string_view text, const std::filesystem::path& source);

/// Reads a file that holds one JSON object. Throws MissingFileError or IoError.
JsonObject read_json_file(const std::filesystem::path& path);

/// The field of that name, or nullptr.
const JsonValue* find_field(const JsonObject& object, std::string_view name);
/// The number in a field; `otherwise` when there is none.
double number_in(const JsonObject& object, std::string_view name, double otherwise = 0.0);
/// True when the field is there and holds a number.
bool has_number(const JsonObject& object, std::string_view name);
/// The text in a field; empty when there is none.
std::string text_in(const JsonObject& object, std::string_view name);
/// True when the field is there and true.
bool is_set_in(const JsonObject& object, std::string_view name);

}  // namespace dem
