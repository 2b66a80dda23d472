// Keyframes: frames whose camera poses and matches are kept, so that all of them and the landmarks can be estimated anew.
// The filter linearizes each measurement once, when poses and depths may still be poorly known; bundle adjustment over the
// keyframes linearizes all of theirs at their common estimate. Mean and covariance of the belief are then replaced by
// those of the adjustment: frames between keyframes guide the filter only.
#pragma once

#include <cstdint>
#include <map>
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
  /// Forgets all, and begins with a camera pose and its covariance (6 errors, as of BundleView).
  void start(const CameraState& camera, const Eigen::Matrix<double, 6, 6>& cov);

  /// Counts a frame with these matches.
  bool is_due(const std::vector<KeyframeMatch>& matches, const KeyframePolicy& policy);
  void add(const CameraState& camera, const std::vector<KeyframeMatch>& matches);
  /// Adds a landmark that begins in the last keyframe, unless it is known.
  void add_if_new(const KeyframeMatch& match);

  /// Adjusts all keyframes and the landmarks of the estimate that they saw, and replaces mean and covariance of the
  /// belief. `body`: the free camera, in the last keyframe. Velocity and rate follow from their correlations with the
  /// pose. If the adjustment is refused, the belief stays as it is. Only for beliefs of one body in covariance form.
  AdjustmentReport adjust(Estimate& estimate, BlockId body, const Camera& camera,
                          const AdjustmentSettings& settings, const DepthPrior& prior);

  /// The keyframe in which a landmark was seen first; null without one. Valid until the next change.
  const BundleView* host_of(std::int64_t id) const;

 private:
  struct Seen {
    int view = 0;
    Eigen::Vector2d pixel;
    Eigen::Matrix2d cov;
  };

  Bundle bundle_of(Estimate& estimate, const DepthPrior& prior);

  /// The errors of the belief: those of the views times a matrix, plus noise of each block of its own.
  struct Errors {
    Eigen::MatrixXd X;               ///< covariance of the errors of the views = X X'
    Eigen::MatrixXd Y;               ///< errors of the belief x errors of the views, times X
    std::map<int, BlockMatrix> own;  ///< noise, by the first error of the block
  };
  void replace_camera(AnyBelief& belief, BlockId body, const BundleView& last, Errors& errors) const;
  void replace_landmark(AnyBelief& belief, const Landmark& landmark, const Bundle& bundle, std::size_t index,
                        Errors& errors) const;
  void replace_belief(Estimate& estimate, BlockId body, const Bundle& bundle) const;

  std::vector<BundleView> views_;
  Eigen::Matrix<double, 6, 6> first_view_cov_ = Eigen::Matrix<double, 6, 6>::Identity();
  BundleView first_view_;
  std::map<std::int64_t, std::vector<Seen>> seen_;  ///< by landmark
  std::vector<std::int64_t> ids_;                   ///< of the points of the last bundle
  int frames_ = 0;                                  ///< since the last keyframe
  BundleEquations equations_;
};

}  // namespace incognita
