// Detects a rolling shutter. The filter takes all rows of an image as exposed at once. Where the rows follow each other, a feature
// that moves is displaced by its image velocity times the delay of its row, and that pattern remains in the residuals.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "incognita/slam/features/feature.hpp"

namespace incognita {

class StateArchive;

class RollingShutter {
 public:
  /// After the correction at time `t`, s: regresses the residuals of this frame's matches on (row - middle row) / rows times image
  /// velocity, px/s, the same of the columns, and the pose of the camera, and adds the information on the two readout times to
  /// that of the frames before. `estimate`: corrected by these matches.
  void update(const Estimate& estimate, const TrackedCamera& camera, double t);

  /// Nothing without significant evidence. An underestimate: landmarks and velocities were estimated from the same distorted
  /// images and explain a part of the residuals.
  std::optional<Readout> readout() const;

  /// Saves or restores: math/saved_state/.
  void state(StateArchive& archive);

 private:
  struct Seen {
    std::int64_t id = 0;  ///< of the landmark
    Eigen::Vector2d predicted;
    void state(StateArchive& archive);
  };
  std::vector<Seen> now_, before_;  ///< matches of this frame and the last, by id
  std::optional<double> t_before_;  ///< s
  Eigen::Matrix2d information_ =
      Eigen::Matrix2d::Zero();  ///< of the readout times of columns and rows, 1/s^2, over all frames
  Eigen::Vector2d weighted_sum_ = Eigen::Vector2d::Zero();  ///< information times estimate of each frame, 1/s
};

}  // namespace incognita
