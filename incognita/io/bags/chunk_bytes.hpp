// The decompressed bytes of a chunk of a bag.
#pragma once

#include <string>

#include "incognita/io/bags/bag_index.hpp"
#include "incognita/io/bags/input_file.hpp"

namespace incognita::bags {

/// Throws std::runtime_error with the reason if the chunk cannot be decompressed or its checksum is wrong, InputError if
/// the file cannot be read.
std::string read_chunk(const InputFile& file, const CompressedChunk& chunk);

}  // namespace incognita::bags
