// A progress line on the terminal. Silent if standard error is not a terminal.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace incognita {

class Progress {
 public:
  /// `total` 0: unknown.
  explicit Progress(std::int64_t total, std::string unit = "frames");
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void show(std::int64_t done, const std::string& what);
  bool on_terminal() const { return terminal_; }

 private:
  std::int64_t total_;
  std::string unit_;
  bool terminal_;
  bool shown_ = false;
  std::chrono::steady_clock::time_point start_, last_;
};

}  // namespace incognita
