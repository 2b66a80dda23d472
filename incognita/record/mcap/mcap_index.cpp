#include "incognita/record/mcap/mcap_index.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <optional>

#include "incognita/messages/errors.hpp"

namespace incognita::mcap {
namespace {

/// What is wrong with the records at some byte: the end of what can be read.
struct Damage {
  std::uint64_t offset;
  std::string what;
};

/// Little-endian numbers and texts, one after the other.
class Cursor {
 public:
  Cursor(std::string_view bytes, std::uint64_t offset) : bytes_(bytes), offset_(offset) {}

  template <class Unsigned>
  Unsigned number() {
    const std::string_view bytes = take(sizeof(Unsigned));
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < sizeof(Unsigned); ++i)
      value |= static_cast<std::uint64_t>(static_cast<unsigned char>(bytes[i])) << (8 * i);
    return static_cast<Unsigned>(value);
  }
  std::string_view text() { return take(number<std::uint32_t>()); }
  bool done() const { return bytes_.empty(); }

 private:
  std::string_view take(std::size_t n) {
    if (n > bytes_.size()) throw Damage{offset_, "a record is shorter than its fields"};
    const std::string_view taken = bytes_.substr(0, n);
    bytes_.remove_prefix(n);
    return taken;
  }

  std::string_view bytes_;
  std::uint64_t offset_;  ///< of the record in the file
};

struct FoundRecord {
  std::uint64_t offset = 0;
  RecordHead head;
  std::uint64_t content() const { return offset + record_head_bytes; }
  std::uint64_t end() const { return content() + head.length; }
};

/// Reads the file in blocks, for many small reads at increasing offsets.
class Window {
 public:
  explicit Window(const InputFile& file) : file_(file) {}

  std::uint64_t file_size() const { return file_.size(); }

  std::string_view read(std::uint64_t offset, std::uint64_t length) {
    constexpr std::uint64_t block = 64 * 1024;
    if (offset < begin_ || offset + length > begin_ + bytes_.size()) {
      bytes_ = file_.read(offset, std::max(length, std::min(block, file_.size() - offset)));
      begin_ = offset;
    }
    return std::string_view(bytes_).substr(offset - begin_, length);
  }

  /// The record at `offset`, which must end at `end` at the latest.
  FoundRecord record(std::uint64_t offset, std::uint64_t end) {
    if (offset > end || end - offset < record_head_bytes) throw Damage{offset, "a record is cut off"};
    const FoundRecord found{offset, record_head(read(offset, record_head_bytes))};
    if (found.head.opcode == Opcode{}) throw Damage{offset, "no record begins there"};
    if (found.head.length > end - found.content())
      throw Damage{offset, fmt::format("a record of {} bytes is cut off after {}", found.head.length,
                                       end - found.content())};
    return found;
  }

  /// The content of a record, which is refused if it is implausibly large.
  Cursor content(const FoundRecord& record, std::uint64_t most_bytes) {
    if (record.head.length > most_bytes)
      throw Damage{record.offset,
                   fmt::format("a record of {} bytes is longer than any of its kind", record.head.length)};
    return {read(record.content(), record.head.length), record.offset};
  }

  std::uint32_t crc(std::uint64_t begin, std::uint64_t end) {
    constexpr std::uint64_t block = 64 * 1024;
    Crc32 crc;
    for (; begin < end; begin += std::min(block, end - begin))
      crc.add(read(begin, std::min(block, end - begin)));
    return crc.value();
  }

 private:
  const InputFile& file_;
  std::string bytes_;
  std::uint64_t begin_ = 0;
};

/// A chunk: the records that it holds, and what follows it.
struct ChunkPlace {
  std::uint64_t records = 0, end = 0;
  std::uint32_t crc = 0;
};

class Indexer {
 public:
  explicit Indexer(const InputFile& file) : window_(file), path_(file.path().string()) {}

  MessageIndex index;

  /// By the summary at the end of the file; false if there is none, or a wrong one.
  bool read_summary();
  /// Record by record, to the first damage.
  void read_records();

 private:
  std::optional<std::pair<std::uint64_t, std::uint64_t>> summary_section();
  void add_channel(const FoundRecord& record);
  void add_message(const FoundRecord& record);
  ChunkPlace chunk_at(const FoundRecord& record);
  void read_chunk(const ChunkPlace& chunk);
  void add_indexed_chunk(const FoundRecord& chunk_index, std::uint64_t& previous_end, std::uint64_t data_end);
  void add_message_index(const FoundRecord& record, const ChunkPlace& chunk);

