#include "incognita/slam/features/frame_counter.hpp"

#include <algorithm>
#include <utility>

namespace incognita {

int FrameCounter::count(bool has_image, double t) {
  if (has_image) {
    if (image_t_ && missed_ == 0) image_period_s_ = t - *image_t_;
    image_t_ = t;
    missed_ = 0;
    return 1;
  }
  if (!image_t_ || !(image_period_s_ > 0)) return 1;
  const int missed = static_cast<int>(std::min(1e6, (t - *image_t_) / image_period_s_ + 1e-6));
  return missed - std::exchange(missed_, missed);
}

}  // namespace incognita
