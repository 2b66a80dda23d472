#include "incognita/io/scenario/scenario_file.hpp"

#include <fmt/format.h>

#include <vector>

#include "incognita/io/formats/data_folder.hpp"
#include "incognita/io/formats/files.hpp"
#include "incognita/io/formats/toml_value.hpp"
#include "incognita/messages/errors.hpp"

namespace incognita {

std::filesystem::path find_named_file(const LoadedScenario& loaded, const std::string& key,
                                      const std::string& name) {
  std::vector<std::filesystem::path> places;
  add_place(loaded.file.parent_path() / name, places);
  for (const std::filesystem::path& folder : data_folders(loaded.file)) add_place(folder / name, places);
  add_place(std::filesystem::path(embedded_root) / name, places);
  std::string looked;
  for (const std::filesystem::path& place : places) {
    if (file_exists(place)) return place;
    looked += (looked.empty() ? "" : ", ") + (is_embedded(place) ? "those built in" : shown(place));
  }
  throw InputError(fmt::format("{}: {} = {}: there is no such file (looked for {})", loaded.source_of(key),
                               key, toml_string(name), looked));
}

}  // namespace incognita