  Window window_;
  std::string path_;
};

/// Begin and end of the summary; nothing without an intact footer.
std::optional<std::pair<std::uint64_t, std::uint64_t>> Indexer::summary_section() {
  constexpr std::uint64_t footer_bytes = 20;
  const std::uint64_t size = window_.file_size();
  const std::uint64_t closing_bytes = record_head_bytes + footer_bytes + magic.size();
  if (size < 2 * magic.size() + closing_bytes) return std::nullopt;
  const std::uint64_t end = size - closing_bytes;
  const FoundRecord footer = window_.record(end, size);
  if (footer.head.opcode != Opcode::footer || footer.head.length != footer_bytes) return std::nullopt;
  if (window_.read(footer.end(), magic.size()) != magic) return std::nullopt;
  Cursor fields = window_.content(footer, footer_bytes);
  const auto begin = fields.number<std::uint64_t>();
  fields.number<std::uint64_t>();  // summary offsets
  const auto crc = fields.number<std::uint32_t>();
  if (begin < magic.size() || begin > end) return std::nullopt;
  if (crc != 0 && window_.crc(begin, footer.end() - sizeof crc) != crc) return std::nullopt;
  return std::pair(begin, end);
}

bool Indexer::read_summary() {
  try {
    const auto section = summary_section();
    if (!section) return false;
    const auto [begin, end] = *section;
    std::vector<FoundRecord> chunks;
    for (std::uint64_t at = begin; at < end;) {
      const FoundRecord record = window_.record(at, end);
      if (record.head.opcode == Opcode::channel) add_channel(record);
      if (record.head.opcode == Opcode::chunk_index) chunks.push_back(record);
      at = record.end();
    }
    std::uint64_t previous_end = magic.size();
    for (const FoundRecord& chunk : chunks) add_indexed_chunk(chunk, previous_end, begin);
  } catch (const Damage&) {
    return false;
  }
  return !index.messages.empty();
}

void Indexer::read_records() {
  index = {};
  std::uint64_t at = magic.size();
  try {
    while (at < window_.file_size()) {
      const FoundRecord record = window_.record(at, window_.file_size());
      if (record.head.opcode == Opcode::data_end || record.head.opcode == Opcode::footer) return;
      if (record.head.opcode == Opcode::channel) add_channel(record);
      if (record.head.opcode == Opcode::message) add_message(record);
      if (record.head.opcode == Opcode::chunk) read_chunk(chunk_at(record));
      at = record.end();
    }
  } catch (const Damage& damage) {
    index.damage = fmt::format("{}: at byte {}: {}", path_, damage.offset, damage.what);
  }
}

void Indexer::add_channel(const FoundRecord& record) {
  constexpr std::uint64_t most_bytes = 1 << 20;
  Cursor fields = window_.content(record, most_bytes);
  const auto id = fields.number<std::uint16_t>();
  fields.number<std::uint16_t>();  // schema
  const std::string topic(fields.text());
  if (const std::string_view encoding = fields.text(); encoding != "json")
    throw InputError(
        fmt::format("{}: at byte {}: messages of `{:.40}` are encoded as `{:.40}`, not as JSON; only a "
                    "run.mcap of this program can be read",
                    path_, record.offset, topic, encoding));
  index.topics[id] = topic;
}

void Indexer::add_message(const FoundRecord& record) {
  if (record.head.length < message_head_bytes)
    throw Damage{record.offset, "a message is shorter than its fields"};
  Cursor fields(window_.read(record.content(), message_head_bytes), record.offset);
  const auto channel = fields.number<std::uint16_t>();
  fields.number<std::uint32_t>();  // sequence
  if (!index.topics.contains(channel)) throw Damage{record.offset, "a message is of no known topic"};
  index.messages[channel].push_back({fields.number<std::uint64_t>(), record.offset});
}

ChunkPlace Indexer::chunk_at(const FoundRecord& record) {
  constexpr std::uint64_t head_bytes = 40;  // without the name of the compression
  if (record.head.length < head_bytes) throw Damage{record.offset, "a chunk is shorter than its fields"};
  Cursor fields(window_.read(record.content(), std::min<std::uint64_t>(record.head.length, head_bytes + 32)),
                record.offset);
  ChunkPlace chunk;
  fields.number<std::uint64_t>(), fields.number<std::uint64_t>();  // times
  fields.number<std::uint64_t>();                                  // uncompressed size
  chunk.crc = fields.number<std::uint32_t>();
  if (const std::string_view compression = fields.text(); !compression.empty())
    throw InputError(
        fmt::format("{}: at byte {}: compressed with `{}`; decompress it: mcap decompress FILE "
                    "-o run.mcap",
                    path_, record.offset, compression));
  if (fields.number<std::uint64_t>() != record.head.length - head_bytes)
    throw Damage{record.offset, "a chunk and its records have different lengths"};
  chunk.records = record.content() + head_bytes;
  chunk.end = record.end();
  return chunk;
}

void Indexer::read_chunk(const ChunkPlace& chunk) {
  if (chunk.crc != 0 && window_.crc(chunk.records, chunk.end) != chunk.crc)
    throw Damage{chunk.records, "the checksum of a chunk is wrong"};
  for (std::uint64_t at = chunk.records; at < chunk.end;) {
    const FoundRecord record = window_.record(at, chunk.end);
    if (record.head.opcode == Opcode::channel) add_channel(record);
    if (record.head.opcode == Opcode::message) add_message(record);
    at = record.end();
  }
}

/// Chunks that overlap are refused: else a small file could name the same messages many times.
void Indexer::add_indexed_chunk(const FoundRecord& chunk_index, std::uint64_t& previous_end,
                                std::uint64_t data_end) {
  constexpr std::uint64_t times_bytes = 16, places_bytes = 16;
  if (chunk_index.head.length < times_bytes + places_bytes)
    throw Damage{chunk_index.offset, "an index is shorter than its fields"};
  Cursor fields(window_.read(chunk_index.content() + times_bytes, places_bytes), chunk_index.offset);
  const auto offset = fields.number<std::uint64_t>(), length = fields.number<std::uint64_t>();
  if (offset < previous_end || offset > data_end || length > data_end - offset)
    throw Damage{chunk_index.offset, "a chunk is not where the index has it"};
  const FoundRecord record = window_.record(offset, offset + length);
  if (record.head.opcode != Opcode::chunk || record.end() != offset + length)
    throw Damage{chunk_index.offset, "a chunk is not where the index has it"};
  const ChunkPlace chunk = chunk_at(record);
  std::uint64_t at = chunk.end;
  while (at < data_end) {
    const FoundRecord next = window_.record(at, data_end);
    if (next.head.opcode != Opcode::message_index) break;
    add_message_index(next, chunk);
    at = next.end();
  }
  previous_end = at;
}

void Indexer::add_message_index(const FoundRecord& record, const ChunkPlace& chunk) {
  Cursor fields = window_.content(record, window_.file_size());
  const auto channel = fields.number<std::uint16_t>();
  if (!index.topics.contains(channel)) throw Damage{record.offset, "an index is of no known topic"};
  fields.number<std::uint32_t>();  // length of the list, to the end of the record
  std::vector<MessagePlace>& messages = index.messages[channel];
  while (!fields.done()) {
    const auto time_ns = fields.number<std::uint64_t>(), offset = fields.number<std::uint64_t>();
    if (offset >= chunk.end - chunk.records) throw Damage{record.offset, "a message is not in its chunk"};
    messages.push_back({time_ns, chunk.records + offset});
  }
}

}  // namespace

RecordHead record_head(std::string_view bytes) {
  Cursor fields(bytes, 0);
  const auto opcode = static_cast<Opcode>(fields.number<std::uint8_t>());
  return {opcode, fields.number<std::uint64_t>()};
}

MessageIndex index_messages(const InputFile& file) {
  const std::string path = file.path().string();
  if (file.size() < magic.size() || file.read(0, magic.size()) != magic)
    throw InputError(path + ": at byte 0: not an MCAP file; name the run.mcap of a run directory");
  Indexer indexer(file);
  if (!indexer.read_summary()) indexer.read_records();
  if (!indexer.index.messages.empty()) return std::move(indexer.index);
  const std::string& damage = indexer.index.damage;
  throw InputError(
      (damage.empty() ? path + ": at byte " + std::to_string(file.size()) : damage) +
      ": no message before it; the run ended before its first chunk was written (2 s), or the file is cut");
}

}  // namespace incognita::mcap
