// A bag of one or several files as one: its topics, and their messages in the order in which they were recorded.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "incognita/io/bags/bag_file.hpp"

namespace incognita::bags {

struct BagMessage {
  std::uint32_t file = 0;
  MessagePlace place;
};

struct BagTopic {
  std::string name;
  std::string type;                  ///< as in ROS 1, also of a ROS 2 bag: `sensor_msgs/Image`
  std::string encoding;              ///< `cdr`, `ros1`, or another, whose messages are not read
  std::vector<BagMessage> messages;  ///< in the order of recording, at least one
};

class Bag {
 public:
  /// `path`: an MCAP file, a ROS 1 bag, or the folder of a ROS 2 bag with one or several MCAP files. Throws InputError,
  /// naming file, byte and remedy, if nothing of it can be read.
  explicit Bag(const std::filesystem::path& path);

  const std::filesystem::path& path() const { return path_; }
  const std::map<std::string, BagTopic>& topics() const { return topics_; }
  /// What is wrong with the bag after what can be read; empty for a whole one.
  const std::vector<std::string>& damage() const { return damage_; }

  /// The content of a message, or its first `most` bytes. Throws InputError, naming file and byte, if it is damaged.
  std::string content(const BagMessage& message, std::uint64_t most = BagFile::whole) const;
  /// File and byte of a message, for messages to the user.
  std::string where(const BagMessage& message) const;

 private:
  void add(const std::filesystem::path& file);

  std::filesystem::path path_;
  std::vector<std::unique_ptr<BagFile>> files_;
  std::map<std::string, BagTopic> topics_;
  std::vector<std::string> damage_;
};

}  // namespace incognita::bags
