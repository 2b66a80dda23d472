// Loads a scenario from its file and the command line: defaults < file < --set < flags.
#pragma once

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "incognita/io/scenario/scenario.hpp"
#include "incognita/io/scenario/setting.hpp"

namespace incognita {

struct LoadedScenario {
  Scenario scenario;
  std::string name;                            ///< file name without ".toml"
  std::filesystem::path file;                  ///< "embedded:/..." if built in
  std::vector<SettingInForce> settings;        ///< all settings of this scenario, section by section
  std::map<std::string, std::string> sources;  ///< per key: "default", "room.toml:12", "--set", "--seed"
  /// As an earlier run wrote them, which this one repeats; empty: see effective_toml()
  std::string settings_of_repeated_run = {};
  std::vector<std::string> overrides;  ///< values replaced by the command line, one line each, for printing

  /// "default" for a setting that this scenario does not have.
  std::string source_of(const std::string& key) const {
    const auto source = sources.find(key);
    return source == sources.end() ? "default" : source->second;
  }
};

/// A setting with a command-line flag of its own, e.g. {"run.seed", "7", "--seed"}.
struct Flag {
  std::string key;
  std::string value;
  std::string source;
};

/// `path_or_name` is a file or a built-in scenario. `sets` are "key=value". Throws InputError listing all
/// errors, one line each, with file, line, key, value and allowed values.
LoadedScenario load_scenario(const std::string& path_or_name, std::span<const std::string> sets = {},
                             std::span<const Flag> flags = {});

/// The same of the text that effective_toml() wrote for a scenario of that name and file. `source`: of the text, for messages.
/// Without `sets` and `flags` effective_toml() is that text again.
LoadedScenario load_scenario_text(const std::string& text, const std::string& source, const std::string& name,
                                  const std::filesystem::path& file, std::span<const std::string> sets = {},
                                  std::span<const Flag> flags = {});

/// All settings with source, unit and meaning as comments: a scenario file that reproduces the run. For a repeated run
/// the text that it wrote.
std::string effective_toml(const LoadedScenario& loaded);

/// The scenario that repeats a live run from the images that it recorded in the folder `recording`, beside the scenario.
std::string replay_toml(const LoadedScenario& live, const std::string& recording);

}  // namespace incognita
