// A strict reader of MCAP files, independent of the writer: every length, offset, checksum and count is
// compared with the contents of the file.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace incognita::testing {

struct McapMessage {
  std::string topic;
  std::uint32_t sequence = 0;
  std::uint64_t log_time_ns = 0, publish_time_ns = 0;
  std::string data;
};

struct McapContents {
  std::string library;
  std::map<std::string, std::string> schema_of_topic;  ///< topic -> name of its schema
  std::map<std::string, std::string> schemas;          ///< name -> text
  std::vector<McapMessage> messages;                   ///< in the order of the file
  std::vector<std::size_t> chunk_sizes;                ///< bytes of records

  std::size_t count(const std::string& topic) const;
  std::vector<const McapMessage*> of(const std::string& topic) const;
};

/// Throws std::runtime_error with the first violation.
McapContents read_mcap(const std::string& bytes);

/// Without footer and summary: complete records from the start, up to their end or the end of the file.
McapContents read_open_mcap(const std::string& bytes);

}  // namespace incognita::testing
