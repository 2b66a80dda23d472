#include "incognita/io/bags/mcap_format.hpp"

#include <boost/crc.hpp>

#include "incognita/io/bags/record_cursor.hpp"

namespace incognita::mcap {

RecordHead record_head(std::string_view bytes) {
  bags::RecordCursor fields(bytes, 0);
  const auto opcode = static_cast<Opcode>(fields.number<std::uint8_t>());
  return {opcode, fields.number<std::uint64_t>()};
}

void Crc32::add(std::string_view bytes) {
  boost::crc_32_type crc;
  crc.reset(remainder_);
  crc.process_bytes(bytes.data(), bytes.size());
  remainder_ = crc.get_interim_remainder();
}

std::uint32_t Crc32::value() const {
  boost::crc_32_type crc;
  crc.reset(remainder_);
  return crc.checksum();
}

}  // namespace incognita::mcap
