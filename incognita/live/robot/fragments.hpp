// Long messages in parts: operation `fragment` of rosbridge, Section 3.1.1 of its protocol.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "incognita/live/robot/rosbridge.hpp"

namespace incognita::rosbridge {

/// The message itself if it has at most `bytes` bytes, else fragments with at most so many bytes of it each. UTF-8 characters
/// are not cut.
std::vector<std::string> in_fragments(const std::string& message, std::size_t bytes, const std::string& id);

/// Puts fragments together. Bounded: a sender that never completes its messages loses the oldest of them.
class FragmentAssembler {
 public:
  /// The whole message when this fragment completes it. Throws InputError for a message that becomes longer than
  /// max_message_bytes, and for a fragment whose `total` differs from the first one's.
  std::optional<std::string> add(const Fragment& fragment);

 private:
  static constexpr std::size_t most_open = 8;
  struct Open {
    std::map<int, std::string> parts = {};
    int total = 0;
    std::size_t bytes = 0;
    std::uint64_t begun = 0;
  };
  void forget_oldest();

  std::map<std::string, Open> open_;
  std::uint64_t begun_ = 0;
};

}  // namespace incognita::rosbridge
