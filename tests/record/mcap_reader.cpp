#include "mcap_reader.hpp"

#include <algorithm>
#include <set>
#include <stdexcept>
#include <string_view>

namespace incognita::testing {
namespace {

constexpr std::string_view magic{"\x89MCAP0\r\n"};
constexpr int header = 1, footer = 2, schema = 3, channel = 4, message = 5, chunk = 6, message_index = 7,
              chunk_index = 8, statistics = 11, summary_offset = 14, data_end = 15;

void demand(bool holds, const std::string& what) {
  if (!holds) throw std::runtime_error(what);
}

std::uint32_t crc32(std::string_view bytes) {  // bit by bit, as in the definition
  std::uint32_t crc = 0xFFFFFFFF;
  for (const char c : bytes) {
    crc ^= static_cast<unsigned char>(c);
    for (int i = 0; i < 8; ++i) crc = crc & 1 ? crc >> 1 ^ 0xEDB88320 : crc >> 1;
  }
  return ~crc;
}

class Cursor {
 public:
  explicit Cursor(std::string_view bytes) : bytes_(bytes) {}
  bool done() const { return at_ == bytes_.size(); }
  std::uint64_t at() const { return at_; }
  std::uint64_t left() const { return bytes_.size() - at_; }
  std::string_view take(std::uint64_t n) {
    demand(n <= left(), "something is longer than where it is");
    const auto taken = bytes_.substr(at_, n);
    at_ += n;
    return taken;
  }
  std::uint64_t number(int size) {
    std::uint64_t value = 0;
    const auto bytes = take(static_cast<std::uint64_t>(size));
    for (int i = size - 1; i >= 0; --i)
      value = value << 8 | static_cast<unsigned char>(bytes[static_cast<std::size_t>(i)]);
    return value;
  }
  std::uint16_t u16() { return static_cast<std::uint16_t>(number(2)); }
  std::uint32_t u32() { return static_cast<std::uint32_t>(number(4)); }
  std::uint64_t u64() { return number(8); }
  std::string text() { return std::string(take(u32())); }
  std::string rest() { return std::string(take(left())); }

 private:
  std::string_view bytes_;
  std::uint64_t at_ = 0;
};

struct Record {
  int opcode = 0;
  std::uint64_t offset = 0, length = 0;  ///< within the traversed bytes; with opcode and length
  std::string_view content;
};

Record next_record(Cursor& cursor) {
  Record record;
  record.offset = cursor.at();
  record.opcode = static_cast<int>(cursor.number(1));
  record.content = cursor.take(cursor.u64());
  record.length = cursor.at() - record.offset;
  return record;
}

std::map<std::uint16_t, std::uint64_t> map_of(Cursor& cursor) {
  Cursor entries(cursor.take(cursor.u32()));
  std::map<std::uint16_t, std::uint64_t> map;
  while (!entries.done()) {
    const std::uint16_t key = entries.u16();
    demand(map.emplace(key, entries.u64()).second, "a key is there twice");
  }
  return map;
}

struct FoundChunk {
  Record record;
  std::uint64_t start_ns = 0, end_ns = 0;
  std::string_view records;
  std::map<std::uint16_t, Record> message_indexes;
};

/// Parses a file and collects its contents; `McapContents` is the part for users.
class Reader {
 public:
  McapContents contents;

  void read_data_record(const Record& record) {
    switch (record.opcode) {
      case schema:
        read_schema(record);
        break;
      case channel:
        read_channel(record);
        break;
      case chunk:
        read_chunk(record);
        break;
      case message_index:
        read_message_index(record);
        break;
      default:
        demand(false, "opcode " + std::to_string(record.opcode) + " in the data section");
    }
  }

  void check_summary(std::string_view section, std::uint64_t at, std::uint64_t offsets_at);
  void check_every_message_is_indexed() const {
    for (const FoundChunk& found : chunks_) {
      std::set<std::uint64_t> indexed;
      for (const auto& [id, index] : found.message_indexes) check_message_index(found, id, index, indexed);
      std::size_t messages = 0;
      for (Cursor cursor(found.records); !cursor.done();) messages += next_record(cursor).opcode == message;
      demand(messages == indexed.size(), "a message has no index");
    }
  }

 private:
  void read_schema(const Record& record) {
    Cursor cursor(record.content);
    const std::uint16_t id = cursor.u16();
    const std::string name = cursor.text();
    demand(id != 0 && cursor.text() == "jsonschema", "a schema has no id or another encoding");
    contents.schemas[name] = cursor.text();
    demand(cursor.done(), "a schema is too long");
    demand(schemas_.emplace(id, std::string(record.content)).second, "a schema is there twice");
    schema_names_[id] = name;
  }

