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
  constexpr double least_step_s = 1e-6, most_apart_s = 5;
  const double apart_s = (reported_s - origin_.reported_s) - (arrived_s - origin_.arrived_s);
  const bool is_reported = is_related_ && is_trusted_ && is_plausible(reported_s, arrived_s);
  if (is_reported && std::abs(apart_s) > most_apart_s) is_trusted_ = false;
  double t = is_reported && is_trusted_ ? origin_.t + reported_s - origin_.reported_s
                                        : last_.t + arrived_s - last_.arrived_s;
  t = is_first_ ? 0 : rounded_to_us(std::max(t, last_.t + least_step_s));
  last_ = {t, reported_s, arrived_s};
  if (!is_reported) origin_ = last_;
  is_first_ = false, is_related_ = true;
  return t;
}

void StreamTimes::start_anew() { is_related_ = false, is_trusted_ = true; }

bool StreamTimes::is_plausible(double reported_s, double arrived_s) const {
  constexpr double most_ahead_s = 1;
  const double step_s = reported_s - last_.reported_s;
  return reported_s > 0 && step_s > 0 && step_s - (arrived_s - last_.arrived_s) <= most_ahead_s;
}

}  // namespace incognita
