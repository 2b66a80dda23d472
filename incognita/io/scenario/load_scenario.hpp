// A scenario from its file and the command line: defaults < file < --set < flags.
#pragma once

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "incognita/io/scenario/scenario.hpp"

namespace incognita {

struct LoadedScenario {
  Scenario scenario;
  std::string name;                            ///< the file's name without ".toml"
  std::filesystem::path file;                  ///< "embedded:/..." when it is built in
  std::map<std::string, std::string> sources;  ///< of every key: "default", "room.toml:12", "--set", "--seed"
  std::vector<std::string> overrides;  ///< what the command line replaced, one line each, for printing
};

/// What a flag of its own sets, e.g. {"run.seed", "7", "--seed"}.
struct Flag {
  std::string key;
  std::string value;
  std::string source;
};

/// `path_or_name` is a file, or the name of a built-in scenario. `sets` are "key=value".
/// Throws InputError with every fault found, one line each, naming file, line, key, value and what is
/// allowed.
LoadedScenario load_scenario(const std::string& path_or_name, std::span<const std::string> sets = {},
                             std::span<const Flag> flags = {});

/// Every setting with its source, unit and meaning as a comment: a scenario file that gives the same run
/// again.
std::string effective_toml(const LoadedScenario& loaded);

}  // namespace incognita
