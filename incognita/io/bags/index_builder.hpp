// What the indexers of both kinds of bags share.
#pragma once

#include <cstdint>
#include <functional>

#include "incognita/io/bags/bag_index.hpp"
#include "incognita/io/bags/input_file.hpp"
#include "incognita/io/bags/record_bytes.hpp"

namespace incognita::bags {

class IndexBuilder {
 public:
  BagIndex index;

  std::uint64_t messages() const { return messages_; }
  /// Forgets everything.
  void clear();

  /// The number of a chunk in the index, by which places name it; MessagePlace::in_file if it is not compressed.
  std::uint32_t keep(const CompressedChunk& chunk);

  /// `record`: offset of what names the place. Throws Damage for an unknown channel, and for too many messages.
  void add_place(std::uint32_t channel, const MessagePlace& place, std::uint64_t record);

 private:
  std::uint64_t messages_ = 0;
};

/// Passes the decompressed records of a chunk to `read`. Damage of the chunk and in it is thrown as Damage at the chunk.
void read_compressed_records(const InputFile& file, const CompressedChunk& chunk,
                             const std::function<void(RecordBytes&)>& read);

}  // namespace incognita::bags
