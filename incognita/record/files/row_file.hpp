// A text file that contains complete rows only.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace incognita {

/// Rows are buffered and written at the latest after one second of run time. If a write fails (disk full,
/// file size limit), the file is truncated after its last complete row and closed, and RecordError names the
/// file and the remedy; what was written stays valid.
class RowFile {
 public:
  RowFile() = default;  ///< not open
  /// Creates or empties the file and writes the header unless it is empty. Throws RecordError.
  RowFile(std::filesystem::path path, std::string_view header);
  ~RowFile();  ///< flushes; failures are silent, call close() to get them
  RowFile(RowFile&& other) noexcept;
  RowFile& operator=(RowFile&& other) noexcept;

  bool is_open() const { return descriptor_ >= 0; }
  const std::filesystem::path& path() const { return path_; }

  /// Adds a row, given without its line break, with run time t_s. Throws RecordError, as flush() and close() do.
  void append(std::string_view row, double t_s);
  /// Passes all rows to the operating system, so that they survive the end of the process.
  void flush();
  void close();

 private:
  void fail(int error);

  std::filesystem::path path_;
  int descriptor_ = -1;
  std::string pending_;        ///< complete rows not written yet
  std::int64_t complete_ = 0;  ///< bytes in the file, complete rows only
  double flushed_t_s_ = 0;     ///< run time of the last flush
  bool has_flushed_ = false;
};

/// Writes a whole file; on failure removes it and throws RecordError.
void write_whole_file(const std::filesystem::path& path, std::string_view text);

/// "cannot write map.csv: No space left on device; free some space or choose another folder with --out"
std::string write_failure(const std::filesystem::path& path, int error);

}  // namespace incognita
