// A file that is read at any offset.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace incognita {

/// Never reads beyond the size that the file had when it was opened. Several threads may read at once.
class InputFile {
 public:
  /// Throws InputError if it cannot be opened.
  explicit InputFile(std::filesystem::path path);
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::uint64_t size() const { return size_; }
  /// Throws InputError, naming file and byte, if the bytes are not all in the file or cannot be read.
  std::string read(std::uint64_t offset, std::uint64_t length) const;

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
};

}  // namespace incognita
