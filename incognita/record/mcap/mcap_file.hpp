// Writes an MCAP file, the container that robotics viewers open, such that it is valid at any time during the run.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "incognita/record/mcap/mcap_records.hpp"

namespace incognita {

/// Messages are collected in chunks of about 1 MB or 2 s, whichever comes first. After each chunk the closing
/// part (summary, indexes, footer) is written, and the next chunk overwrites it. The file can therefore be
/// read sequentially and by index at any time except during a write, and a killed program loses only the last
/// chunk. If the program is killed during a write, the file has no footer: readers that need the index refuse
/// it, sequential readers (`mcap recover`) get all complete chunks.
///
/// If a chunk cannot be written (disk full, file size limit), the previous closing part is restored, which
/// needs no new space, the file is truncated there and closed, RecordError names it and the remedy, and
/// further messages are ignored. If even that write fails (possible on a full copy-on-write file system), the
/// file is truncated after its last complete chunk and has no footer.
class McapFile {
 public:
  /// `library` is the writer named in the header. Throws RecordError if the file cannot be created; nothing
  /// of it is left then.
  McapFile(std::filesystem::path path, std::string_view library);
  ~McapFile();  ///< flushes; failures are silent, call close() to get them
  McapFile(const McapFile&) = delete;
  McapFile& operator=(const McapFile&) = delete;

  bool is_open() const { return descriptor_ >= 0; }

  /// Adds a topic with JSON messages of that schema (JSON Schema). Topics may share a schema by its name.
  std::uint16_t add_channel(std::string_view topic, std::string_view schema_name,
                            std::string_view schema_text);

  void write(std::uint16_t channel, std::uint64_t time_ns, std::string_view json);
  /// Ends the chunk and passes it to the operating system, so that it survives the end of the process.
  void flush();
  void close();

 private:
  bool chunk_is_due(std::uint64_t time_ns) const;
  std::uint16_t schema_id(std::string_view name, std::string_view text);
  void add_to_checksum(std::size_t begin);
  void fail(int error);

  std::filesystem::path path_;
  int descriptor_ = -1;
  std::uint64_t data_end_ = 0;  ///< offset of the end of the data section
  std::string closing_;         ///< content of the file from there on
  mcap::Crc32 data_crc_;        ///< checksum of the file up to data_end_
  mcap::Summary summary_;       ///< chunks in the file; all schemas, channels and counts
  mcap::Chunk chunk_;           ///< current chunk, not written yet
  std::string writing_;         ///< chunk and closing part as they are written; a member to keep its memory
};

}  // namespace incognita
