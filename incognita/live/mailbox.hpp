// Hands values from one thread to another: never blocks, and drops the oldest when the other is slow.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <mutex>
#include <utility>

namespace incognita {

template <class Value>
class Mailbox {
 public:
  explicit Mailbox(std::size_t most) : most_(most) {}

  /// True if the mailbox was empty: the other thread is to be notified.
  bool put(Value value) {
    const std::lock_guard lock(mutex_);
    const bool was_empty = waiting_.empty();
    if (waiting_.size() >= most_) waiting_.pop_front(), ++dropped_;
    waiting_.push_back(std::move(value));
    return was_empty;
  }

  struct Taken {
    std::deque<Value> values;   ///< oldest first
    std::uint64_t dropped = 0;  ///< since the last call
  };
  Taken take() {
    const std::lock_guard lock(mutex_);
    return {std::exchange(waiting_, {}), std::exchange(dropped_, 0)};
  }

 private:
  std::mutex mutex_;
  std::size_t most_;
  std::deque<Value> waiting_;
  std::uint64_t dropped_ = 0;
};

}  // namespace incognita
