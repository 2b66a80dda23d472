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
  std::vector<std::filesystem::path> folders = {loaded.file.parent_path()};
  for (const std::filesystem::path& folder : data_folders(loaded.file)) folders.push_back(folder);
  folders.push_back(std::filesystem::path(embedded_root) / "");
  std::string looked;
  for (const std::filesystem::path& folder : folders) {
    if (file_exists(folder / name)) return folder / name;
    looked += (looked.empty() ? "" : ", ") + (is_embedded(folder) ? "those built in" : shown(folder / name));
  }
  throw InputError(fmt::format("{}: {} = {}: there is no such file (looked for {})", loaded.source_of(key),
                               key, toml_string(name), looked));
}

}  // namespace incognita
