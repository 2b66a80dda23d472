// Reads an MCAP file with JSON messages, such as run.mcap, message by message.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "incognita/io/bags/bag_index.hpp"
#include "incognita/io/bags/input_file.hpp"

namespace incognita {

/// Holds an index of the messages in memory and reads their content on demand. Several threads may read at once, also
/// while the file is still being written: it has then what it had when opened.
class McapReader {
 public:
  /// Throws InputError, naming file, byte and remedy, if this is no MCAP file, if it has no complete message before
  /// its first damage, if it is compressed, and if its messages are not JSON.
  explicit McapReader(const std::filesystem::path& path);

  const std::filesystem::path& path() const { return file_.path(); }

  /// The messages of a topic in their order in the file; none if there is no such topic.
  const std::vector<bags::MessagePlace>& messages(std::string_view topic) const;

  /// The JSON text of a message. Throws InputError if there is no complete message at that place.
  std::string text(const bags::MessagePlace& message) const;

  /// What is wrong with the file after the messages that can be read, with the byte; empty for a whole file.
  const std::string& damage() const { return damage_; }

 private:
  InputFile file_;
  std::map<std::string, std::vector<bags::MessagePlace>, std::less<>> messages_;  ///< by topic
  std::string damage_;
};

}  // namespace incognita
