// The files of a bag: https://github.com/ros2/rosbag2, rosbag2_storage, metadata.yaml.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace incognita::bags {

struct BagFolder {
  std::vector<std::filesystem::path> files;  ///< at least one
  std::vector<std::string> missing;  ///< a sentence for each that metadata.yaml lists and that is not there
};

/// `path` itself if it is a file; of the folder of a ROS 2 bag the files that its metadata.yaml lists, without one (a killed
/// recorder) all its MCAP files. Throws InputError with the remedy for SQLite files, compressed files and compressed messages,
/// and if there is no file.
BagFolder files_of_bag(const std::filesystem::path& path);

/// Whether it is a file that ends or begins as a bag, or a folder with metadata.yaml of a ROS 2 bag, MCAP or SQLite files.
bool is_bag(const std::filesystem::path& path);

}  // namespace incognita::bags
