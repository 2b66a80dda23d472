// The fields of a record of a bag, and what is wrong with it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace incognita::bags {

/// What is wrong with the records at some byte: the end of what can be read. Not for callers of the readers.
struct Damage {
  std::uint64_t offset;
  std::string what;
};

/// Little-endian numbers and texts, one after the other. Throws Damage where the record ends too early.
class RecordCursor {
 public:
  /// `offset`: of the record in the file.
  RecordCursor(std::string_view bytes, std::uint64_t offset) : bytes_(bytes), offset_(offset) {}

  template <class Unsigned>
  Unsigned number() {
    const std::string_view bytes = take(sizeof(Unsigned));
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < sizeof(Unsigned); ++i)
      value |= static_cast<std::uint64_t>(static_cast<unsigned char>(bytes[i])) << (8 * i);
    return static_cast<Unsigned>(value);
  }
  std::string_view text() { return take(number<std::uint32_t>()); }
  bool done() const { return bytes_.empty(); }

 private:
  std::string_view take(std::size_t n) {
    if (n > bytes_.size()) throw Damage{offset_, "a record is shorter than its fields"};
    const std::string_view taken = bytes_.substr(0, n);
    bytes_.remove_prefix(n);
    return taken;
  }

  std::string_view bytes_;
  std::uint64_t offset_;
};

}  // namespace incognita::bags
