// Keyframes: frames whose camera poses and matches are kept, so that they and the landmarks can be estimated anew.
// The filter linearizes each measurement once, when poses and depths may still be poorly known. Bundle adjustment over the
// last keyframes linearizes all of their measurements at their common estimate; older keyframes stay where they are. The means
// of the belief then move to those of the adjustment. Its covariance stays that of the filter, from nearly the same
// measurements. This is an approximation: depth priors of landmarks that began between keyframes are the belief's.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "incognita/slam/bundle/adjust_bundle.hpp"
#include "incognita/slam/bundle/depth_prior.hpp"
#include "incognita/slam/mapper/estimate.hpp"

namespace incognita {

class StateArchive;

struct KeyframeMatch {
  std::int64_t id = 0;  ///< of the landmark
  Eigen::Vector2d pixel{0, 0};
  Eigen::Matrix2d cov = Eigen::Matrix2d::Identity();  ///< px^2
  /// Its landmark stays where the belief has it: it is known from before the keyframes, which are to fit to it.
  bool is_reference = false;
};

/// When a frame becomes a keyframe: after `min_frames`, once the matched features moved by `min_motion_px` (rms) since the
/// last keyframe, or none of its features is matched, or the matches are fewer than `min_matched_share` of its features. The first
/// keyframes after an origin are nearer together, if `min_start_motion_px` is less: a wrong start is found earlier.
struct KeyframePolicy {
  int min_frames = 3;
  double min_motion_px = 20;
  double min_start_motion_px = 5;
  double min_matched_share = 0.8;
};

class Keyframes {
 public:
  /// Forgets all, and begins at time `t`, s, with a camera pose of this covariance. If that is next to zero, as of an origin, the
  /// pose is fixed and gives the frame of the world.
  void start(const CameraState& camera, const Eigen::Matrix<double, 6, 6>& cov, double t);

  /// Counts a frame with these matches.
  bool is_due(const std::vector<KeyframeMatch>& matches, const KeyframePolicy& policy);
  /// Adds the pose of the free camera `body` at time `t`, s. The prior of a landmark that began in no keyframe is what the belief
  /// knows of its depth; while the map starts, that may be wrong, and the prior is that given to adjust().
  void add(const Estimate& estimate, BlockId body, const std::vector<KeyframeMatch>& matches, double t);
  /// Adds matches to the last keyframe, which is the current pose of that body.
  void add_matches(const Estimate& estimate, BlockId body, const std::vector<KeyframeMatch>& matches);
  /// Adds a landmark that begins in the last keyframe, with the prior that the belief began with.
  void add_new(const KeyframeMatch& match, const DepthPrior& prior);

  /// Adjusts the last `window` keyframes and the landmarks seen in them, and moves the means of the belief: of the other landmarks as
  /// the covariance expects, given how the camera moved, unless the keyframes fit to references. `body`: the free camera, in the last
  /// keyframe. Its velocity and rate follow from the change relative to the keyframe before. If the
  /// adjustment is refused, the belief stays as it is.
  AdjustmentReport adjust(Estimate& estimate, BlockId body, const Camera& camera,
                          const AdjustmentSettings& settings, const DepthPrior& prior, int window);

  /// Whether the last keyframe is among the first ones since an origin.
  bool is_starting() const;
  /// For the near ones of those and for the last, without known points: adjusts from flat_start(), reversed_start() and
  /// two_view_start(). True if the best of them fits the matches better; the keyframes and points are then its own, and the
  /// belief is to be renewed from them.
  bool start_again(const Camera& camera, const AdjustmentSettings& settings);

  /// How far the belief moved points since the last adjustment, as seen from the camera: median, px. Large after the filter
  /// closed a loop, or drifted along directions that the images do not observe; 0 without points in view.
  double moved_px(const Estimate& estimate, const CameraState& from, const Camera& camera) const;
  /// Number of these matches whose landmarks were last matched in a keyframe before the window of the last adjustment: only they
  /// can close a loop.
  int returning_count(const std::vector<KeyframeMatch>& matches) const;

  /// The last keyframe, the one before it, which must exist, and the first that is kept.
  const BundleView& last_view() const { return views_.rbegin()->second; }
  const BundleView& view_before() const { return std::prev(views_.end(), 2)->second; }
  const BundleView& first_view() const { return views_.begin()->second; }
  /// The keyframes of the window of the last adjustment, in time order.
  std::vector<PastPose> window() const;
  int view_count() const { return static_cast<int>(views_.size()); }
  double elapsed_s() const { return t_ - t_before_; }  ///< between the last two
  /// A landmark whose host is the first keyframe, as adjusted; nothing for others.
  std::optional<Eigen::Vector3d> point_in_first_view(std::int64_t id) const;

  /// Saves or restores: math/saved_state/.
  void state(StateArchive& archive);

 private:
  struct Seen {
    int view = 0;
    Eigen::Vector2d pixel;
    Eigen::Matrix2d cov;
    void state(StateArchive& archive);
  };
  struct Track {
    std::vector<Seen> seen;
    std::optional<DepthPrior> prior = {};   ///< of the depth in the first view; none: that given to adjust()
    std::optional<BundlePoint> point = {};  ///< after the last adjustment; its host is the number of a view
    bool is_reference = false;
    void state(StateArchive& archive);
  };

  int last() const { return views_.rbegin()->first; }
  void forget_before(int first_free);
  std::optional<BundlePoint> point_of(const Track& track, const Landmark& landmark, const Estimate& estimate,
                                      const DepthPrior& prior) const;
  void add_views(int first_free);
  void add_points(const Estimate& estimate, const DepthPrior& prior, int first_free);
  void take_bundle();
  void move_means(Estimate& estimate, BlockId body, const BundleView& before) const;

  std::map<int, BundleView> views_;       ///< by number; older ones if a landmark was seen there
  std::map<int, double> times_;           ///< s, of the views of the window
  std::map<std::int64_t, Track> tracks_;  ///< by landmark
  BundleView first_view_;                 ///< prior of view 0
  Eigen::Matrix<double, 6, 6> first_view_cov_ = Eigen::Matrix<double, 6, 6>::Zero();
  int frames_ = 0;               ///< since the last keyframe
  double t_ = 0, t_before_ = 0;  ///< s, of the last keyframe and the one before

  // Of the last adjustment
  Bundle bundle_;
  std::vector<int> numbers_;       ///< of its views
  std::map<int, int> indices_;     ///< of the views, by number
  std::vector<std::int64_t> ids_;  ///< of its points
  double cost_ = 0;
  int window_ = 2;
  bool begins_ = false;  ///< since start(): the first view is an origin
  BundleEquations equations_;
};

}  // namespace incognita
