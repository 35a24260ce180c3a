// SPDX-License-Identifier: BSD-3-Clause
// The only file that includes the JSON library.
#include "dem4grm/results/json_text.hpp"

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include <fmt/format.h>

#include "dem4grm/core/error.hpp"

namespace dem {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const JsonObject& object);

struct ToJson {
  Json operator()(std::monostate) const { return nullptr; }
  Json operator()(const JsonObject& object) const { return to_json(object); }
  Json operator()(const JsonList& list) const {
    Json out = Json::array();
    for (const JsonValue& value : list) out.push_back(std::visit(ToJson{}, value.data));
    return out;
  }
  template <class Scalar>
  Json operator()(const Scalar& value) const {
    return value;
  }
};

Json to_json(const JsonObject& object) {
  Json out = Json::object();
  for (const JsonField& field : object) out[field.name] = std::visit(ToJson{}, field.value.data);
  return out;
}

JsonValue from_json(const Json& json) {
  if (json.is_boolean()) return json.get<bool>();
  if (json.is_number_integer()) return json.get<std::int64_t>();
  if (json.is_number()) return json.get<double>();
  if (json.is_string()) return json.get<std::string>();
  if (json.is_array()) {
    JsonList list;
    for (const Json& item : json) list.push_back(from_json(item));
    return list;
  }
  if (json.is_object()) {
    JsonObject object;
    for (const auto& [name, value] : json.items()) object.push_back({name, from_json(value)});
    return object;
  }
  return {};
}

/// Bytes that are no UTF-8 (a folder name may hold any) are replaced instead of thrown about.
std::string dumped(const JsonValue& value) {
  return std::visit(ToJson{}, value.data).dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace

JsonValue::JsonValue() = default;
JsonValue::JsonValue(bool value) : data(value) {}
JsonValue::JsonValue(int value) : data(static_cast<std::int64_t>(value)) {}
JsonValue::JsonValue(std::int64_t value) : data(value) {}
JsonValue::JsonValue(double value) : data(value) {}
JsonValue::JsonValue(const char* value) : data(std::string(value)) {}
JsonValue::JsonValue(std::string value) : data(std::move(value)) {}
JsonValue::JsonValue(JsonList value) : data(std::move(value)) {}
JsonValue::JsonValue(JsonObject value) : data(std::move(value)) {}

JsonValue::JsonValue(const std::vector<std::string>& values) {
  JsonList list;
  for (const std::string& value : values) list.emplace_back(value);
  data = std::move(list);
}

std::string json_text(const JsonObject& object) { return dumped(object); }

std::string compact_json_text(const JsonObject& object) {
  return to_json(object).dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string json_text(const JsonList& list) { return dumped(list); }

JsonObject parse_json(std::string_view text, const std::filesystem::path& source) {
  const Json json = Json::parse(text, nullptr, false);
  if (json.is_discarded() || !json.is_object()) {
    throw IoError(fmt::format("{}: is no JSON object; the file is damaged", source.string()));
  }
  return std::get<JsonObject>(from_json(json).data);
}

JsonObject read_json_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw MissingFileError(fmt::format("{}: cannot be opened", path.string()));
  const std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  return parse_json(text, path);
}

const JsonValue* find_field(const JsonObject& object, std::string_view name) {
  for (const JsonField& field : object) {
    if (field.name == name) return &field.value;
  }
  return nullptr;
}

bool has_number(const JsonObject& object, std::string_view name) {
  const JsonValue* field = find_field(object, name);
  return field != nullptr &&
         (std::holds_alternative<double>(field->data) || std::holds_alternative<std::int64_t>(field->data));
}

double number_in(const JsonObject& object, std::string_view name, double otherwise) {
  const JsonValue* value = find_field(object, name);
  if (value == nullptr) return otherwise;
  if (const auto* real = std::get_if<double>(&value->data)) return *real;
  if (const auto* whole = std::get_if<std::int64_t>(&value->data)) return static_cast<double>(*whole);
  return otherwise;
}

std::string text_in(const JsonObject& object, std::string_view name) {
  const JsonValue* value = find_field(object, name);
  const auto* text = value != nullptr ? std::get_if<std::string>(&value->data) : nullptr;
  return text != nullptr ? *text : std::string();
}

bool is_set_in(const JsonObject& object, std::string_view name) {
  const JsonValue* value = find_field(object, name);
  const auto* flag = value != nullptr ? std::get_if<bool>(&value->data) : nullptr;
  return flag != nullptr && *flag;
}

}  // namespace dem
