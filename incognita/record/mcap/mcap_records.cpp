#include "incognita/record/mcap/mcap_records.hpp"

#include <algorithm>
#include <concepts>

namespace incognita::mcap {
namespace {

template <std::unsigned_integral Unsigned>
void append(std::string& bytes, Unsigned value) {
  for (std::size_t i = 0; i < sizeof value; ++i)
    bytes.push_back(static_cast<char>(static_cast<std::uint64_t>(value) >> (8 * i)));
}

void append(std::string& bytes, std::string_view text) {
  append(bytes, static_cast<std::uint32_t>(text.size()));
  bytes.append(text);
}

/// Prefixes a list with its size in bytes: reserves the field and fills it in on destruction.
template <class Size>
class LengthBefore {
 public:
  explicit LengthBefore(std::string& bytes) : bytes_(bytes), place_(bytes.size()) { append(bytes, Size{0}); }
  ~LengthBefore() {
    std::string size;
    append(size, static_cast<Size>(bytes_.size() - place_ - sizeof(Size)));
    bytes_.replace(place_, sizeof(Size), size);
  }
  LengthBefore(const LengthBefore&) = delete;
  LengthBefore& operator=(const LengthBefore&) = delete;

 private:
  std::string& bytes_;
  std::size_t place_;
};

using List = LengthBefore<std::uint32_t>;

/// Bytes appended during the lifetime of this object form the record's content. It must be destroyed before
/// the bytes are returned.
class Record {
 public:
  Record(std::string& bytes, Opcode opcode) : length_(begin(bytes, opcode)) {}

