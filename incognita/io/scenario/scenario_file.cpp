#include "incognita/io/scenario/scenario_file.hpp"

#include <fmt/format.h>

#include <vector>

#include "incognita/io/formats/data_folder.hpp"
#include "incognita/io/formats/files.hpp"
#include "incognita/io/formats/toml_value.hpp"
#include "incognita/messages/errors.hpp"

namespace incognita {

std::filesystem::path find_named_file(const std::filesystem::path& scenario, const std::string& name,
                                      SearchedPlaces searched) {
  std::vector<std::filesystem::path> places;
  add_place(scenario.parent_path() / name, places);
  if (searched == SearchedPlaces::working_folder_too) add_place(name, places);
  for (const std::filesystem::path& folder : data_folders(scenario)) add_place(folder / name, places);
  add_place(std::filesystem::path(embedded_root) / name, places);
  std::string looked;
  for (const std::filesystem::path& place : places) {
    if (file_exists(place)) return place;
    looked += (looked.empty() ? "" : ", ") + (is_embedded(place) ? "those built in" : shown(place));
  }
  throw InputError(fmt::format("there is no such file (looked for {})", looked));
}

std::filesystem::path find_named_file(const LoadedScenario& loaded, const std::string& key,
                                      const std::string& name) try {
  return find_named_file(
      loaded.file, name,
      key == "camera.file" ? SearchedPlaces::working_folder_too : SearchedPlaces::of_scenario);
} catch (const InputError& error) {
  throw InputError(
      fmt::format("{}: {} = {}: {}", loaded.source_of(key), key, toml_string(name), error.what()));
}

}  // namespace incognita
