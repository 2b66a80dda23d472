#include "incognita/io/bags/mcap_index.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "incognita/io/bags/index_builder.hpp"
#include "incognita/io/bags/record_bytes.hpp"
#include "incognita/io/bags/record_cursor.hpp"
#include "incognita/io/formats/reading_progress.hpp"
#include "incognita/messages/errors.hpp"

namespace incognita::mcap {
namespace {

using bags::BagChannel;
using bags::BagIndex;
using bags::CompressedChunk;
using bags::Compression;
using bags::Damage;
using bags::MessagePlace;
using bags::RecordBytes;
using bags::RecordCursor;

struct FoundRecord {
  std::uint64_t offset = 0;
  RecordHead head;
  std::uint64_t content() const { return offset + record_head_bytes; }
  std::uint64_t end() const { return content() + head.length; }
};

/// The record at `offset`, which must end at `end` at the latest.
FoundRecord record_at(RecordBytes& bytes, std::uint64_t offset, std::uint64_t end) {
  if (offset > end || end - offset < record_head_bytes) throw Damage{offset, "a record is cut off"};
  const FoundRecord found{offset, record_head(bytes.read(offset, record_head_bytes))};
  if (found.head.opcode == Opcode{}) throw Damage{offset, "no record begins there"};
  if (found.head.length > end - found.content())
    throw Damage{offset, fmt::format("a record of {} bytes is cut off after {}", found.head.length,
                                     end - found.content())};
  return found;
}

/// The content of a record, which is refused if it is implausibly large.
RecordCursor content_of(RecordBytes& bytes, const FoundRecord& record, std::uint64_t most_bytes) {
  if (record.head.length > most_bytes)
    throw Damage{record.offset,
                 fmt::format("a record of {} bytes is longer than any of its kind", record.head.length)};
  return {bytes.read(record.content(), record.head.length), record.offset};
}

std::uint32_t crc_of(RecordBytes& bytes, std::uint64_t begin, std::uint64_t end) {
  constexpr std::uint64_t block = 64 * 1024;
  Crc32 crc;
  for (; begin < end; begin += std::min(block, end - begin))
    crc.add(bytes.read(begin, std::min(block, end - begin)));
  return crc.value();
}

class McapIndexer {
 public:
  explicit McapIndexer(const InputFile& file) : file_(file), bytes_(file), path_(file.path().string()) {}

  BagIndex take() { return std::move(built_.index); }

  /// By the summary at the end of the file; false if there is none, or a wrong one.
  bool read_summary();
  /// Record by record, to the first damage.
  void read_records();

 private:
  std::optional<std::pair<std::uint64_t, std::uint64_t>> summary_section();
  void add_schema(RecordBytes& bytes, const FoundRecord& record);
  void add_channel(RecordBytes& bytes, const FoundRecord& record);
  void add_message(RecordBytes& bytes, const FoundRecord& record, std::uint32_t chunk);
  CompressedChunk chunk_at(const FoundRecord& record);
  void read_chunk(const CompressedChunk& chunk);
  void read_chunk_records(RecordBytes& bytes, std::uint64_t begin, std::uint64_t end, std::uint32_t chunk);
  void add_indexed_chunk(const FoundRecord& chunk_index, std::uint64_t& previous_end, std::uint64_t data_end);
  void add_message_index(const FoundRecord& record, const CompressedChunk& chunk, std::uint32_t number);

