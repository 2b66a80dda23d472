#include "incognita/messages/stream_times.hpp"

#include <algorithm>
#include <cmath>

#include "incognita/messages/tick.hpp"

namespace incognita {

double StreamTimes::time_of(double told_s, double arrived_s) {
  constexpr double most_apart_s = 1;
  if (!is_first_) {
    const double told = told_s - told_s_, passed = arrived_s - arrived_s_;
    const bool believed = told_s > 0 && told > 0 && std::abs(told - passed) <= most_apart_s;
    t_ = rounded_to_us(t_ + std::max(believed ? told : passed, 1e-6));
  }
  is_first_ = false;
  told_s_ = told_s, arrived_s_ = arrived_s;
  return t_;
}

}  // namespace incognita
