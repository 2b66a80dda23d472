// Computation time of each stage of a tick.
#pragma once

#include <chrono>
#include <string_view>
#include <utility>
#include <vector>

namespace incognita {

class StageClock {
 public:
  explicit StageClock(std::vector<std::pair<const char*, double>>& timing_ms)
      : timing_ms_(timing_ms), last_(Clock::now()) {
    timing_ms_.clear();
  }
  /// Adds the time since the previous mark to this stage.
  void mark(const char* stage) {
    const auto now = Clock::now();
    const double ms = std::chrono::duration<double, std::milli>(now - last_).count();
    last_ = now;
    for (auto& [name, total] : timing_ms_)
      if (std::string_view(name) == stage) {
        total += ms;
        return;
      }
    timing_ms_.emplace_back(stage, ms);
  }

 private:
  using Clock = std::chrono::steady_clock;
  std::vector<std::pair<const char*, double>>& timing_ms_;
  Clock::time_point last_;
};

}  // namespace incognita
