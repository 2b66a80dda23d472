// The frames of the cameras of one body, at ticks that may be more frequent than their images.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

namespace incognita {

class FrameCounter {
 public:
  /// Frames at the tick at time `t`, s: 1 with an image; without one, those that are overdue by the period of the last
  /// images, as of a camera that failed. An image is overdue a quarter of a period after its time.
  int count(bool has_image, double t);

 private:
  double period_s() const;

  std::optional<double> image_t_;    ///< s, of the last image
  std::array<double, 5> intervals_;  ///< s, the last ones between two images
  std::size_t interval_count_ = 0;   ///< since the first image
  int missed_ = 0;                   ///< frames since the last image, at that period
};

}  // namespace incognita
