// The standard deviation of a match, estimated from the matches themselves: it depends on blur, texture and calibration.
#pragma once

#include <vector>

#include "incognita/slam/features/feature.hpp"

namespace incognita {

class PixelNoise {
 public:
  /// After the correction: takes the residuals of this frame's matches at full resolution at the corrected means, and sets
  /// TrackedCamera::sigma_pixel_px, px. Their median makes it robust against outliers; frames are averaged.
  void update(const Estimate& estimate, TrackedCamera& camera);

 private:
  std::vector<double> squares_;  ///< workspace, px^2
};

}  // namespace incognita
