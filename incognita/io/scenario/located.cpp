#include "incognita/io/scenario/located.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "incognita/io/formats/files.hpp"

namespace incognita {
namespace {

/// The settings with these keys that the scenario has, first those of the command line, then those of the file. The seed
/// is never the first: any other may not fit either.
std::vector<SettingInForce> settings_of(const LoadedScenario& loaded, const std::vector<std::string>& keys) {
  std::vector<SettingInForce> settings;
  for (const std::string& key : keys) {
    const auto has_key = [&](const SettingInForce& s) { return s.key == key; };
    const auto setting = std::find_if(loaded.settings.begin(), loaded.settings.end(), has_key);
    if (setting != loaded.settings.end() && std::none_of(settings.begin(), settings.end(), has_key))
      settings.push_back(*setting);
  }
  std::stable_partition(settings.begin(), settings.end(), [](const auto& s) { return s.is_given(); });
  std::stable_partition(settings.begin(), settings.end(),
                        [](const auto& s) { return s.source.starts_with("--") && s.key != "run.seed"; });
  return settings;
}

}  // namespace

std::string located(const LoadedScenario& loaded, const UnfitSetting& unfit) {
  const std::vector<SettingInForce> settings = settings_of(loaded, unfit.keys);
  if (settings.empty()) return fmt::format("{}: {}", shown(loaded.file), unfit.what());
  const SettingInForce& first = settings.front();
  std::string others;
  for (std::size_t i = 1; i < settings.size(); ++i)
    others += fmt::format("{}{} = {} ({})", i == 1 ? "; here " : ", ", settings[i].key, settings[i].value,
                          settings[i].source);
  return fmt::format("{}: {} = {}: {}{}", first.source, first.key, first.value, unfit.what(), others);
}

std::string located(const LoadedScenario& loaded, const std::string& why) {
  const auto source = loaded.sources.find(why.substr(0, why.find_first_of(" :")));
  return fmt::format("{}: {}", source == loaded.sources.end() ? shown(loaded.file) : source->second, why);
}

}  // namespace incognita
