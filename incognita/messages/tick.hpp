// One iteration of the loop.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

namespace incognita {

struct Tick {
  std::int64_t frame = -1;  ///< increasing, from any nonnegative start
  double t = 0;             ///< s, since the start of the run or as stamped by the recording
  double dt = 0;            ///< s, since the previous tick; 0 at the first
  bool whole_us =
      false;  ///< `t` and the times of the readings are stamps in whole microseconds: duration_s()

  /// False for the empty tick that ends a clock.
  explicit operator bool() const { return frame >= 0; }
};

/// A time or duration, s, rounded to whole microseconds.
inline double rounded_to_us(double s) { return std::round(s * 1e6) / 1e6; }

/// Time from one stamp to another, s. Between stamps in whole microseconds it is exact, and thus does not depend on the origin
/// of the clock: the difference of two doubles that count from 1970 is off by up to 0.2 us, and by another amount with any
/// other origin.
inline double duration_s(double from, double to, bool whole_us) {
  return whole_us ? rounded_to_us(to - from) : to - from;
}

/// Whether time `t` has reached `due_t`, with a tolerance for the rounding of tick times (coarse when they
/// count from 1970), which must not add a tick to a period.
inline bool has_come(double due_t, double t) {
  return t >= due_t - 1e-9 - 4 * std::numeric_limits<double>::epsilon() * std::abs(t);
}

}  // namespace incognita
