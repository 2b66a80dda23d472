// A small text file that is written over in place, so that it is there and whole whatever happens to the
// program.
#pragma once

#include <filesystem>
#include <string_view>

namespace incognita {

/// The room for the text is taken when the file is made and filled with blanks. Writing a new text needs no
/// space on the disk, so a full one cannot stop it, and a program that is killed leaves the old text or the
/// new one. The file fits JSON: blanks after the document mean nothing.
class PaddedFile {
 public:
  static constexpr std::size_t size_bytes = 16 * 1024;

  PaddedFile() = default;
  /// Throws RecordError when the file cannot be made; nothing of it is left then.
  PaddedFile(const std::filesystem::path& path, std::string_view text);
  ~PaddedFile();
  PaddedFile(const PaddedFile&) = delete;
  PaddedFile& operator=(const PaddedFile&) = delete;

  /// Throws RecordError when it is refused, std::length_error when the text has no room.
  void overwrite(std::string_view text);
  /// The last text: the blanks behind it go. Throws as overwrite().
  void finish(std::string_view text);

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
};

}  // namespace incognita
