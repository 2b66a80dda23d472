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

  /// Prints a message at most once per second, and at most five messages; further ones are counted. Bytes other than
  /// printable ASCII become question marks.
  void add(const std::string& message, Clock::time_point now = Clock::now());

 private:
  struct Entry {
    Clock::time_point printed;
    int since = 0;
  };
  std::function<void(const std::string&)> print_;
  bool may_print(Clock::time_point now);

  std::map<std::string, Entry> entries_;
  Clock::time_point second_{};  ///< its start
  int printed_ = 0, unprinted_ = 0;
};

}  // namespace incognita
