// The bytes that hold the records of a bag: a file, or a decompressed chunk.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "incognita/io/bags/input_file.hpp"

namespace incognita::bags {

/// Reads a file in blocks, for many small reads at increasing offsets; or the bytes of a chunk.
class RecordBytes {
 public:
  explicit RecordBytes(const InputFile& file) : file_(&file), size_(file.size()) {}
  explicit RecordBytes(std::string chunk) : bytes_(std::move(chunk)), size_(bytes_.size()) {}

  std::uint64_t size() const { return size_; }

  /// Valid until the next call; `offset` and `length` must lie within size().
  std::string_view read(std::uint64_t offset, std::uint64_t length) {
    constexpr std::uint64_t block = 64 * 1024;
    if (file_ && (offset < begin_ || offset + length > begin_ + bytes_.size())) {
      bytes_ = file_->read(offset, std::max(length, std::min(block, size_ - offset)));
      begin_ = offset;
    }
    return std::string_view(bytes_).substr(offset - begin_, length);
  }

 private:
  const InputFile* file_ = nullptr;
  std::string bytes_;
  std::uint64_t begin_ = 0;  ///< of `bytes_` in the file
  std::uint64_t size_ = 0;
};

}  // namespace incognita::bags