  void read_channel(const Record& record) {
    Cursor cursor(record.content);
    const std::uint16_t id = cursor.u16();
    const std::uint16_t of = cursor.u16();
    demand(schema_names_.contains(of), "a channel comes before its schema");
    topics_[id] = cursor.text();
    demand(cursor.text() == "json" && cursor.u32() == 0 && cursor.done(), "a channel has another encoding");
    demand(channels_.emplace(id, std::string(record.content)).second, "a channel is there twice");
    contents.schema_of_topic[topics_[id]] = schema_names_[of];
  }

  void read_message(const Record& record) {
    Cursor cursor(record.content);
    const std::uint16_t id = cursor.u16();
    demand(topics_.contains(id), "a message comes before its channel");
    McapMessage found;
    found.topic = topics_[id];
    found.sequence = cursor.u32();
    found.log_time_ns = cursor.u64();
    found.publish_time_ns = cursor.u64();
    found.data = cursor.rest();
    demand(found.sequence == counts_[id]++, "a message is out of sequence");
    contents.messages.push_back(std::move(found));
  }

  void read_chunk(const Record& record) {
    Cursor cursor(record.content);
    FoundChunk found{record, cursor.u64(), cursor.u64(), {}, {}};
    const std::uint64_t size = cursor.u64();
    const std::uint32_t crc = cursor.u32();
    demand(cursor.text().empty(), "a chunk is compressed");
    found.records = cursor.take(cursor.u64());
    demand(cursor.done() && found.records.size() == size, "a chunk has another size than it says");
    demand(crc32(found.records) == crc, "a chunk's checksum is wrong");
    const std::size_t first = contents.messages.size();
    for (Cursor records(found.records); !records.done();) {
      const Record inner = next_record(records);
      demand(inner.opcode == schema || inner.opcode == channel || inner.opcode == message,
             "opcode " + std::to_string(inner.opcode) + " in a chunk");
      if (inner.opcode == message)
        read_message(inner);
      else
        read_data_record(inner);
    }
    demand(contents.messages.size() > first, "a chunk without messages");
    std::uint64_t earliest = ~std::uint64_t{0}, latest = 0;
    for (std::size_t i = first; i < contents.messages.size(); ++i) {
      earliest = std::min(earliest, contents.messages[i].log_time_ns);
      latest = std::max(latest, contents.messages[i].log_time_ns);
    }
    demand(found.start_ns == earliest && found.end_ns == latest, "a chunk has other times than it says");
    contents.chunk_sizes.push_back(found.records.size());
    chunks_.push_back(found);
  }

  void read_message_index(const Record& record) {
    demand(!chunks_.empty(), "a message index before any chunk");
    demand(chunks_.back().message_indexes.emplace(Cursor(record.content).u16(), record).second,
           "a channel has two message indexes");
  }

  void check_message_index(const FoundChunk& found, std::uint16_t id, const Record& index,
                           std::set<std::uint64_t>& indexed) const {
    Cursor cursor(index.content.substr(2));
    Cursor entries(cursor.take(cursor.u32()));
    demand(cursor.done(), "a message index is too long");
    while (!entries.done()) {
      const std::uint64_t time = entries.u64(), offset = entries.u64();
      demand(offset < found.records.size(), "an index points beyond its chunk");
      Cursor there(found.records.substr(offset));
      const Record record = next_record(there);
      demand(record.opcode == message, "an index does not point to a message");
      Cursor content(record.content);
      demand(content.u16() == id, "an index points to another channel's message");
      content.u32();
      demand(content.u64() == time, "an index has another time than its message");
      demand(indexed.insert(offset).second, "a message is indexed twice");
    }
  }

  void check_chunk_index(const Record& record, const FoundChunk& found) const {
    Cursor cursor(record.content);
    demand(cursor.u64() == found.start_ns && cursor.u64() == found.end_ns, "a chunk index has other times");
    demand(cursor.u64() == found.record.offset && cursor.u64() == found.record.length,
           "a chunk index does not point to its chunk");
    const auto indexes = map_of(cursor);
    demand(indexes.size() == found.message_indexes.size(), "a chunk index misses message indexes");
    std::uint64_t length = 0;
    for (const auto& [id, index] : found.message_indexes) {
      demand(indexes.contains(id) && indexes.at(id) == index.offset,
             "a message index is not where it is said");
      length += index.length;
    }
    demand(cursor.u64() == length, "message indexes have another length");
    demand(cursor.text().empty(), "a chunk index says compressed");
    demand(cursor.u64() == found.records.size() && cursor.u64() == found.records.size() && cursor.done(),
           "a chunk index has another size");
  }

  void check_statistics(const Record& record) const {
    Cursor cursor(record.content);
    demand(cursor.u64() == contents.messages.size(), "statistics: messages");
    demand(cursor.u16() == schemas_.size() && cursor.u32() == channels_.size(),
           "statistics: schemas, channels");
    demand(cursor.u32() == 0 && cursor.u32() == 0, "statistics: attachments, metadata");
    demand(cursor.u32() == chunks_.size(), "statistics: chunks");
    std::uint64_t earliest = contents.messages.empty() ? 0 : ~std::uint64_t{0}, latest = 0;
    for (const McapMessage& found : contents.messages) {
      earliest = std::min(earliest, found.log_time_ns);
      latest = std::max(latest, found.log_time_ns);
    }
    demand(cursor.u64() == earliest && cursor.u64() == latest, "statistics: times");
    demand(map_of(cursor) == counts_ && cursor.done(), "statistics: messages of each channel");
  }

