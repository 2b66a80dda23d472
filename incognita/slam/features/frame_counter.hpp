// The frames of the cameras of one body, at ticks that may be more frequent than their images.
#pragma once

#include <optional>

namespace incognita {

class FrameCounter {
 public:
  /// Frames at the tick at time `t`, s: 1 with an image; without one, those that are overdue by the period of the last
  /// images, as of a camera that failed.
  int count(bool has_image, double t);

 private:
  std::optional<double> image_t_;  ///< s, of the last image
  double image_period_s_ = 1;      ///< between the last two images; assumed before the second
  int missed_ = 0;                 ///< frames since the last image, at that period
};

}  // namespace incognita
