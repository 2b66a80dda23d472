// Locates files named by a scenario.
#pragma once

#include <filesystem>
#include <string>

#include "incognita/io/scenario/load_scenario.hpp"

namespace incognita {

enum class SearchedPlaces {
  of_scenario,        ///< beside the scenario, under the data folder, built in
  working_folder_too  ///< after those beside the scenario: for a file that a user names for a single run
};

/// The file `name` of a scenario. Throws InputError with the searched locations.
std::filesystem::path find_named_file(const std::filesystem::path& scenario, const std::string& name,
                                      SearchedPlaces searched = SearchedPlaces::of_scenario);

/// The same for the value of the setting `key`.
std::filesystem::path find_named_file(const LoadedScenario& loaded, const std::string& key,
                                      const std::string& name);

}  // namespace incognita
