// The settings of a scenario as JSON: `incognita config --json`, and the page.
#pragma once

#include <string>
#include <vector>

#include "incognita/io/scenario/load_scenario.hpp"

namespace incognita {

/// {"key", "value", "unit", "default", "source", "allowed", "help", "options"}; `options`: the values to choose from, where
/// there are only some.
std::string setting_json(const SettingInForce& setting);

/// {"scenario", "file", "settings", "overrides", "checked"}. `indent`: of each level; -1: all on one line.
std::string scenario_json(const LoadedScenario& loaded, const std::vector<std::string>& checked = {},
                          int indent = -1);

/// The words of a restriction, in their order: "`room` or `recording`".
std::vector<std::string> words_of(const std::string& allowed);

}  // namespace incognita
