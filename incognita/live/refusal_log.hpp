// Says what was refused, at most a few times per second, so that a flood of requests is no flood of lines.
#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <string>
#include <utility>

namespace incognita {

class RefusalLog {
 public:
  using Clock = std::chrono::steady_clock;
  explicit RefusalLog(std::function<void(const std::string&)> print) : print_(std::move(print)) {}

  /// Prints a message at most once per second; later its repetitions are counted.
  void add(const std::string& message, Clock::time_point now = Clock::now());

 private:
  struct Entry {
    Clock::time_point printed;
    int since = 0;
  };
  std::function<void(const std::string&)> print_;
  std::map<std::string, Entry> entries_;
};

}  // namespace incognita
