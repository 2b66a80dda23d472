// Time that this thread has spent on the processor: what else the machine does meanwhile does not count.
#pragma once

#include <ctime>

namespace incognita {

inline double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace incognita
