// Locates files named by a scenario.
#pragma once

#include <filesystem>
#include <string>

#include "incognita/io/scenario/load_scenario.hpp"

namespace incognita {

/// The file `name`: beside the scenario, in the working folder, under the data folder, or built in. Throws InputError with
/// the searched locations.
std::filesystem::path find_named_file(const std::filesystem::path& scenario, const std::string& name);

/// The same for the value of the setting `key`.
std::filesystem::path find_named_file(const LoadedScenario& loaded, const std::string& key,
                                      const std::string& name);

}  // namespace incognita