  const InputFile& file_;
  RecordBytes bytes_;
  std::string path_;
  std::map<std::uint16_t, std::string> schemas_;
  bags::IndexBuilder built_;
};

/// Begin and end of the summary; nothing without an intact footer.
std::optional<std::pair<std::uint64_t, std::uint64_t>> McapIndexer::summary_section() {
  constexpr std::uint64_t footer_bytes = 20;
  const std::uint64_t size = bytes_.size();
  const std::uint64_t closing_bytes = record_head_bytes + footer_bytes + magic.size();
  if (size < 2 * magic.size() + closing_bytes) return std::nullopt;
  const std::uint64_t end = size - closing_bytes;
  const FoundRecord footer = record_at(bytes_, end, size);
  if (footer.head.opcode != Opcode::footer || footer.head.length != footer_bytes) return std::nullopt;
  if (bytes_.read(footer.end(), magic.size()) != magic) return std::nullopt;
  RecordCursor fields = content_of(bytes_, footer, footer_bytes);
  const auto begin = fields.number<std::uint64_t>();
  fields.number<std::uint64_t>();  // summary offsets
  const auto crc = fields.number<std::uint32_t>();
  if (begin < magic.size() || begin > end) return std::nullopt;
  if (crc != 0 && crc_of(bytes_, begin, footer.end() - sizeof crc) != crc) return std::nullopt;
  return std::pair(begin, end);
}

/// The counts of the statistics show messages that no index names, e.g. those outside of chunks.
bool McapIndexer::read_summary() {
  std::optional<std::uint64_t> stated;
  try {
    const auto section = summary_section();
    if (!section) return false;
    const auto [begin, end] = *section;
    std::vector<FoundRecord> chunks;
    for (std::uint64_t at = begin; at < end;) {
      const FoundRecord record = record_at(bytes_, at, end);
      if (record.head.opcode == Opcode::schema) add_schema(bytes_, record);
      if (record.head.opcode == Opcode::channel) add_channel(bytes_, record);
      if (record.head.opcode == Opcode::chunk_index) chunks.push_back(record);
      if (record.head.opcode == Opcode::statistics)
        stated = content_of(bytes_, record, bytes_.size()).number<std::uint64_t>();
      at = record.end();
    }
    std::uint64_t previous_end = magic.size();
    for (const FoundRecord& chunk : chunks) add_indexed_chunk(chunk, previous_end, begin);
  } catch (const Damage&) {
    return false;
  }
  return built_.messages() > 0 && stated.value_or(built_.messages()) == built_.messages();
}

void McapIndexer::read_records() {
  built_.clear();
  std::uint64_t at = magic.size();
  ReportedReading reading(file_.path(), "bytes", bytes_.size());
  try {
    for (; at < bytes_.size(); reading.done(at)) {
      const FoundRecord record = record_at(bytes_, at, bytes_.size());
      if (record.head.opcode == Opcode::data_end || record.head.opcode == Opcode::footer) return;
      if (record.head.opcode == Opcode::schema) add_schema(bytes_, record);
      if (record.head.opcode == Opcode::channel) add_channel(bytes_, record);
      if (record.head.opcode == Opcode::message) add_message(bytes_, record, MessagePlace::in_file);
      if (record.head.opcode == Opcode::chunk) read_chunk(chunk_at(record));
      at = record.end();
    }
  } catch (const Damage& damage) {
    built_.index.damage = fmt::format("{}: at byte {}: {}", path_, damage.offset, damage.what);
  }
}

void McapIndexer::add_schema(RecordBytes& bytes, const FoundRecord& record) {
  constexpr std::uint64_t most_bytes = 16 << 20;
  RecordCursor fields = content_of(bytes, record, most_bytes);
  const auto id = fields.number<std::uint16_t>();
  schemas_[id] = std::string(fields.text());
}

void McapIndexer::add_channel(RecordBytes& bytes, const FoundRecord& record) {
  constexpr std::uint64_t most_bytes = 1 << 20;
  RecordCursor fields = content_of(bytes, record, most_bytes);
  const auto id = fields.number<std::uint16_t>(), schema = fields.number<std::uint16_t>();
  BagChannel channel;
  channel.topic = fields.text();
  channel.encoding = fields.text();
  channel.record = record.offset;
  if (const auto found = schemas_.find(schema); found != schemas_.end()) channel.type = found->second;
  built_.index.channels[id] = std::move(channel);
}

void McapIndexer::add_message(RecordBytes& bytes, const FoundRecord& record, std::uint32_t chunk) {
  if (record.head.length < message_head_bytes)
    throw Damage{record.offset, "a message is shorter than its fields"};
  RecordCursor fields(bytes.read(record.content(), message_head_bytes), record.offset);
  const auto channel = fields.number<std::uint16_t>();
  fields.number<std::uint32_t>();  // sequence
  built_.add_place(channel, {fields.number<std::uint64_t>(), record.offset, chunk}, record.offset);
}

/// Also of a chunk that is not compressed.
CompressedChunk McapIndexer::chunk_at(const FoundRecord& record) {
  constexpr std::uint64_t head_bytes = 40, most_word_bytes = 32;  // head without the word for the compression
  if (record.head.length < head_bytes) throw Damage{record.offset, "a chunk is shorter than its fields"};
  RecordCursor fields(
      bytes_.read(record.content(), std::min(record.head.length, head_bytes + most_word_bytes)),
      record.offset);
  CompressedChunk chunk{.record = record.offset};
  fields.number<std::uint64_t>(), fields.number<std::uint64_t>();  // times
  chunk.size = fields.number<std::uint64_t>();
  chunk.crc = fields.number<std::uint32_t>();
  const std::string word(fields.text());
  const auto compression = bags::compression_of(word);
  if (!compression || compression == Compression::bz2)
    throw InputError(fmt::format(
        "{}: at byte {}: compressed with `{}`, not with lz4 or zstd; decompress it: mcap decompress "
        "FILE -o OTHER",
        path_, record.offset, word));
  chunk.compression = *compression;
  chunk.stored = fields.number<std::uint64_t>();
  if (chunk.stored != record.head.length - head_bytes - word.size())
    throw Damage{record.offset, "a chunk and its records have different lengths"};
  if (chunk.compression == Compression::none) chunk.size = chunk.stored;
  chunk.offset = record.end() - chunk.stored;
  return chunk;
}

void McapIndexer::read_chunk(const CompressedChunk& chunk) {
  const std::uint32_t number = built_.keep(chunk);
  if (chunk.compression == Compression::none) {
    const std::uint64_t end = chunk.offset + chunk.stored;
    if (chunk.crc != 0 && crc_of(bytes_, chunk.offset, end) != chunk.crc)
      throw Damage{chunk.offset, "the checksum of a chunk is wrong"};
    return read_chunk_records(bytes_, chunk.offset, end, number);
  }
  bags::read_compressed_records(
      file_, chunk, [&](RecordBytes& records) { read_chunk_records(records, 0, records.size(), number); });
}

void McapIndexer::read_chunk_records(RecordBytes& bytes, std::uint64_t begin, std::uint64_t end,
                                     std::uint32_t chunk) {
  for (std::uint64_t at = begin; at < end;) {
    const FoundRecord record = record_at(bytes, at, end);
    if (record.head.opcode == Opcode::schema) add_schema(bytes, record);
    if (record.head.opcode == Opcode::channel) add_channel(bytes, record);
    if (record.head.opcode == Opcode::message) add_message(bytes, record, chunk);
    at = record.end();
  }
}

/// Chunks that overlap are refused: else a small file could name the same messages many times.
void McapIndexer::add_indexed_chunk(const FoundRecord& chunk_index, std::uint64_t& previous_end,
                                    std::uint64_t data_end) {
  constexpr std::uint64_t times_bytes = 16, places_bytes = 16;
  if (chunk_index.head.length < times_bytes + places_bytes)
    throw Damage{chunk_index.offset, "an index is shorter than its fields"};
  RecordCursor fields(bytes_.read(chunk_index.content() + times_bytes, places_bytes), chunk_index.offset);
  const auto offset = fields.number<std::uint64_t>(), length = fields.number<std::uint64_t>();
  if (offset < previous_end || offset > data_end || length > data_end - offset)
    throw Damage{chunk_index.offset, "a chunk is not where the index has it"};
  const FoundRecord record = record_at(bytes_, offset, offset + length);
  if (record.head.opcode != Opcode::chunk || record.end() != offset + length)
    throw Damage{chunk_index.offset, "a chunk is not where the index has it"};
  const CompressedChunk chunk = chunk_at(record);
  const std::uint32_t number = built_.keep(chunk);
  std::uint64_t at = record.end();
  while (at < data_end) {
    const FoundRecord next = record_at(bytes_, at, data_end);
    if (next.head.opcode != Opcode::message_index) break;
    add_message_index(next, chunk, number);
    at = next.end();
  }
  if (at == record.end() && chunk.size > 0) throw Damage{offset, "a chunk has no index"};
  previous_end = at;
}

void McapIndexer::add_message_index(const FoundRecord& record, const CompressedChunk& chunk,
                                    std::uint32_t number) {
  RecordCursor fields = content_of(bytes_, record, bytes_.size());
  const auto channel = fields.number<std::uint16_t>();
  fields.number<std::uint32_t>();  // length of the list, to the end of the record
  const bool in_file = number == MessagePlace::in_file;
  while (!fields.done()) {
    const auto time_ns = fields.number<std::uint64_t>(), offset = fields.number<std::uint64_t>();
    if (offset >= chunk.size) throw Damage{record.offset, "a message is not in its chunk"};
    built_.add_place(channel, {time_ns, in_file ? chunk.offset + offset : offset, number}, record.offset);
  }
}

}  // namespace

bool is_mcap(const InputFile& file) {
  return file.size() >= magic.size() && file.read(0, magic.size()) == magic;
}

BagIndex index_messages(const InputFile& file) {
  if (!is_mcap(file)) throw InputError(file.path().string() + ": at byte 0: not an MCAP file");
  McapIndexer indexer(file);
  if (!indexer.read_summary()) indexer.read_records();
  return indexer.take();
}

}  // namespace incognita::mcap
