// Locates files named by a scenario.
#pragma once

#include <filesystem>
#include <string>

#include "incognita/io/scenario/load_scenario.hpp"

namespace incognita {

/// The file `name` given by the setting `key`: beside the scenario, under the data folder, or built in.
/// Throws InputError with the searched locations.
std::filesystem::path find_named_file(const LoadedScenario& loaded, const std::string& key,
                                      const std::string& name);

}  // namespace incognita
