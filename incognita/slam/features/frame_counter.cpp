#include "incognita/slam/features/frame_counter.hpp"

#include <algorithm>

namespace incognita {

/// The median of the last intervals: a burst or an outage does not change it. 1 s before the second image.
double FrameCounter::period_s() const {
  if (interval_count_ == 0) return 1;
  const auto known = std::min(interval_count_, intervals_.size());
  std::array<double, 5> sorted = intervals_;
  std::sort(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(known));
  return sorted[known / 2];
}

void FrameCounter::update(bool has_image, double t) {
  if (has_image) {
    if (image_t_ && t > *image_t_) intervals_[interval_count_++ % intervals_.size()] = t - *image_t_;
    image_t_ = t;
    missed_ = 0;
  } else if (image_t_) {
    constexpr double slack = 0.25;
    missed_ = static_cast<int>(std::clamp((t - *image_t_) / period_s() - slack, 0.0, 1e6));
  }
}

}  // namespace incognita
