// One turn of the loop.
#pragma once

#include <cstdint>

namespace incognita {

struct Tick {
  std::int64_t frame = -1;  ///< counts from 0
  double t = 0;             ///< s, since the start of the run or as the recording stamps it
  double dt = 0;            ///< s, since the tick before; 0 at the first

  /// Whether there is a turn at all: the clock's last answer is an empty tick.
  explicit operator bool() const { return frame >= 0; }
};

}  // namespace incognita
