// The standard deviation of a match, and how much of it lasts, estimated from the matches themselves: both depend on blur,
// texture and calibration.
#pragma once

#include <cstdint>
#include <vector>

#include "incognita/slam/features/feature.hpp"

namespace incognita {

class StateArchive;

class PixelNoise {
 public:
  /// After the correction: takes the residuals of this frame's matches at full resolution at the corrected means, and sets
  /// TrackedCamera::sigma_pixel_px, px. Their median makes it robust against outliers; frames are averaged. Errors that last
  /// over many frames, as of a patch that is not quite a plane, are not new information in each of them: from the
  /// autocorrelation r of the residuals of a landmark, lasting_factor is (1 + r) / (1 - r), by which the variance of the mean of
  /// many such errors exceeds that of white noise (first-order Markov process).
  void update(const Estimate& estimate, TrackedCamera& camera);

  /// Saves or restores: math/saved_state/.
  void state(StateArchive& archive);

 private:
  struct Residual {
    std::int64_t id = 0;  ///< of the landmark
    Eigen::Vector2d px;
    void state(StateArchive& archive);
  };
  void update_lasting(TrackedCamera& camera);

  std::vector<double> squares_;         ///< workspace, px^2
  std::vector<Residual> now_, before_;  ///< of this frame and the last, by id
  double product_ = 0, square_ = 0;     ///< px^2, of residuals of successive frames, averaged
};

}  // namespace incognita
