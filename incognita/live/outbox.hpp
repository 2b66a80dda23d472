// The messages that wait for one viewer: a slow viewer misses the oldest, and never slows the program.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace incognita {

/// One message; its body is shared by all viewers.
struct LiveMessage {
  std::shared_ptr<const std::string> body;
  std::string prefix = {};  ///< of this viewer, written before the body
  bool binary = false;
  bool droppable = false;          ///< a later message replaces it
  bool counts_drops = false;       ///< the number of dropped messages is written between prefix and body
  std::string_view replaces = {};  ///< a waiting message with the same word here is outdated; a constant

  std::size_t size() const { return prefix.size() + (body ? body->size() : 0); }
};

class Outbox {
 public:
  struct Limits {
    std::size_t messages = 64;
    std::size_t bytes = 8u << 20;
  };
  explicit Outbox(Limits limits) : limits_(limits) {}
  Outbox() : Outbox(Limits{}) {}

  /// Replaces what the message makes outdated. Drops the oldest droppable messages as long as a limit is exceeded. False if messages that must not be dropped
  /// exceed a limit alone: the viewer is to be disconnected. One message alone always fits.
  bool push(LiveMessage message);
  std::optional<LiveMessage> pop();

  std::size_t messages() const { return waiting_.size(); }
  std::size_t bytes() const { return bytes_; }
  std::uint64_t dropped() const { return dropped_; }
  /// Counts messages that were dropped before they reached the outbox.
  void add_dropped(std::uint64_t count) { dropped_ += count; }

 private:
  void remove_outdated(std::string_view word);
  bool exceeded() const {
    return waiting_.size() > 1 && (waiting_.size() > limits_.messages || bytes_ > limits_.bytes);
  }

  Limits limits_;
  std::deque<LiveMessage> waiting_;
  std::size_t bytes_ = 0;
  std::uint64_t dropped_ = 0;
};

}  // namespace incognita
