// Where the messages of a bag are: the result of reading an MCAP file or a ROS 1 bag without the content of its messages.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "incognita/io/bags/compression.hpp"

namespace incognita::bags {

struct MessagePlace {
  static constexpr std::uint32_t in_file = 0xFFFFFFFF;

  std::uint64_t time_ns = 0;      ///< when the message was recorded
  std::uint64_t offset = 0;       ///< of its record, bytes, in the file or in the decompressed chunk
  std::uint32_t chunk = in_file;  ///< number of the compressed chunk that holds it
};

/// Chunks that are not compressed need no entry: their messages are found in the file.
struct CompressedChunk {
  std::uint64_t record = 0;  ///< offset of its record in the file, bytes
  std::uint64_t offset = 0;  ///< of the compressed bytes in the file
  std::uint64_t stored = 0;  ///< bytes in the file
  std::uint64_t size = 0;    ///< bytes after decompression
  std::uint32_t crc = 0;     ///< CRC-32 of the decompressed bytes; 0: unknown
  Compression compression = Compression::none;
};

struct BagChannel {
  std::string topic;
  std::string type;          ///< of the messages, as the file names it: `sensor_msgs/msg/Image`
  std::string encoding;      ///< of the messages: `cdr`, `ros1`, `json`, ...
  std::uint64_t record = 0;  ///< offset of its record in the file, bytes
};

struct BagIndex {
  std::map<std::uint32_t, BagChannel> channels;
  std::map<std::uint32_t, std::vector<MessagePlace>> messages;  ///< by channel, each of `channels`
  std::vector<CompressedChunk> chunks;
  /// File, byte and what is wrong there, after the messages found; empty for a whole file.
  std::string damage;
};

/// A file with more messages is not read: a small file of compressed chunks could claim any number.
constexpr std::uint64_t most_messages = 50'000'000;

}  // namespace incognita::bags
