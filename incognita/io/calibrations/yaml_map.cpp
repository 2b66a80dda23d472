#include "incognita/io/calibrations/yaml_map.hpp"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <cmath>

#include "incognita/io/formats/files.hpp"
#include "incognita/messages/errors.hpp"

namespace incognita {
namespace {

[[noreturn]] void refuse_at(const std::filesystem::path& file, const YAML::Mark& mark,
                            const std::string& why) {
  throw InputError(mark.is_null() ? fmt::format("{}: {}", shown(file), why)
                                  : fmt::format("{}:{}: {}", shown(file), mark.line + 1, why));
}

YAML::Node parsed(const std::filesystem::path& file, std::string text) {
  if (text.starts_with("%YAML:")) text[0] = '#';  // OpenCV's first line is not a valid YAML directive
  try {
    return YAML::Load(text);
  } catch (const YAML::Exception& error) {
    refuse_at(file, error.mark, fmt::format("is not YAML: {}", error.msg));
  }
}

std::string shown_value(const YAML::Node& node) {
  return node.IsScalar() ? node.Scalar().substr(0, 60) : "a list";
}

}  // namespace

YamlMap::YamlMap(const std::filesystem::path& file, std::string text)
    : YamlMap(file, parsed(file, std::move(text))) {}

YamlMap::YamlMap(const std::filesystem::path& file, const YAML::Node& node)
    : file_(file), node_(std::make_shared<const YAML::Node>(node)) {
  if (!node.IsMap()) refuse_at(file, node.Mark(), "must be a list of `key: value`");
}

bool YamlMap::has(const char* key) const { return (*node_)[key].IsDefined(); }

std::string YamlMap::word(const char* key) const {
  return has(key) && (*node_)[key].IsScalar() ? (*node_)[key].Scalar() : "";
}

double YamlMap::number(const char* key) const {
  double number = 0;
  if (!has(key) || !YAML::convert<double>::decode((*node_)[key], number) || !std::isfinite(number))
    refuse(key, has(key) ? fmt::format("must be a number, and is `{}`", shown_value((*node_)[key]))
                         : "is missing");
  return number;
}

std::vector<double> YamlMap::numbers(const char* key) const { return numbers(key, (*node_)[key]); }

std::vector<double> YamlMap::matrix(const char* key) const {
  const YAML::Node node = (*node_)[key];
  return node.IsDefined() && node.IsMap() ? numbers(key, node["data"]) : numbers(key, node);
}

std::vector<std::string> YamlMap::sections() const {
  std::vector<std::string> keys;
  for (const auto& entry : *node_)
    if (entry.first.IsScalar() && entry.second.IsMap()) keys.push_back(entry.first.Scalar());
  return keys;
}

YamlMap YamlMap::section(const std::string& key) const { return {file_, (*node_)[key]}; }

void YamlMap::refuse(const char* key, const std::string& why) const {
  refuse_at(file_, has(key) ? (*node_)[key].Mark() : YAML::Mark::null_mark(), fmt::format("{} {}", key, why));
}

std::vector<double> YamlMap::numbers(const char* key, const YAML::Node& node) const {
  std::vector<double> found;
  if (!node.IsDefined() || !node.IsSequence()) refuse(key, "must be a list of numbers, written [1, 2, 3]");
  for (const YAML::Node& entry : node) {
    double number = 0;
    if (!YAML::convert<double>::decode(entry, number) || !std::isfinite(number))
      refuse_at(file_, entry.Mark(),
                fmt::format("{} must hold numbers only, and has `{}`", key, shown_value(entry)));
    found.push_back(number);
  }
  return found;
}

}  // namespace incognita
