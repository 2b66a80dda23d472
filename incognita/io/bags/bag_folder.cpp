#include "incognita/io/bags/bag_folder.hpp"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <string_view>
#include <system_error>

#include "incognita/io/bags/mcap_format.hpp"
#include "incognita/messages/errors.hpp"

namespace incognita::bags {
namespace {

namespace fs = std::filesystem;

/// Most that is read of metadata.yaml, whose size follows the number of topics and files.
constexpr std::uintmax_t most_metadata_bytes = 16 << 20;
constexpr const char* metadata_name = "metadata.yaml";

std::string ending_of(const fs::path& path) { return path.extension().string(); }

bool is_file(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

std::vector<fs::path> files_ending_with(const fs::path& folder, const std::string& ending) {
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error))
    if (ending_of(it->path()) == ending && is_file(it->path())) files.push_back(it->path());
  std::sort(files.begin(), files.end());
  return files;
}

[[noreturn]] void refuse_sqlite(const fs::path& path) {
  throw InputError(fmt::format(
      "{}: a ROS 2 bag in SQLite is not read; convert it to MCAP: `ros2 bag convert -i BAG -o out.yaml`, with "
      "`output_bags: [{{uri: NEW, storage_id: mcap, all_topics: true}}]` in out.yaml",
      path.string()));
}

[[noreturn]] void refuse_compressed(const fs::path& path, const std::string& mode) {
  throw InputError(
      fmt::format("{}: compression_mode is {}: its {} are compressed one by one, which is not read; {}",
                  path.string(), mode, mode.starts_with("f") || mode.starts_with("F") ? "files" : "messages",
                  mode.starts_with("f") || mode.starts_with("F")
                      ? "decompress them with `zstd -d` and name the folder without metadata.yaml"
                      : "convert the bag with `ros2 bag convert`, without compression_mode in out.yaml"));
}

/// The entry of `metadata.yaml` that holds all others; throws InputError if it is no such file.
YAML::Node bag_information(const fs::path& metadata) {
  std::error_code ignored;
  if (fs::file_size(metadata, ignored) > most_metadata_bytes)
    throw InputError(
        fmt::format("{}: is larger than {} bytes; without it all MCAP files of the folder are read",
                    metadata.string(), most_metadata_bytes));
  try {
    const YAML::Node root = YAML::LoadFile(metadata.string());
    if (root.IsMap() && root["rosbag2_bagfile_information"].IsDefined())
      return root["rosbag2_bagfile_information"];
  } catch (const YAML::Exception& error) {
    throw InputError(fmt::format("{}:{}: is not YAML: {}; without it all MCAP files of the folder are read",
                                 metadata.string(), error.mark.line + 1, error.msg));
  }
  throw InputError(
      fmt::format("{}: has no rosbag2_bagfile_information; without it all MCAP files of the folder are read",
                  metadata.string()));
}

std::string word_in(const YAML::Node& map, const char* key) {
  return map.IsMap() && map[key].IsDefined() && map[key].IsScalar() ? map[key].Scalar() : "";
}

void add_listed(const fs::path& folder, const YAML::Node& list, BagFolder& found) {
  for (const YAML::Node& entry : list) {
    if (!entry.IsScalar()) continue;
    const fs::path file =
        folder / fs::path(entry.Scalar()).filename();  // old recorders wrote the folder, too
    if (is_file(file))
      found.files.push_back(file);
    else
      found.missing.push_back(fmt::format("{}: is listed in {} and is not there: the rest is read",
                                          file.string(), metadata_name));
  }
}

BagFolder files_in_metadata(const fs::path& folder) {
  const fs::path metadata = folder / metadata_name;
  const YAML::Node information = bag_information(metadata);
  if (word_in(information, "storage_identifier") == "sqlite3") refuse_sqlite(folder);
  const std::string mode = word_in(information, "compression_mode");
  if (!mode.empty() && mode != "NONE" && mode != "none") refuse_compressed(metadata, mode);
  BagFolder found;
  if (information.IsMap() && information["relative_file_paths"].IsDefined() &&
      information["relative_file_paths"].IsSequence())
    add_listed(folder, information["relative_file_paths"], found);
  return found;
}

}  // namespace

BagFolder files_of_bag(const fs::path& path) {
  if (ending_of(path) == ".db3") refuse_sqlite(path);
  std::error_code ignored;
  if (!fs::is_directory(path, ignored)) return {{path}, {}};
  BagFolder found;
  if (is_file(path / metadata_name)) found = files_in_metadata(path);
  if (found.files.empty()) found.files = files_ending_with(path, ".mcap");
  if (found.files.empty() && !files_ending_with(path, ".db3").empty()) refuse_sqlite(path);
  if (found.files.empty())
    throw InputError(fmt::format("{}: there is no MCAP file in this folder", path.string()));
  return found;
}

bool is_bag(const fs::path& path) {
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) {
    if (!files_ending_with(path, ".mcap").empty() || !files_ending_with(path, ".db3").empty()) return true;
    std::ifstream metadata(path / metadata_name);
    std::string first;
    return std::getline(metadata, first) && first.starts_with("rosbag2_bagfile_information");
  }
  if (!is_file(path)) return false;
  if (const std::string ending = ending_of(path); ending == ".mcap" || ending == ".bag" || ending == ".db3")
    return true;
  std::array<char, 8> start{};
  std::ifstream(path, std::ios::binary).read(start.data(), start.size());
  const std::string_view bytes(start.data(), start.size());
  return bytes == mcap::magic || bytes == "#ROSBAG ";
}

}  // namespace incognita::bags
