// What the bags of tests/io/bags/written contain, which writers/scene.md describes. With INCOGNITA_BAGS set, those in that folder.
#pragma once

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "incognita/vision/image.hpp"

namespace incognita::testing {

inline std::filesystem::path written_bags() {
  const char* const fresh = std::getenv("INCOGNITA_BAGS");
  return fresh ? fresh : std::string(INCOGNITA_SOURCE_DIR) + "/tests/io/bags/written";
}

inline const std::vector<std::string>& names_of_bags() {
  static const std::vector<std::string> names{
      "plain.mcap", "lz4.mcap", "zstd.mcap", "unchunked.mcap", "without_index.mcap",
      "plain.bag",  "bz2.bag",  "lz4.bag",   "unindexed.bag"};
  return names;
}

constexpr int bag_instants = 12;
constexpr std::int64_t bag_start_ns = 1'600'000'000'000'000'000, bag_interval_ns = 100'000'000;
constexpr std::int64_t bag_delay_ns = 5'000'000;  ///< of recording

inline std::int64_t bag_time_ns(int k) { return bag_start_ns + k * bag_interval_ns; }

inline Image bag_image(int k) {
  Image image(32, 24);
  for (int v = 0; v < 24; ++v)
    for (int u = 0; u < 32; ++u) image(u, v) = static_cast<std::uint8_t>((3 * u + 7 * v + 5 * k) % 256);
  return image;
}

inline std::filesystem::path written_bag(const std::string& name) { return written_bags() / name; }

}  // namespace incognita::testing
