// The part of JSON Schema that the schemas in docs/schemas use: type, enum, required, dependentRequired,
// properties, additionalProperties, items, minimum, maximum; contentEncoding is informative. Any other keyword in a
// schema is an error here, not ignored.
#pragma once

#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>
#include <string>

namespace incognita::testing {

using Json = nlohmann::json;

inline bool has_type(const Json& value, const std::string& type) {
  if (type == "object") return value.is_object();
  if (type == "array") return value.is_array();
  if (type == "string") return value.is_string();
  if (type == "integer") return value.is_number_integer();
  if (type == "number") return value.is_number();
  if (type == "boolean") return value.is_boolean();
  if (type == "null") return value.is_null();
  throw std::invalid_argument("schema type " + type);
}

inline void check_object(const Json& value, const Json& schema, const std::string& at, std::string& problems);

/// Violations of a schema by a value, one line each; empty when it conforms.
inline void check(const Json& value, const Json& schema, const std::string& at, std::string& problems) {
  static const std::set<std::string> known{
      "$schema",           "title",      "description",          "type",  "enum",    "required",
      "dependentRequired", "properties", "additionalProperties", "items", "minimum", "maximum",
      "contentEncoding"};
  for (const auto& [key, unused] : schema.items())
    if (!known.contains(key)) throw std::invalid_argument("schema keyword " + key);
  if (schema.contains("type")) {
    const Json types = schema["type"].is_array() ? schema["type"] : Json::array({schema["type"]});
    bool fits = false;
    for (const auto& type : types) fits = fits || has_type(value, type);
    if (!fits) problems += at + ": " + value.dump() + " is not " + types.dump() + "\n";
  }
  if (schema.contains("enum") &&
      std::find(schema["enum"].begin(), schema["enum"].end(), value) == schema["enum"].end())
    problems += at + ": " + value.dump() + " is none of " + schema["enum"].dump() + "\n";
  if (schema.contains("minimum") && value.is_number() && value < schema["minimum"])
    problems += at + ": " + value.dump() + " is too small\n";
  if (schema.contains("maximum") && value.is_number() && value > schema["maximum"])
    problems += at + ": " + value.dump() + " is too large\n";
  if (schema.contains("items") && value.is_array())
    for (const auto& item : value) check(item, schema["items"], at + "[]", problems);
  if (value.is_object()) check_object(value, schema, at, problems);
}

inline void check_object(const Json& value, const Json& schema, const std::string& at,
                         std::string& problems) {
  for (const auto& key : schema.value("required", Json::array()))
    if (!value.contains(key)) problems += at + ": no " + key.dump() + "\n";
  const Json dependent = schema.value("dependentRequired", Json::object());
  for (const auto& [key, others] : dependent.items())
    for (const auto& other : others)
      if (value.contains(key) && !value.contains(other))
        problems += at + ": " + key + " without " + other.dump() + "\n";
  const Json properties = schema.value("properties", Json::object());
  for (const auto& [key, part] : value.items()) {
    if (properties.contains(key))
      check(part, properties[key], at + "." + key, problems);
    else if (schema.value("additionalProperties", Json()) == false)
      problems += at + ": " + key + " is not foreseen\n";
    else if (schema.contains("additionalProperties"))
      check(part, schema["additionalProperties"], at + "." + key, problems);
  }
}

inline std::string problems(const Json& document, const Json& schema) {
  std::string found;
  check(document, schema, "document", found);
  return found;
}

}  // namespace incognita::testing
