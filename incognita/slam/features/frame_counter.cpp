#include "incognita/slam/features/frame_counter.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace incognita {

/// The median of the last intervals: a burst or an outage does not change it. 1 s before the second image.
double FrameCounter::period_s() const {
  if (interval_count_ == 0) return 1;
  const auto known = std::min(interval_count_, intervals_.size());
  std::array<double, 5> sorted = intervals_;
  std::sort(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(known));
  return sorted[known / 2];
}

int FrameCounter::count(bool has_image, double t) {
  if (has_image) {
    if (image_t_) intervals_[interval_count_++ % intervals_.size()] = t - *image_t_;
    image_t_ = t;
    missed_ = 0;
    return 1;
  }
  const double period = period_s();
  if (!image_t_ || !(period > 0)) return 1;
  constexpr double slack = 0.25;
  const double late = std::max(0.0, (t - *image_t_) / period - slack);
  const int missed = static_cast<int>(std::min(1e6, late));
  return missed - std::exchange(missed_, missed);
}

}  // namespace incognita
