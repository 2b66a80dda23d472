// Finds the messages of a ROS 1 bag without reading their content: http://wiki.ros.org/Bags/Format/2.0.
//
// A bag consists of a line with the version, then records: a header (its length in 4 bytes, then fields `name=value`,
// each after its length in 4 bytes) and data (after its length in 4 bytes). The field `op` says what a record is.
// Numbers are little-endian, times are seconds and nanoseconds in 4 bytes each.
#pragma once

#include "incognita/io/bags/bag_index.hpp"
#include "incognita/io/bags/input_file.hpp"
#include "incognita/io/bags/record_bytes.hpp"

namespace incognita::ros1 {

/// Takes the index of the bag. If the bag has none (a killed recorder, a cut file) or a wrong one, its complete records
/// are read from the start to the first damage, which decompresses its chunks. Memory as for an MCAP file. Throws
/// InputError, naming file, byte and remedy, if this is no bag of version 2.0, if it is encrypted, and if it is
/// compressed with something else than bz2 or lz4.
bags::BagIndex index_messages(const InputFile& file);

/// Whether it begins as a ROS 1 bag of any version.
bool is_ros1_bag(const InputFile& file);

/// Where the data of a record lies. Throws bags::Damage if no complete record is at `offset`.
struct DataPlace {
  std::uint64_t offset = 0, length = 0;
};
DataPlace message_data(bags::RecordBytes& bytes, std::uint64_t offset, std::uint64_t end);

}  // namespace incognita::ros1
