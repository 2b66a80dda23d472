#include "incognita/io/scenario/setting_reader.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace incognita {
namespace {

/// The values that can decide on other settings: words and answers, and whether a text or a list is empty.
std::vector<std::string> options_of(const Setting& setting) {
  std::vector<std::string> options;
  for (const std::string& word : setting.words) options.push_back(toml_string(word));
  if (!options.empty()) return options;
  if (std::holds_alternative<bool*>(setting.field)) return {"false", "true"};
  if (std::holds_alternative<std::string*>(setting.field)) return {"\"\""};
  if (std::holds_alternative<std::vector<Eigen::Vector2d>*>(setting.field)) return {"[]"};
  return {};
}

bool decides(const Setting& setting) {
  return !setting.words.empty() || std::holds_alternative<bool*>(setting.field);
}

}  // namespace

bool SettingReader::has_given(std::string_view section) const {
  const std::string prefix = std::string(section) + ".";
  const auto at = given_.lower_bound(prefix);
  return at != given_.end() && at->first.starts_with(prefix);
}

void SettingReader::refuse(const std::string& key, const std::string& why) {
  const auto setting =
      std::find_if(settings_.begin(), settings_.end(), [&](const SettingInForce& s) { return s.key == key; });
  if (setting == settings_.end())
    throw std::logic_error("the setting " + key + " is refused before it is read");
  problems_.push_back(fmt::format("{}: {} = {}: {}", setting->source, key, setting->value, why));
}

void SettingReader::read(const Setting& setting) {
  if (!visited_.insert(setting.key).second)
    throw std::logic_error("the setting " + setting.key + " is declared twice");
  std::string source = default_source_;
  if (!follows_.empty()) follow(setting, source);
  const std::string default_value = setting.written();
  if (const auto given = given_.find(setting.key); given != given_.end())
    for (std::size_t i = 0; i < given->second.size(); ++i)
      assign_given(setting, given->second[i], i + 1 < given->second.size(), source);
  settings_.push_back({setting.key, setting.written(), default_value, source, setting.unit, setting.allowed(),
                       setting.help, options_of(setting),
                       std::holds_alternative<std::string*>(setting.field) &&
                           (setting.key.ends_with(".file") || setting.key.ends_with(".target"))});
}

void SettingReader::follow(const Setting& setting, std::string& source) {
  const auto followed = std::find_if(settings_.begin(), settings_.end(),
                                     [&](const SettingInForce& s) { return s.key == follows_; });
  if (followed == settings_.end()) return;
  try {
    assign_text(setting, followed->value);
    source = "as " + follows_;
  } catch (const BadValue& bad) {
    if (given_.contains(setting.key)) return;
    problems_.push_back(fmt::format("{}: {} = {}: as {}, which has the same value unless it is given, it {}",
                                    followed->source, follows_, followed->value, setting.key, bad.why));
  }
}

/// A word that is replaced by a later value need not fit the choices of the scenario, which are those of the later values.
void SettingReader::assign_given(const Setting& setting, const GivenValue& given, bool is_replaced,
                                 std::string& source) {
  const auto* from_file = std::get_if<TomlValue>(&given.value);
  const std::string before = setting.written();
  try {
    if (from_file)
      assign(setting, *from_file);
    else
      assign_text(setting, std::get<std::string>(given.value));
  } catch (const BadValue& bad) {
    if (is_replaced && !setting.words.empty()) return;
    refused_choice_ |= decides(setting);
    if (given.is_renamed) return;
    if (!setting.words.empty())
      refused_words_[setting.key] = {
          from_file ? from_file->written() : toml_string(std::get<std::string>(given.value)),
          problems_.size()};
    problems_.push_back(fmt::format("{}: {} = {}: {}", given.source, setting.key,
                                    from_file ? from_file->written() : std::get<std::string>(given.value),
                                    bad.why));
    return;
  }
  if (!from_file)
    overrides_[given.order] = fmt::format("{} = {} ({}) replaces {} ({})", setting.key, setting.written(),
                                          given.source, before, source);
  source = given.source;
}

}  // namespace incognita
