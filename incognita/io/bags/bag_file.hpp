// One file of a bag: an MCAP file or a ROS 1 bag.
#pragma once

#include <cstddef>
#include <filesystem>
#include <limits>
#include <memory>
#include <mutex>
#include <string>

#include "incognita/io/bags/bag_index.hpp"
#include "incognita/io/bags/input_file.hpp"
#include "incognita/io/bags/record_bytes.hpp"

namespace incognita::bags {

/// Holds an index of the messages in memory and reads their content on demand, fastest in the order of the file. Chunks are
/// decompressed one at a time, the last one is kept. Threads take turns.
class BagFile {
 public:
  static constexpr std::uint64_t whole = std::numeric_limits<std::uint64_t>::max();

  /// Throws InputError, naming file, byte and remedy, if the file is of neither format or no message is complete.
  explicit BagFile(const std::filesystem::path& path);

  const std::filesystem::path& path() const { return file_.path(); }
  const BagIndex& index() const { return index_; }

  /// The content of a message, or its first `most` bytes. Throws InputError, naming file and byte, if it is damaged.
  std::string message(const MessagePlace& place, std::uint64_t most = whole) const;

  /// `bag.mcap: at byte 17`, or `bag.mcap: in the chunk at byte 17, at byte 99 after decompression`.
  std::string where(const MessagePlace& place) const;

 private:
  RecordBytes& chunk(std::uint32_t number) const;
  std::string content(RecordBytes& bytes, const MessagePlace& place, std::uint64_t most) const;

  InputFile file_;
  bool is_mcap_ = false;
  BagIndex index_;
  mutable std::mutex mutex_;  ///< of what follows
  mutable RecordBytes bytes_;
  mutable std::uint32_t kept_chunk_ = MessagePlace::in_file;
  mutable std::unique_ptr<RecordBytes> kept_;  ///< null: that chunk cannot be decompressed
  mutable std::string why_not_;                ///< then
};

}  // namespace incognita::bags
