// A small text file of fixed size that is overwritten in place, so that it is complete at any time.
#pragma once

#include <filesystem>
#include <string_view>

namespace incognita {

/// The file is created at full size and padded with blanks. Overwriting needs no disk space, so it succeeds
/// on a full disk, and a killed program leaves either the old text or the new one. Suits JSON, which ignores
/// trailing blanks.
class PaddedFile {
 public:
  static constexpr std::size_t size_bytes = 16 * 1024;

  PaddedFile() = default;
  /// Throws RecordError if the file cannot be created; nothing of it is left then.
  PaddedFile(const std::filesystem::path& path, std::string_view text);
  ~PaddedFile();
  PaddedFile(const PaddedFile&) = delete;
  PaddedFile& operator=(const PaddedFile&) = delete;

  /// Throws RecordError if the write fails, std::length_error if the text exceeds the file size.
  void overwrite(std::string_view text);
  /// Writes the final text and truncates the padding. Throws as overwrite().
  void finish(std::string_view text);

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
};

}  // namespace incognita