 private:
  static std::string& begin(std::string& bytes, Opcode opcode) {
    bytes.push_back(static_cast<char>(opcode));
    return bytes;
  }
  LengthBefore<std::uint64_t> length_;
};

void append_map(std::string& bytes, const std::map<std::uint16_t, std::uint64_t>& map) {
  const List list(bytes);
  for (const auto& [key, value] : map) {
    append(bytes, key);
    append(bytes, value);
  }
}

void append_message_index(std::string& bytes, std::uint16_t channel_id,
                          const std::vector<std::pair<std::uint64_t, std::uint64_t>>& messages) {
  const Record record(bytes, Opcode::message_index);
  append(bytes, channel_id);
  const List list(bytes);
  for (const auto& [time_ns, offset] : messages) {
    append(bytes, time_ns);
    append(bytes, offset);
  }
}

void append_chunk_index(std::string& bytes, const ChunkIndex& index) {
  const Record record(bytes, Opcode::chunk_index);
  append(bytes, index.start_ns);
  append(bytes, index.end_ns);
  append(bytes, index.offset);
  append(bytes, index.length);
  append_map(bytes, index.message_indexes);
  append(bytes, index.message_indexes_length);
  append(bytes, "");                  // compression: none
  append(bytes, index.records_size);  // compressed
  append(bytes, index.records_size);
}

void append_statistics(std::string& bytes, const Summary& summary) {
  std::uint64_t messages = 0, start_ns = 0, end_ns = 0;
  for (const auto& [channel, count] : summary.message_counts) messages += count;
  for (const ChunkIndex& chunk : summary.chunks) {
    start_ns = &chunk == summary.chunks.data() ? chunk.start_ns : std::min(start_ns, chunk.start_ns);
    end_ns = std::max(end_ns, chunk.end_ns);
  }
  const Record record(bytes, Opcode::statistics);
  append(bytes, messages);
  append(bytes, static_cast<std::uint16_t>(summary.schemas.size()));
  append(bytes, static_cast<std::uint32_t>(summary.channels.size()));
  append(bytes, std::uint32_t{0});  // attachments
  append(bytes, std::uint32_t{0});  // metadata
  append(bytes, static_cast<std::uint32_t>(summary.chunks.size()));
  append(bytes, start_ns);
  append(bytes, end_ns);
  append_map(bytes, summary.message_counts);
}

void append_summary_offset(std::string& bytes, Opcode group, std::uint64_t start, std::uint64_t length) {
  if (length == 0) return;
  const Record record(bytes, Opcode::summary_offset);
  bytes.push_back(static_cast<char>(group));
  append(bytes, start);
  append(bytes, length);
}

}  // namespace

std::string opening_part(std::string_view library) {
  std::string bytes(magic);
  {
    const Record record(bytes, Opcode::header);
    append(bytes, "");  // profile: none
    append(bytes, library);
  }
  return bytes;
}

void append_schema(std::string& bytes, const Schema& schema) {
  const Record record(bytes, Opcode::schema);
  append(bytes, schema.id);
  append(bytes, schema.name);
  append(bytes, "jsonschema");
  append(bytes, schema.text);
}

void append_channel(std::string& bytes, const Channel& channel) {
  const Record record(bytes, Opcode::channel);
  append(bytes, channel.id);
  append(bytes, channel.schema_id);
  append(bytes, channel.topic);
  append(bytes, "json");
  append_map(bytes, {});  // metadata: none
}

void append_message(std::string& bytes, const Message& message) {
  const Record record(bytes, Opcode::message);
  append(bytes, message.channel_id);
  append(bytes, message.sequence);
  append(bytes, message.time_ns);
  append(bytes, message.time_ns);
  bytes.append(message.data);
}

void Chunk::clear() {
  start_ns = end_ns = 0;
  records.clear();
  records_crc = {};
  messages.clear();
}

ChunkIndex append_chunk(std::string& bytes, const Chunk& chunk, std::uint64_t offset) {
  const std::size_t begin = bytes.size();
  ChunkIndex index{chunk.start_ns, chunk.end_ns, offset, 0, {}, 0, chunk.records.size()};
  {
    const Record record(bytes, Opcode::chunk);
    append(bytes, chunk.start_ns);
    append(bytes, chunk.end_ns);
    append(bytes, index.records_size);
    append(bytes, chunk.records_crc.value());
    append(bytes, "");  // compression: none
    append(bytes, index.records_size);
    bytes.append(chunk.records);
  }
  index.length = bytes.size() - begin;
  for (const auto& [channel, messages] : chunk.messages) {
    index.message_indexes[channel] = offset + (bytes.size() - begin);
    append_message_index(bytes, channel, messages);
  }
  index.message_indexes_length = bytes.size() - begin - index.length;
  return index;
}

std::string closing_part(const Summary& summary, std::uint64_t offset, std::uint32_t data_section_crc) {
  std::string bytes;
  {
    const Record record(bytes, Opcode::data_end);
    append(bytes, data_section_crc);
  }
  const std::uint64_t begin = bytes.size();
  for (const Schema& schema : summary.schemas) append_schema(bytes, schema);
  const std::uint64_t channels = bytes.size();
  for (const Channel& channel : summary.channels) append_channel(bytes, channel);
  const std::uint64_t chunks = bytes.size();
  for (const ChunkIndex& chunk : summary.chunks) append_chunk_index(bytes, chunk);
  const std::uint64_t statistics = bytes.size();
  append_statistics(bytes, summary);
  const std::uint64_t offsets = bytes.size();
  append_summary_offset(bytes, Opcode::schema, offset + begin, channels - begin);
  append_summary_offset(bytes, Opcode::channel, offset + channels, chunks - channels);
  append_summary_offset(bytes, Opcode::chunk_index, offset + chunks, statistics - chunks);
  append_summary_offset(bytes, Opcode::statistics, offset + statistics, offsets - statistics);
  // The footer has a fixed length; its checksum covers the summary and the footer up to the checksum itself.
  constexpr std::uint64_t footer_length = 20;
  bytes.push_back(static_cast<char>(Opcode::footer));
  append(bytes, footer_length);
  append(bytes, offset + begin);
  append(bytes, offset + offsets);
  Crc32 crc;
  crc.add(std::string_view(bytes).substr(begin));
  append(bytes, crc.value());
  bytes.append(magic);
  return bytes;
}

}  // namespace incognita::mcap
