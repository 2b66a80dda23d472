// A record of a ROS 1 bag: its header, and where its data is.
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "incognita/io/bags/record_bytes.hpp"
#include "incognita/io/bags/record_cursor.hpp"

namespace incognita::ros1 {

enum class Op : std::uint8_t {
  none = 0x00,
  message = 0x02,
  bag_header = 0x03,
  index_data = 0x04,
  chunk = 0x05,
  chunk_info = 0x06,
  connection = 0x07,
};

/// The fields `name=value` of a header.
class HeaderFields {
 public:
  /// `offset`: of the record, for messages.
  HeaderFields(std::string_view bytes, std::uint64_t offset);

  bool has(std::string_view name) const { return find(name) != nullptr; }
  /// Throws Damage if there is no such field.
  const std::string& text(std::string_view name) const;
  /// Also if the field has another length.
  template <class Unsigned>
  Unsigned number(std::string_view name) const {
    const std::string& bytes = text(name);
    if (bytes.size() != sizeof(Unsigned))
      throw bags::Damage{offset_, fmt::format("the field `{}` has {} bytes", name, bytes.size())};
    return bags::RecordCursor(bytes, offset_).number<Unsigned>();
  }
  /// Nanoseconds.
  std::uint64_t time(std::string_view name) const;

 private:
  const std::string* find(std::string_view name) const;

  std::vector<std::pair<std::string, std::string>> fields_;
  std::uint64_t offset_;
};

struct Record {
  std::uint64_t offset = 0;
  HeaderFields header{{}, 0};
  Op op = Op::none;
  std::uint64_t data = 0, length = 0;  ///< where the data begins, and its bytes
  std::uint64_t end() const { return data + length; }
};

/// The record at `offset`, which must end at `end` at the latest. Throws Damage.
Record record_at(bags::RecordBytes& bytes, std::uint64_t offset, std::uint64_t end);

/// Seconds, then nanoseconds, as nanoseconds.
std::uint64_t time_of(bags::RecordCursor& fields);

}  // namespace incognita::ros1
