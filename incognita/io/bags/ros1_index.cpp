#include "incognita/io/bags/ros1_index.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "incognita/io/bags/index_builder.hpp"
#include "incognita/io/bags/ros1_record.hpp"
#include "incognita/io/formats/reading_progress.hpp"
#include "incognita/messages/errors.hpp"

namespace incognita::ros1 {
namespace {

using bags::Damage;
using bags::MessagePlace;
using bags::RecordBytes;

constexpr std::string_view first_bytes = "#ROSBAG V";
constexpr std::string_view first_line = "#ROSBAG V2.0\n";

/// A chunk as the index at the end of the bag names it.
struct ChunkInfo {
  std::uint64_t chunk = 0;     ///< offset of its record
  std::uint64_t messages = 0;  ///< in the chunk
};

class BagIndexer {
 public:
  explicit BagIndexer(const InputFile& file) : file_(file), bytes_(file), path_(file.path().string()) {}

  bags::BagIndex take() { return std::move(built_.index); }

  /// By the index at the end of the bag; false if there is none, or a wrong one.
  bool read_index();
  /// Record by record, to the first damage.
  void read_records();

 private:
  std::vector<ChunkInfo> closing_part();
  void add_connection(RecordBytes& bytes, const Record& record);
  ChunkInfo chunk_info(const Record& record);
  void add_indexed_chunk(const ChunkInfo& info, std::uint64_t& previous_end);
  std::uint64_t add_index_data(const Record& record, const bags::CompressedChunk& chunk,
                               std::uint32_t number);
  bags::CompressedChunk chunk_of(const Record& record);
  void read_chunk(const bags::CompressedChunk& chunk);
  void read_chunk_records(RecordBytes& bytes, std::uint64_t begin, std::uint64_t end, std::uint32_t chunk);
  void add_record(RecordBytes& bytes, const Record& record, std::uint32_t chunk);

