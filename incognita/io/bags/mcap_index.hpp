// Finds the messages of an MCAP file without reading their content.
#pragma once

#include "incognita/io/bags/bag_index.hpp"
#include "incognita/io/bags/input_file.hpp"
#include "incognita/io/bags/mcap_format.hpp"

namespace incognita::mcap {

/// Takes the index of the file. If the file has none (a killed program, a cut file) or a wrong one, its complete records
/// are read from the start to the first damage, which decompresses its chunks. Its memory is at most a small multiple of
/// the size of the file's own index, or of its largest chunk, however damaged. Throws InputError, naming file, byte and
/// remedy, if this is no MCAP file and if it is compressed with something else than lz4 or zstd.
bags::BagIndex index_messages(const InputFile& file);

bool is_mcap(const InputFile& file);

}  // namespace incognita::mcap
