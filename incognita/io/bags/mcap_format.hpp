// What readers and writers of MCAP files share: https://mcap.dev/spec, version 0 of the format.
//
// A file consists of magic, header, data section, summary section, summary offsets, footer, magic. A record
// is an opcode byte, the length of its content (8 bytes) and the content. Numbers are little-endian, strings
// and lists are preceded by their length in bytes (4 bytes unless stated otherwise), times are in nanoseconds.
#pragma once

#include <cstdint>
#include <string_view>

namespace incognita::mcap {

inline constexpr std::string_view magic{"\x89MCAP0\r\n"};

enum class Opcode : std::uint8_t {
  header = 0x01,
  footer = 0x02,
  schema = 0x03,
  channel = 0x04,
  message = 0x05,
  chunk = 0x06,
  message_index = 0x07,
  chunk_index = 0x08,
  statistics = 0x0B,
  summary_offset = 0x0E,
  data_end = 0x0F,
};

constexpr std::uint64_t record_head_bytes = 9;    ///< opcode, length of the content
constexpr std::uint64_t message_head_bytes = 22;  ///< channel, sequence, log time, publish time

struct RecordHead {
  Opcode opcode{};
  std::uint64_t length = 0;  ///< of the content
};
/// Of `record_head_bytes` bytes.
RecordHead record_head(std::string_view bytes);

/// Incremental CRC-32, as in zip and PNG.
class Crc32 {
 public:
  void add(std::string_view bytes);
  std::uint32_t value() const;

 private:
  std::uint32_t remainder_ = 0xFFFFFFFF;
};

}  // namespace incognita::mcap