  std::map<std::uint16_t, std::string> schemas_, channels_;  ///< content by id
  std::map<std::uint16_t, std::string> schema_names_, topics_;
  std::map<std::uint16_t, std::uint64_t> counts_;
  std::vector<FoundChunk> chunks_;
};

/// `at`: offset of the section in the file.
void Reader::check_summary(std::string_view section, std::uint64_t at, std::uint64_t offsets_at) {
  struct Group {
    std::uint64_t start = 0, length = 0;
    bool operator==(const Group&) const = default;
  };
  std::map<int, Group> groups, said;
  std::size_t schemas = 0, channels = 0, chunks = 0;
  int last = 0;
  for (Cursor cursor(section); !cursor.done();) {
    const Record record = next_record(cursor);
    if (record.opcode == summary_offset) {
      demand(at + record.offset >= offsets_at, "a summary offset before their section");
      Cursor content(record.content);
      const int group = static_cast<int>(content.number(1));
      said[group] = {content.u64(), content.u64()};
      continue;
    }
    demand(at + record.offset < offsets_at, "a summary record among the offsets");
    demand(record.opcode == last || !groups.contains(record.opcode), "the summary is not in groups");
    last = record.opcode;
    if (!groups.contains(last)) groups[last] = {at + record.offset, 0};
    groups[last].length += record.length;
    if (record.opcode == schema) {
      ++schemas;
      demand(schemas_.at(Cursor(record.content).u16()) == record.content, "a schema is not as in the data");
    } else if (record.opcode == channel) {
      ++channels;
      demand(channels_.at(Cursor(record.content).u16()) == record.content, "a channel is not as in the data");
    } else if (record.opcode == chunk_index) {
      demand(chunks < chunks_.size(), "more chunk indexes than chunks");
      check_chunk_index(record, chunks_[chunks++]);
    } else {
      demand(record.opcode == statistics, "opcode " + std::to_string(record.opcode) + " in the summary");
      check_statistics(record);
    }
  }
  demand(schemas == schemas_.size() && channels == channels_.size() && chunks == chunks_.size(),
         "the summary misses something");
  demand(groups.contains(statistics), "no statistics");
  demand(groups == said, "the summary offsets are wrong");
}

Record begin(Cursor& cursor, Reader& reader) {
  demand(cursor.take(magic.size()) == magic, "no magic at the start");
  const Record record = next_record(cursor);
  demand(record.opcode == header, "no header");
  Cursor content(record.content);
  demand(content.text().empty(), "a profile");
  reader.contents.library = content.text();
  demand(content.done(), "the header is too long");
  return record;
}

}  // namespace

std::size_t McapContents::count(const std::string& topic) const { return of(topic).size(); }

std::vector<const McapMessage*> McapContents::of(const std::string& topic) const {
  std::vector<const McapMessage*> found;
  for (const McapMessage& each : messages)
    if (each.topic == topic) found.push_back(&each);
  return found;
}

McapContents read_mcap(const std::string& bytes) {
  Reader reader;
  Cursor cursor(bytes);
  begin(cursor, reader);
  Record record = next_record(cursor);
  for (; record.opcode != data_end; record = next_record(cursor)) reader.read_data_record(record);
  const std::string_view all(bytes);
  demand(Cursor(record.content).u32() == crc32(all.substr(0, record.offset)),
         "the data section's checksum is wrong");
  const std::uint64_t summary_at = cursor.at();
  do record = next_record(cursor);
  while (record.opcode != footer);
  demand(cursor.take(magic.size()) == magic && cursor.done(), "no magic at the end");
  Cursor content(record.content);
  const std::uint64_t start = content.u64(), offsets = content.u64();
  demand(start == summary_at, "the footer does not point to the summary");
  demand(content.u32() == crc32(all.substr(start, record.offset + 9 + 16 - start)) && content.done(),
         "the summary's checksum is wrong");
  reader.check_summary(all.substr(start, record.offset - start), start, offsets);
  reader.check_every_message_is_indexed();
  return reader.contents;
}

McapContents read_open_mcap(const std::string& bytes) {
  Reader reader;
  Cursor cursor(bytes);
  begin(cursor, reader);
  while (cursor.left() >= 9) {
    Cursor ahead(std::string_view(bytes).substr(cursor.at()));
    ahead.number(1);
    if (ahead.u64() > ahead.left()) break;
    const Record record = next_record(cursor);
    if (record.opcode == data_end) break;
    reader.read_data_record(record);
  }
  return reader.contents;
}

}  // namespace incognita::testing
