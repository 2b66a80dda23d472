#include "incognita/io/bags/index_builder.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "incognita/io/bags/chunk_bytes.hpp"
#include "incognita/io/bags/record_cursor.hpp"

namespace incognita::bags {

void IndexBuilder::clear() {
  index = {};
  messages_ = 0;
}

std::uint32_t IndexBuilder::keep(const CompressedChunk& chunk) {
  if (chunk.compression == Compression::none) return MessagePlace::in_file;
  index.chunks.push_back(chunk);
  return static_cast<std::uint32_t>(index.chunks.size() - 1);
}

void IndexBuilder::add_place(std::uint32_t channel, const MessagePlace& place, std::uint64_t record) {
  if (!index.channels.contains(channel)) throw Damage{record, "a message is of no known topic"};
  if (++messages_ > most_messages) throw Damage{record, "there are more messages than are read"};
  index.messages[channel].push_back(place);
}

void read_compressed_records(const InputFile& file, const CompressedChunk& chunk,
                             const std::function<void(RecordBytes&)>& read) {
  try {
    RecordBytes records(read_chunk(file, chunk));
    read(records);
  } catch (const Damage& damage) {
    throw Damage{chunk.record, fmt::format("in a compressed chunk, at byte {} after decompression: {}",
                                           damage.offset, damage.what)};
  } catch (const std::runtime_error& error) {
    throw Damage{chunk.record, fmt::format("a chunk cannot be decompressed: {}", error.what())};
  }
}

}  // namespace incognita::bags
