// Finds the messages of an MCAP file without reading their content.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "incognita/record/files/input_file.hpp"
#include "incognita/record/mcap/mcap_records.hpp"

namespace incognita::mcap {

struct MessagePlace {
  std::uint64_t time_ns = 0;
  std::uint64_t offset = 0;  ///< of its record in the file, bytes
};

struct MessageIndex {
  std::map<std::uint16_t, std::string> topics;                  ///< by channel
  std::map<std::uint16_t, std::vector<MessagePlace>> messages;  ///< by channel; each has a topic
  std::string
      damage;  ///< file, byte and what is wrong there, after the messages found; empty for a whole file
};

/// Takes the index of the file. If the file has none (a killed program, a cut file) or a wrong one, its complete records
/// are read from the start to the first damage. Its memory is at most a small multiple of the size of the file's own
/// index, however damaged. Throws InputError, naming file, byte and remedy, if this is no MCAP file, if no message is
/// complete, if it is compressed, and if its messages are not JSON.
MessageIndex index_messages(const InputFile& file);

constexpr std::uint64_t record_head_bytes = 9;    ///< opcode, length of the content
constexpr std::uint64_t message_head_bytes = 22;  ///< channel, sequence, log time, publish time

struct RecordHead {
  Opcode opcode{};
  std::uint64_t length = 0;  ///< of the content
};
/// Of `record_head_bytes` bytes.
RecordHead record_head(std::string_view bytes);

}  // namespace incognita::mcap
