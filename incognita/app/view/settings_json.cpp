#include "incognita/app/view/settings_json.hpp"

#include <nlohmann/json.hpp>

#include "incognita/io/formats/files.hpp"

namespace incognita {
namespace {

struct AsJson {
  nlohmann::json operator()(const TomlArray& items) const {
    nlohmann::json list = nlohmann::json::array();
    for (const TomlValue& item : items) list.push_back(std::visit(*this, item.value));
    return list;
  }
  nlohmann::json operator()(const TomlTable&) const { return nullptr; }  // no setting is a table or a date
  nlohmann::json operator()(const TomlDate&) const { return nullptr; }
  nlohmann::json operator()(const auto& value) const { return value; }
};

nlohmann::json as_json(const SettingInForce& setting) {
  return {{"key", setting.key},
          {"value", std::visit(AsJson{}, value_of_toml(setting.value).value)},
          {"unit", setting.unit},
          {"default", std::visit(AsJson{}, value_of_toml(setting.default_value).value)},
          {"source", setting.source},
          {"allowed", setting.allowed},
          {"options", words_of(setting.allowed)},
          {"help", setting.help}};
}

/// File names may not be UTF-8; a replaced character is better than an exception.
std::string text_of(const nlohmann::json& document, int indent) {
  return document.dump(indent, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace

std::vector<std::string> words_of(const std::string& allowed) {
  std::vector<std::string> words;
  for (std::size_t at = allowed.find('`'); at != std::string::npos; at = allowed.find('`', at + 1)) {
    const std::size_t end = allowed.find('`', at + 1);
    if (end == std::string::npos) break;
    words.push_back(allowed.substr(at + 1, end - at - 1));
    at = end;
  }
  return words;
}

std::string setting_json(const SettingInForce& setting) { return text_of(as_json(setting), -1); }

std::string scenario_json(const LoadedScenario& loaded, const std::vector<std::string>& checked, int indent) {
  nlohmann::json list = nlohmann::json::array();
  for (const SettingInForce& setting : loaded.settings) list.push_back(as_json(setting));
  return text_of({{"scenario", loaded.name},
                  {"file", shown(loaded.file)},
                  {"settings", list},
                  {"overrides", loaded.overrides},
                  {"checked", checked}},
                 indent);
}

}  // namespace incognita
