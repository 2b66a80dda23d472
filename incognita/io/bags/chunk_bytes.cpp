#include "incognita/io/bags/chunk_bytes.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "incognita/io/bags/mcap_format.hpp"

namespace incognita::bags {

std::string read_chunk(const InputFile& file, const CompressedChunk& chunk) {
  if (chunk.stored > most_chunk_bytes)
    throw std::runtime_error(
        fmt::format("its {} bytes are more than the {} MiB allowed", chunk.stored, most_chunk_bytes >> 20));
  std::string bytes = decompressed(chunk.compression, file.read(chunk.offset, chunk.stored), chunk.size);
  mcap::Crc32 crc;
  crc.add(bytes);
  if (chunk.crc != 0 && crc.value() != chunk.crc) throw std::runtime_error("its checksum is wrong");
  return bytes;
}

}  // namespace incognita::bags
