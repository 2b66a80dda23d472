// Files that a scenario names.
#pragma once

#include <filesystem>
#include <string>

#include "incognita/io/scenario/load_scenario.hpp"

namespace incognita {

/// The file that the setting `key` names as `name`: beside the scenario, under the data folder, or built in.
/// Throws InputError with the places looked at.
std::filesystem::path find_named_file(const LoadedScenario& loaded, const std::string& key,
                                      const std::string& name);

}  // namespace incognita