  const InputFile& file_;
  RecordBytes bytes_;
  std::string path_;
  bags::IndexBuilder built_;
};

/// Reads the connections; returns the chunks in the order of the file, none without an index.
std::vector<ChunkInfo> BagIndexer::closing_part() {
  const Record head = record_at(bytes_, first_line.size(), bytes_.size());
  if (head.op != Op::bag_header) throw Damage{head.offset, "the header of the bag is missing"};
  if (head.header.has("encryptor") && !head.header.text("encryptor").empty())
    throw InputError(fmt::format("{}: at byte {}: encrypted with `{:.60}`; decrypt it: rosbag decrypt", path_,
                                 head.offset, head.header.text("encryptor")));
  const auto begin = head.header.number<std::uint64_t>("index_pos");
  if (begin < head.end() || begin >= bytes_.size()) return {};
  std::vector<ChunkInfo> chunks;
  for (std::uint64_t at = begin; at < bytes_.size();) {
    const Record record = record_at(bytes_, at, bytes_.size());
    if (record.op == Op::connection) add_connection(bytes_, record);
    if (record.op == Op::chunk_info) chunks.push_back(chunk_info(record));
    at = record.end();
  }
  if (chunks.size() != head.header.number<std::uint32_t>("chunk_count"))
    throw Damage{begin, "chunks are missing in the index"};
  std::sort(chunks.begin(), chunks.end(), [](const auto& a, const auto& b) { return a.chunk < b.chunk; });
  return chunks;
}

bool BagIndexer::read_index() {
  try {
    std::uint64_t previous_end = first_line.size();
    for (const ChunkInfo& chunk : closing_part()) add_indexed_chunk(chunk, previous_end);
  } catch (const Damage&) {
    return false;
  }
  return built_.messages() > 0;
}

void BagIndexer::read_records() {
  built_.clear();
  std::uint64_t at = first_line.size();
  ReportedReading reading(file_.path(), "bytes", bytes_.size());
  try {
    for (; at < bytes_.size(); reading.done(at)) {
      const Record record = record_at(bytes_, at, bytes_.size());
      add_record(bytes_, record, MessagePlace::in_file);
      if (record.op == Op::chunk) read_chunk(chunk_of(record));
      at = record.end();
    }
  } catch (const Damage& damage) {
    built_.index.damage = fmt::format("{}: at byte {}: {}", path_, damage.offset, damage.what);
  }
}

void BagIndexer::add_record(RecordBytes& bytes, const Record& record, std::uint32_t chunk) {
  if (record.op == Op::connection) add_connection(bytes, record);
  if (record.op == Op::message)
    built_.add_place(record.header.number<std::uint32_t>("conn"),
                     {record.header.time("time"), record.offset, chunk}, record.offset);
}

/// The data is a header of its own, that of the connection between the nodes.
void BagIndexer::add_connection(RecordBytes& bytes, const Record& record) {
  constexpr std::uint64_t most_bytes = 16 << 20;
  if (record.length > most_bytes) throw Damage{record.offset, "a connection is longer than any"};
  const HeaderFields connection(bytes.read(record.data, record.length), record.offset);
  built_.index.channels[record.header.number<std::uint32_t>("conn")] = {
      record.header.text("topic"), connection.text("type"), "ros1", record.offset};
}

ChunkInfo BagIndexer::chunk_info(const Record& record) {
  bags::RecordCursor counts(bytes_.read(record.data, record.length), record.offset);
  ChunkInfo info{record.header.number<std::uint64_t>("chunk_pos"), 0};
  while (!counts.done()) {
    counts.number<std::uint32_t>();  // connection
    info.messages += counts.number<std::uint32_t>();
  }
  return info;
}

/// Chunks that overlap are refused: else a small file could name the same messages many times.
void BagIndexer::add_indexed_chunk(const ChunkInfo& info, std::uint64_t& previous_end) {
  if (info.chunk < previous_end) throw Damage{info.chunk, "two chunks of the index overlap"};
  const Record record = record_at(bytes_, info.chunk, bytes_.size());
  if (record.op != Op::chunk) throw Damage{info.chunk, "a chunk is not where the index has it"};
  const bags::CompressedChunk chunk = chunk_of(record);
  const std::uint32_t number = built_.keep(chunk);
  std::uint64_t found = 0;
  previous_end = record.end();
  while (previous_end < bytes_.size()) {
    const Record next = record_at(bytes_, previous_end, bytes_.size());
    if (next.op != Op::index_data) break;
    found += add_index_data(next, chunk, number);
    previous_end = next.end();
  }
  if (found != info.messages) throw Damage{info.chunk, "messages of a chunk are missing in the index"};
}

std::uint64_t BagIndexer::add_index_data(const Record& record, const bags::CompressedChunk& chunk,
                                         std::uint32_t number) {
  const auto connection = record.header.number<std::uint32_t>("conn");
  bags::RecordCursor entries(bytes_.read(record.data, record.length), record.offset);
  std::uint64_t found = 0;
  for (; !entries.done(); ++found) {
    const std::uint64_t time_ns = time_of(entries), offset = entries.number<std::uint32_t>();
    if (offset >= chunk.size) throw Damage{record.offset, "a message is not in its chunk"};
    built_.add_place(connection,
                     {time_ns, number == MessagePlace::in_file ? chunk.offset + offset : offset, number},
                     record.offset);
  }
  return found;
}

/// Also of a chunk that is not compressed.
bags::CompressedChunk BagIndexer::chunk_of(const Record& record) {
  const std::string& word = record.header.text("compression");
  const auto compression = bags::compression_of(word);
  if (!compression || *compression == bags::Compression::zstd)
    throw InputError(fmt::format(
        "{}: at byte {}: compressed with `{:.40}`, not with bz2 or lz4; decompress it: rosbag decompress FILE",
        path_, record.offset, word));
  bags::CompressedChunk chunk{.record = record.offset, .offset = record.data, .stored = record.length};
  chunk.size = record.header.number<std::uint32_t>("size");
  chunk.compression = *compression;
  if (chunk.compression == bags::Compression::none) chunk.size = chunk.stored;
  return chunk;
}

void BagIndexer::read_chunk(const bags::CompressedChunk& chunk) {
  const std::uint32_t number = built_.keep(chunk);
  if (chunk.compression == bags::Compression::none)
    return read_chunk_records(bytes_, chunk.offset, chunk.offset + chunk.stored, number);
  bags::read_compressed_records(
      file_, chunk, [&](RecordBytes& records) { read_chunk_records(records, 0, records.size(), number); });
}

void BagIndexer::read_chunk_records(RecordBytes& bytes, std::uint64_t begin, std::uint64_t end,
                                    std::uint32_t chunk) {
  for (std::uint64_t at = begin; at < end;) {
    const Record record = record_at(bytes, at, end);
    add_record(bytes, record, chunk);
    at = record.end();
  }
}

}  // namespace

bool is_ros1_bag(const InputFile& file) {
  return file.size() >= first_bytes.size() && file.read(0, first_bytes.size()) == first_bytes;
}

bags::BagIndex index_messages(const InputFile& file) {
  const std::string start = file.read(0, std::min<std::uint64_t>(file.size(), first_line.size()));
  if (start != first_line)
    throw InputError(
        fmt::format("{}: at byte 0: not a ROS 1 bag of version 2.0{}", file.path().string(),
                    start.starts_with(first_bytes) ? "; convert it: rosbag fix OLD.bag NEW.bag" : ""));
  BagIndexer indexer(file);
  if (!indexer.read_index()) indexer.read_records();
  return indexer.take();
}

DataPlace message_data(RecordBytes& bytes, std::uint64_t offset, std::uint64_t end) {
  const Record record = record_at(bytes, offset, end);
  if (record.op != Op::message) throw Damage{offset, "no message"};
  return {record.data, record.length};
}

}  // namespace incognita::ros1
