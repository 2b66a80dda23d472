// One turn of the loop.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

namespace incognita {

struct Tick {
  std::int64_t frame = -1;  ///< counts up, from any number that is not negative
  double t = 0;             ///< s, since the start of the run or as the recording stamps it
  double dt = 0;            ///< s, since the tick before; 0 at the first

  /// Whether there is a turn at all: the clock's last answer is an empty tick.
  explicit operator bool() const { return frame >= 0; }
};

/// Whether a time has come. Rounding of the times of ticks, which is coarse where they count from 1970, must
/// not decide whether a period has one tick more.
inline bool has_come(double due_t, double t) {
  return t >= due_t - 1e-9 - 4 * std::numeric_limits<double>::epsilon() * std::abs(t);
}

}  // namespace incognita
