// Serializes the records of an MCAP file.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "incognita/io/bags/mcap_format.hpp"

namespace incognita::mcap {

/// JSON Schema of the messages of a channel.
struct Schema {
  std::uint16_t id = 0;  ///< not 0
  std::string name;
  std::string text;
};

/// A topic with JSON messages of one schema.
struct Channel {
  std::uint16_t id = 0;
  std::uint16_t schema_id = 0;
  std::string topic;
};

struct Message {
  std::uint16_t channel_id = 0;
  std::uint32_t sequence = 0;
  std::uint64_t time_ns = 0;  ///< both log time and publish time
  std::string_view data;
};

/// A group of messages with a time index.
struct Chunk {
  std::uint64_t start_ns = 0, end_ns = 0;  ///< earliest and latest message
  std::string records;                     ///< schemas, channels and messages, uncompressed
  Crc32 records_crc;                       ///< checksum of `records`; update it with every append
  /// Per channel: time of each message and its offset in `records`.
  std::map<std::uint16_t, std::vector<std::pair<std::uint64_t, std::uint64_t>>> messages;

  /// Begins a new chunk in the memory of this one.
  void clear();
};

/// Location of a chunk and its message indexes in the file.
struct ChunkIndex {
  std::uint64_t start_ns = 0, end_ns = 0;
  std::uint64_t offset = 0, length = 0;                    ///< of the chunk record
  std::map<std::uint16_t, std::uint64_t> message_indexes;  ///< channel -> offset in the file
  std::uint64_t message_indexes_length = 0;
  std::uint64_t records_size = 0;
};

/// Content of the summary section.
struct Summary {
  std::vector<Schema> schemas;
  std::vector<Channel> channels;
  std::vector<ChunkIndex> chunks;
  std::map<std::uint16_t, std::uint64_t> message_counts;  ///< by channel
};

std::string opening_part(std::string_view library);

void append_schema(std::string& bytes, const Schema& schema);
void append_channel(std::string& bytes, const Channel& channel);
void append_message(std::string& bytes, const Message& message);

/// Appends the chunk and its message indexes, to be written at `offset` of the file.
ChunkIndex append_chunk(std::string& bytes, const Chunk& chunk, std::uint64_t offset);

/// Everything after a data section that ends at `offset`: data end record, summary, summary offsets, footer
/// and magic.
std::string closing_part(const Summary& summary, std::uint64_t offset, std::uint32_t data_section_crc);

}  // namespace incognita::mcap
