// Reads the fields of a ROS message, one after the other, in the serialization of ROS 1 or of ROS 2.
//
// ROS 1 (http://wiki.ros.org/msg): little-endian, packed; texts and lists after their length in 4 bytes.
// ROS 2: CDR (OMG DDS-XTypes 1.3, 7.4.3): 4 bytes that state the byte order, then numbers aligned to their size from there on;
// the length of a text includes the zero at its end.
#pragma once

#include <fmt/format.h>

#include <array>
#include <bit>
#include <concepts>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>

namespace incognita::bags {

enum class Serialization { ros1, cdr };

/// A message is shorter than its fields, or not serialized as stated. Names the byte within the message.
struct MessageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class MessageCursor {
 public:
  /// `bytes` must outlive the cursor and the views that it gives. Throws MessageError for an unknown CDR encapsulation.
  MessageCursor(std::string_view bytes, Serialization serialization)
      : bytes_(bytes), serialization_(serialization) {
    if (serialization == Serialization::ros1) return;
    constexpr std::size_t encapsulation_bytes = 4;
    const std::string_view head = raw(encapsulation_bytes);
    if (head[0] != 0 || (head[1] != 0 && head[1] != 1))
      throw MessageError(fmt::format("begins with {:02x} {:02x}, which is not plain CDR",
                                     static_cast<unsigned char>(head[0]),
                                     static_cast<unsigned char>(head[1])));
    is_big_endian_ = head[1] == 0;
    begin_ = encapsulation_bytes;
  }

  Serialization serialization() const { return serialization_; }

  template <class Number>
  requires std::integral<Number> || std::floating_point<Number> Number number() {
    align(sizeof(Number));
    std::array<char, sizeof(Number)> bytes{};
    std::memcpy(bytes.data(), raw(sizeof(Number)).data(), sizeof(Number));
    if (is_big_endian_ != (std::endian::native == std::endian::big))
      for (std::size_t i = 0; i < bytes.size() / 2; ++i) std::swap(bytes[i], bytes[bytes.size() - 1 - i]);
    return std::bit_cast<Number>(bytes);
  }

  std::string_view text() {
    std::string_view text = raw(number<std::uint32_t>());
    if (serialization_ == Serialization::cdr && text.ends_with('\0')) text.remove_suffix(1);
    return text;
  }

  /// `uint8[]`
  std::string_view bytes() { return raw(number<std::uint32_t>()); }

  /// The length of a list, of which each entry has at least `entry_bytes` bytes.
  std::uint32_t list_size(std::size_t entry_bytes) {
    const auto n = number<std::uint32_t>();
    if (n > (bytes_.size() - at_) / entry_bytes)
      throw MessageError(fmt::format("byte {}: a list of {} entries is longer than the message", at_, n));
    return n;
  }

 private:
  void align(std::size_t size) {
    if (serialization_ == Serialization::ros1) return;
    if (const std::size_t past = (at_ - begin_) % size; past != 0) raw(size - past);
  }

  std::string_view raw(std::size_t n) {
    if (n > bytes_.size() - at_)
      throw MessageError(fmt::format("byte {}: a field of {} bytes is longer than the message", at_, n));
    const std::string_view taken = bytes_.substr(at_, n);
    at_ += n;
    return taken;
  }

  std::string_view bytes_;
  Serialization serialization_;
  bool is_big_endian_ = false;
  std::size_t begin_ = 0;  ///< of what alignment counts from
  std::size_t at_ = 0;
};

}  // namespace incognita::bags
