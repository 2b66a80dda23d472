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

  /// False for the empty tick that ends a clock.
  explicit operator bool() const { return frame >= 0; }
};

/// Whether time `t` has reached `due_t`, with a tolerance for the rounding of tick times (coarse when they
/// count from 1970), which must not add a tick to a period.
inline bool has_come(double due_t, double t) {
  return t >= due_t - 1e-9 - 4 * std::numeric_limits<double>::epsilon() * std::abs(t);
}

}  // namespace incognita
