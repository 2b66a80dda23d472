// The records of an MCAP file as bytes: https://mcap.dev/spec, version 0 of the format.
//
// A file is magic, header, data section, summary section, summary offsets, footer, magic. A record is a byte
// that says what it is, the length of its content (8 bytes) and the content. Numbers are little-endian, texts
// and lists have their length in bytes before them (4 bytes, unless said otherwise), times are nanoseconds.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace incognita::mcap {

inline constexpr std::string_view magic{"\x89MCAP0\r\n"};

enum class Opcode : std::uint8_t {
  header = 0x01,
  footer = 0x02,
  schema = 0x03,
  channel = 0x04,
  message = 0x05,
  chunk = 0x06,
  message_index = 0x07,
  chunk_index = 0x08,
  statistics = 0x0B,
  summary_offset = 0x0E,
  data_end = 0x0F,
};

/// CRC-32 as zip and PNG have it, of bytes that come in pieces.
class Crc32 {
 public:
  void add(std::string_view bytes);
  std::uint32_t value() const;

 private:
  std::uint32_t remainder_ = 0xFFFFFFFF;
};

/// What the messages of a channel look like, as JSON Schema.
struct Schema {
  std::uint16_t id = 0;  ///< not 0
  std::string name;
  std::string text;
};

/// Messages of one kind on one topic, encoded as JSON.
struct Channel {
  std::uint16_t id = 0;
  std::uint16_t schema_id = 0;
  std::string topic;
};

struct Message {
  std::uint16_t channel_id = 0;
  std::uint32_t sequence = 0;
  std::uint64_t time_ns = 0;  ///< of logging and of publishing
  std::string_view data;
};

/// Records that are found by time: written together, with an index behind them.
struct Chunk {
  std::uint64_t start_ns = 0, end_ns = 0;  ///< earliest and latest message
  std::string records;                     ///< schemas, channels and messages, not compressed
  Crc32 records_crc;                       ///< of all of them: add to it what is added there
  /// Of each channel: time of each message, and where it is in `records`.
  std::map<std::uint16_t, std::vector<std::pair<std::uint64_t, std::uint64_t>>> messages;
};

/// Where a chunk and what belongs to it are in the file.
struct ChunkIndex {
  std::uint64_t start_ns = 0, end_ns = 0;
  std::uint64_t offset = 0, length = 0;                    ///< of the chunk's record
  std::map<std::uint16_t, std::uint64_t> message_indexes;  ///< channel -> offset in the file
  std::uint64_t message_indexes_length = 0;
  std::uint64_t records_size = 0;
};

/// What a reader wants to know before it reads.
struct Summary {
  std::vector<Schema> schemas;
  std::vector<Channel> channels;
  std::vector<ChunkIndex> chunks;
  std::map<std::uint16_t, std::uint64_t> message_counts;  ///< by channel
};

/// Magic and header.
std::string opening_part(std::string_view library);

void append_schema(std::string& bytes, const Schema& schema);
void append_channel(std::string& bytes, const Channel& channel);
void append_message(std::string& bytes, const Message& message);

/// The chunk and its message indexes, as they are to stand at `offset` of the file.
ChunkIndex append_chunk(std::string& bytes, const Chunk& chunk, std::uint64_t offset);

/// All that comes after the data section when that ends at `offset`: its end record, the summary, where in
/// the summary things are, footer and magic.
std::string closing_part(const Summary& summary, std::uint64_t offset, std::uint32_t data_section_crc);

}  // namespace incognita::mcap
