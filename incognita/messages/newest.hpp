// Hands the newest of what arrives in one thread to another, which takes it when it has time.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>
#include <utility>

namespace incognita {

template <class T>
class Newest {
 public:
  /// Replaces one that has not been taken, which counts as dropped.
  void put(T value) {
    {
      const std::lock_guard lock(mutex_);
      if (value_) ++dropped_;
      value_ = std::move(value);
    }
    came_.notify_one();
  }

  /// Waits for one that has not been taken; nothing if none comes in time.
  std::optional<T> take(double wait_s) {
    std::unique_lock lock(mutex_);
    came_.wait_for(lock, std::chrono::duration<double>(wait_s), [this] { return value_.has_value(); });
    return std::exchange(value_, std::nullopt);
  }

  /// Forgets what has not been taken, and the count.
  void clear() {
    const std::lock_guard lock(mutex_);
    value_.reset();
    dropped_ = 0;
  }

  std::int64_t dropped() const {
    const std::lock_guard lock(mutex_);
    return dropped_;
  }

 private:
  mutable std::mutex mutex_;
  std::condition_variable came_;
  std::optional<T> value_;
  std::int64_t dropped_ = 0;
};

}  // namespace incognita
