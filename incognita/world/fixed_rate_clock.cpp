#include "incognita/world/fixed_rate_clock.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

namespace incognita {
namespace {

constexpr double max_frames = 1e9;  // a year at 30 Hz

}  // namespace

FixedRateClock::FixedRateClock(double rate_hz, double duration_s) : rate_hz_(rate_hz) {
  if (!(rate_hz > 0 && rate_hz <= 1e6))
    throw std::invalid_argument("rate_hz must be above 0 and at most 1e6, got " + std::to_string(rate_hz));
  if (!(duration_s > 0 && duration_s * rate_hz <= max_frames))
    throw std::invalid_argument("duration_s must be above 0 and make at most 1e9 frames, got " +
                                std::to_string(duration_s));
  frames_ = static_cast<std::int64_t>(std::ceil(duration_s * rate_hz - 1e-9));
  if (frames_ < 1) frames_ = 1;
}

Tick FixedRateClock::next() {
  if (next_ >= frames_) return {};
  const std::int64_t frame = next_++;
  return {frame, static_cast<double>(frame) / rate_hz_, frame == 0 ? 0.0 : 1 / rate_hz_};
}

}  // namespace incognita
