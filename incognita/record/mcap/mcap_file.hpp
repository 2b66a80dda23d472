// An MCAP file that is whole at every moment: what viewers of the field open, written while the run goes on.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "incognita/record/mcap/mcap_records.hpp"

namespace incognita {

/// Messages are gathered in chunks of about a megabyte, or of two seconds where that is less. With each chunk
/// the closing part (summary, indexes, footer) is written behind it, and the next chunk is written over that.
/// So the file can be read to its end and by its indexes at any time but during a write, and a program that
/// is killed leaves all but the last chunk. One that is killed within the write leaves a file without footer:
/// readers that go by the index refuse it, those that read on from the start (`mcap recover`) get the whole
/// chunks.
///
/// When the file system refuses a chunk (disk full, file size limit), the closing part before it is put back
/// where it was, which needs no new space, the file is cut there and closed, RecordError names it and the
/// remedy, and no more messages are taken. Were even that refused, as a file system that never writes in
/// place may on a full disk, the file is cut after its last whole chunk and has no footer.
class McapFile {
 public:
  /// `library`: what the header says wrote it. Throws RecordError when the file cannot be made; nothing of it
  /// is left then.
  McapFile(std::filesystem::path path, std::string_view library);
  ~McapFile();  ///< writes what is left; failures are silent here, call close() to hear of them
  McapFile(const McapFile&) = delete;
  McapFile& operator=(const McapFile&) = delete;

  bool is_open() const { return descriptor_ >= 0; }

  /// A topic whose messages are JSON of that schema (a JSON Schema); topics may share one by its name.
  std::uint16_t add_channel(std::string_view topic, std::string_view schema_name,
                            std::string_view schema_text);

  /// Adds a message of that time.
  void write(std::uint16_t channel, std::uint64_t time_ns, std::string_view json);
  /// Ends the chunk and hands it to the operating system, so that it outlives the process.
  void flush();
  void close();

 private:
  bool chunk_is_due(std::uint64_t time_ns) const;
  std::uint16_t schema_id(std::string_view name, std::string_view text);
  void add_to_checksum(std::size_t begin);
  void fail(int error);

  std::filesystem::path path_;
  int descriptor_ = -1;
  std::uint64_t data_end_ = 0;  ///< where the data section ends in the file
  std::string closing_;         ///< what the file holds from there on
  mcap::Crc32 data_crc_;        ///< of the file up to there
  mcap::Summary summary_;       ///< of the chunks in the file, and of all schemas, channels and counts
  mcap::Chunk chunk_;           ///< not written yet
};

}  // namespace incognita
