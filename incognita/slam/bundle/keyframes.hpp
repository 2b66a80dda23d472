// Keyframes: frames whose camera poses and matches are kept, so that they and the landmarks can be estimated anew.
// The filter linearizes each measurement once, when poses and depths may still be poorly known. Bundle adjustment over the
// last keyframes linearizes all of their measurements at their common estimate; older keyframes stay where they are. The means
// of the belief then move to those of the adjustment. Its covariance stays: it is of the same measurements, and more of
// them, so that nothing is counted twice.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "incognita/slam/bundle/adjust_bundle.hpp"
#include "incognita/slam/mapper/estimate.hpp"

namespace incognita {

struct KeyframeMatch {
  std::int64_t id = 0;  ///< of the landmark
  Eigen::Vector2d pixel{0, 0};
  Eigen::Matrix2d cov = Eigen::Matrix2d::Identity();  ///< px^2
};

/// When a frame becomes a keyframe: after `min_frames`, once the matched features moved by `min_motion_px` (rms) since the
/// last keyframe, or are less than `min_matched_share` of its features.
struct KeyframePolicy {
  int min_frames = 3;
  double min_motion_px = 20;
  double min_matched_share = 0.8;
};

/// Prior of the inverse depth of a landmark, 1/m.
struct DepthPrior {
  double mean = 0.5, sigma = 0.5;
};

class Keyframes {
 public:
  /// Forgets all, and begins with a camera pose. It stays fixed: it is the frame of the world.
  void start(const CameraState& camera);

  /// Counts a frame with these matches.
  bool is_due(const std::vector<KeyframeMatch>& matches, const KeyframePolicy& policy);
  void add(const CameraState& camera, const std::vector<KeyframeMatch>& matches);
  /// Adds a match to the last keyframe.
  void add_match(const KeyframeMatch& match);

  /// Adjusts the last `window` keyframes and the landmarks seen in them, and moves the means of the belief. `body`: the free
  /// camera, in the last keyframe. Its velocity and rate follow from their correlations with the pose. If the adjustment is
  /// refused, the belief stays as it is.
  AdjustmentReport adjust(Estimate& estimate, BlockId body, const Camera& camera,
                          const AdjustmentSettings& settings, const DepthPrior& prior, int window);

 private:
  struct Seen {
    int view = 0;
    Eigen::Vector2d pixel;
    Eigen::Matrix2d cov;
  };
  struct Track {
    std::vector<Seen> seen;
    std::optional<BundlePoint> point;  ///< after the last adjustment
  };

  Bundle bundle_of(const Estimate& estimate, const DepthPrior& prior, int first_free);
  std::optional<BundlePoint> point_of(const Track& track, const Landmark& landmark, const Estimate& estimate,
                                      const DepthPrior& prior) const;
  void move_means(Estimate& estimate, BlockId body) const;

  std::vector<BundleView> views_;
  std::map<std::int64_t, Track> tracks_;  ///< by landmark
  std::vector<std::int64_t> ids_;         ///< of the points of the last bundle
  int frames_ = 0;                        ///< since the last keyframe
  BundleEquations equations_;
};

}  // namespace incognita
