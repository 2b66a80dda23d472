#include "incognita/messages/stream_times.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "incognita/messages/tick.hpp"

namespace incognita {

double steady_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double StreamTimes::time_of(double reported_s, double arrived_s) {
  constexpr double most_apart_s = 1, least_step_s = 1e-6;
  if (!is_first_) {
    const double reported = reported_s - reported_s_, arrived = arrived_s - arrived_s_;
    const bool is_plausible = reported_s > 0 && reported > 0 && std::abs(reported - arrived) <= most_apart_s;
    t_ = rounded_to_us(t_ + std::max(is_plausible ? reported : arrived, least_step_s));
  }
  is_first_ = false;
  reported_s_ = reported_s, arrived_s_ = arrived_s;
  return t_;
}

}  // namespace incognita
