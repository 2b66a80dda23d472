// A saved run in one file: sections of bytes, each with its checksum. docs/saved-maps.md describes the format.
//
// The first 60 bytes are the same in every format: the mark "incognita state\n", the number of the format (4), the version of
// the program that wrote it (32, padded with zeros), the number of sections (4), CRC-32 of these 56. An entry of 32 bytes per
// section follows: name (16, padded with zeros), length (8), CRC-32 of the content (4), and of this entry (4); then the contents,
// in that order, up to the end of the file. All numbers are little-endian.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace incognita {

inline constexpr std::uint32_t state_format = 1;
/// Of the file in a run directory.
inline constexpr const char* state_file_name = "run.state";

struct StateSection {
  std::string name;  ///< at most 16 bytes
  std::string bytes;
  std::uint64_t offset = 0;  ///< in the file it was read from
};

struct StateFile {
  std::filesystem::path path;
  std::string program_version;  ///< that wrote it
  std::vector<StateSection> sections;

  bool has(std::string_view section) const;
  /// Throws InputError, naming the file, if there is no such section.
  const StateSection& section(std::string_view name) const;
};

/// The content of a file.
std::string state_file_bytes(std::string_view program_version, const std::vector<StateSection>& sections);

/// Checks all sizes and checksums before it returns anything. Throws InputError that names file, byte or section, and the remedy.
StateFile read_state_file(const std::filesystem::path& path);

}  // namespace incognita
