// Computation time of each stage of a tick.
#pragma once

#include <chrono>
#include <utility>
#include <vector>

namespace incognita {

class StageClock {
 public:
  explicit StageClock(std::vector<std::pair<const char*, double>>& timing_ms)
      : timing_ms_(timing_ms), last_(Clock::now()) {
    timing_ms_.clear();
  }
  /// Assigns the time since the previous mark to this stage.
  void mark(const char* stage) {
    const auto now = Clock::now();
    timing_ms_.emplace_back(stage, std::chrono::duration<double, std::milli>(now - last_).count());
    last_ = now;
  }

 private:
  using Clock = std::chrono::steady_clock;
  std::vector<std::pair<const char*, double>>& timing_ms_;
  Clock::time_point last_;
};

}  // namespace incognita
