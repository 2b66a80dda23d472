#include "incognita/io/bags/bag_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "incognita/io/bags/chunk_bytes.hpp"
#include "incognita/io/bags/mcap_index.hpp"
#include "incognita/io/bags/record_cursor.hpp"
#include "incognita/io/bags/ros1_index.hpp"
#include "incognita/messages/errors.hpp"

namespace incognita::bags {
namespace {

/// Where the content of the MCAP message at `offset` lies.
ros1::DataPlace mcap_data(RecordBytes& bytes, std::uint64_t offset) {
  using namespace mcap;
  const std::uint64_t size = bytes.size();
  if (offset > size || size - offset < record_head_bytes) throw Damage{offset, "no complete message"};
  const RecordHead head = record_head(bytes.read(offset, record_head_bytes));
  const std::uint64_t content = offset + record_head_bytes;
  if (head.opcode != Opcode::message || head.length < message_head_bytes || head.length > size - content)
    throw Damage{offset, "no complete message"};
  return {content + message_head_bytes, head.length - message_head_bytes};
}

}  // namespace

BagFile::BagFile(const std::filesystem::path& path)
    : file_(path), is_mcap_(mcap::is_mcap(file_)), bytes_(file_) {
  const std::string name = path.string();
  if (!is_mcap_ && !ros1::is_ros1_bag(file_))
    throw InputError(name + ": at byte 0: neither an MCAP file nor a ROS 1 bag");
  index_ = is_mcap_ ? mcap::index_messages(file_) : ros1::index_messages(file_);
  if (!index_.messages.empty()) return;
  throw InputError(fmt::format("{}: no message before it; if the bag was cut off, {} may find more",
                               index_.damage.empty()
                                   ? fmt::format("{}: at byte {}: the file ends", name, file_.size())
                                   : index_.damage,
                               is_mcap_ ? "`mcap recover FILE -o OTHER`" : "`rosbag reindex FILE`"));
}

std::string BagFile::where(const MessagePlace& place) const {
  if (place.chunk == MessagePlace::in_file)
    return fmt::format("{}: at byte {}", path().string(), place.offset);
  return fmt::format("{}: in the chunk at byte {}, at byte {} after decompression", path().string(),
                     index_.chunks.at(place.chunk).record, place.offset);
}

std::string BagFile::message(const MessagePlace& place, std::uint64_t most) const {
  const std::lock_guard lock(mutex_);
  try {
    return content(place.chunk == MessagePlace::in_file ? bytes_ : chunk(place.chunk), place, most);
  } catch (const Damage& damage) {
    throw InputError(fmt::format("{}: {}", where(place), damage.what));
  }
}

/// Throws Damage; a chunk that cannot be decompressed is not tried again for its next message.
RecordBytes& BagFile::chunk(std::uint32_t number) const {
  const CompressedChunk& stored = index_.chunks.at(number);
  if (kept_chunk_ != number) {
    kept_chunk_ = number;
    kept_.reset();
    try {
      kept_ = std::make_unique<RecordBytes>(read_chunk(file_, stored));
    } catch (const std::runtime_error& error) {
      why_not_ = error.what();
    }
  }
  if (!kept_) throw Damage{stored.record, fmt::format("the chunk cannot be decompressed: {}", why_not_)};
  return *kept_;
}

std::string BagFile::content(RecordBytes& bytes, const MessagePlace& place, std::uint64_t most) const {
  const ros1::DataPlace data =
      is_mcap_ ? mcap_data(bytes, place.offset) : ros1::message_data(bytes, place.offset, bytes.size());
  return std::string(bytes.read(data.offset, std::min(data.length, most)));
}

}  // namespace incognita::bags
