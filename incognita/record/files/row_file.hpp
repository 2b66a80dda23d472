// A text file that only ever holds complete rows.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace incognita {

/// Rows are gathered and written together, at the latest a second of run time after they came. When the file
/// system refuses (disk full, file size limit), the file is cut back to its last complete row, RecordError
/// names the file and the remedy, and the file takes no more rows: what it holds stays valid.
class RowFile {
 public:
  RowFile() = default;  ///< not open
  /// Creates or empties the file and writes the header, unless that is empty. Throws RecordError.
  RowFile(std::filesystem::path path, std::string_view header);
  ~RowFile();  ///< writes what is left; failures are silent here, call close() to hear of them
  RowFile(RowFile&& other) noexcept;
  RowFile& operator=(RowFile&& other) noexcept;

  bool is_open() const { return descriptor_ >= 0; }
  const std::filesystem::path& path() const { return path_; }

  /// Adds a row (without its line break) of run time t.
  void append(std::string_view row, double t_s);
  /// Hands everything to the operating system, so that it outlives the process.
  void flush();
  void close();

 private:
  void fail(int error);

  std::filesystem::path path_;
  int descriptor_ = -1;
  std::string pending_;        ///< complete rows not written yet
  std::int64_t complete_ = 0;  ///< bytes in the file, all complete rows
  double flushed_t_s_ = 0;     ///< run time of the last flush
  bool has_flushed_ = false;
};

/// Writes a whole file in one go; on failure removes it and throws RecordError.
void write_whole_file(const std::filesystem::path& path, std::string_view text);

/// "cannot write map.csv: No space left on device; free some space or choose another folder with --out"
std::string write_failure(const std::filesystem::path& path, int error);

}  // namespace incognita
