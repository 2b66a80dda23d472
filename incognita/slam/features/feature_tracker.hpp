// The image front end of one camera: thesis Appendix C, one frame at a time. It finds the landmarks of the estimate in
// the images by active search, proposes new ones, and keeps their appearance; the back end corrects the belief.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "incognita/math/random.hpp"
#include "incognita/slam/bundle/keyframes.hpp"
#include "incognita/slam/features/align_rotation.hpp"
#include "incognita/slam/features/feature.hpp"
#include "incognita/slam/features/loop_closure.hpp"
#include "incognita/slam/features/pixel_noise.hpp"
#include "incognita/slam/features/relocalization.hpp"
#include "incognita/slam/features/rolling_shutter.hpp"
#include "incognita/slam/features/target.hpp"
#include "incognita/slam/features/target_pose.hpp"
#include "incognita/vision/search.hpp"

namespace incognita {

class StateArchive;

/// Where a camera is, and how the pose of its body is found at the start.
struct CameraPlacement {
  std::size_t body = 0;
  std::optional<Mount> mount = {};    ///< none: the body is the camera itself
  std::optional<Target> target = {};  ///< its pose defines the world; none: the body starts as its model says
  double max_search_s = 10;           ///< lost when no image shows the target by then
};

class FeatureTracker {
 public:
  /// Throws std::invalid_argument, with the key of the scenario file and the value, for the first invalid setting.
  FeatureTracker(Camera camera, const CameraSlamSettings& settings, const CameraPlacement& placement,
                 std::uint64_t seed);

  /// Sets the index among all cameras of the estimator.
  void set_index(int index);
  /// Switches bundle adjustment off, BundleSettings.
  void adjust_no_bundle();
  /// Switches loop closure off, RelocalizationSettings.
  void close_no_loops();

  /// Takes the image of this tick; null without one. The image must live until the next call. Throws
  /// std::invalid_argument for an image whose size is not that of the camera.
  void see(const Image* image);
  bool has_image() const { return sees_; }
  bool has_target() const { return placement_.target.has_value(); }
  bool has_map() const { return has_map_; }

  /// The start pose of the body, or why there is none.
  struct Start {
    bool ready = false;
    bool given_up = false;                ///< nothing was found for max_search_s
    std::optional<TargetPose> pose = {};  ///< from the target, if there is one
    std::string reason;
  };
  Start find_start(double waited_s) const;
  /// Adds the corners of the target that was found, and the first landmarks of the image.
  void start_map(Estimate& estimate, const std::optional<TargetPose>& pose, const AnyMotion& motion);

  // States of the errors of matches that last, lasting_errors.hpp.

  /// Prior covariance of a pose from the target, which start_map() corrects.
  Eigen::Matrix<double, 6, 6> start_cov(const TargetPose& pose) const;
  /// Adds them to the belief, before any landmark.
  void start_lasting_errors(Estimate& estimate);
  void predict_lasting_errors(Estimate& estimate, double dt) const;
  /// To be called before the correction: the landmarks of its matches get states.
  void lend_lasting_errors(Estimate& estimate);
  /// Of a lost camera: where it is found again it has another view.
  void forget_lasting_errors() { camera_.lasting.take_back(); }

  /// Aligns the image with the one before, from the predicted motion, to guide the search.
  void align(const Estimate& estimate, const AnyMotion& motion);
  void forget_alignment() { camera_.guide.reset(); }
  /// Predicts the features in view from the current estimate.
  void predict(const Estimate& estimate, const AnyMotion& motion);
  /// Rotation vector, rad in camera axes, by which the camera turned beyond the prediction according to the whole image, if
  /// most features are then expected outside of their search ellipses; nothing otherwise.
  std::optional<Eigen::Vector3d> unexpected_turn() const;
  /// Searches for the predicted features.
  void search();
  /// Adds the noise of patches whose plane is not known yet.
  void add_plane_uncertainty();
  void reject_outliers(const Estimate& estimate);
  /// The inliers, linearized at the prediction.
  void append_measurements(const Estimate& estimate, std::vector<LinearizedMeasurement>& measurements) const;
  /// The same, linearized at the current means; without parts where a measurement is not defined.
  void append_relinearized(const Estimate& estimate, const AnyMotion& motion,
                           std::vector<LinearizedMeasurement>& measurements);
  /// The inliers do not correct the filter, or did not.
  void discard_matches();
  /// To be called after the correction: takes the corrected viewpoint, and estimates the planes of the patches.
  void after_correction(const Estimate& estimate, const AnyMotion& motion);
  /// Counts the frames for which each feature is known, in view and without a match.
  void count_frames();

  /// Converts, deletes and adds landmarks, and adjusts the last keyframes; for frames with enough matches.
  void maintain_map(Estimate& estimate, const AnyMotion& motion);
  /// Whether the last maintain_map() moved the estimate by bundle adjustment.
  bool moved_estimate() const { return moved_estimate_; }
  /// Removes what means nothing without the pose.
  void forget_depth_lines(Estimate& estimate);

  /// Searches for the pose of a lost camera, by the matches of this frame and then in the whole map, RelocalizationSettings;
  /// the body must be the camera itself. Evidence that suffices, or nothing. `t`: s, of this frame.
  std::optional<PoseEvidence> find_in_map(const Estimate& estimate, double t);
  /// Of a camera that tracks, after its search: the correction of a drift that returning landmarks show. `t`: s, of this frame.
  std::optional<ClosedLoop> find_loop(const Estimate& estimate, double t);
  /// Of a camera that does not track: forgets a loop that is not confirmed yet.
  void forget_loop() { loop_closure_.restart(); }
  /// Moves the appearance of the landmarks that drifted.
  void move_views(const ClosedLoop& loop) { incognita::move_views(camera_, loop); }
  /// Whether the matches of the image after the correction confirm the loop; `before`: the camera before it.
  bool confirms(const ClosedLoop& loop, const TrackedCamera& before) const {
    return incognita::confirms(loop, camera_, before);
  }
  /// After a drift was corrected: the keyframes begin anew, and fit to the map as corrected.
  void restart_keyframes() {
    keyframes_are_old_ = true;
    reference_frames_ = 0;
  }
  /// Time of the last image that corrected the estimate or began the map, s.
  double last_image_t() const { return before_t_; }
  /// Of a rolling shutter, if the residuals show one: the estimator takes all rows as exposed at once.
  std::optional<Readout> readout() const { return rolling_shutter_.readout(); }
  /// Takes the matches of that evidence as those of this frame, once the belief holds its pose, with a prior that is wide
  /// relative to its covariance; rejects outliers.
  void take_matches(PoseEvidence evidence, const Estimate& estimate);

  /// The map goes on in another run: forgets images, times and what follows from one frame to the next. The landmarks that are
  /// known stay where they are while keyframes are adjusted.
  void forget_time();

  /// Takes over a landmark of the estimate, e.g. of a saved map, with its appearance.
  void adopt(std::int64_t id, Feature feature);

  /// Appends the matches of this frame.
  void append_matches(FrameReport& report) const;

  const TrackedCamera& camera() const { return camera_; }
  /// Takes the results of this frame back to those of a copy of camera() from before a further search.
  void restore(TrackedCamera before) { camera_ = std::move(before); }
  int matched() const { return camera_.matched; }

  /// Saves or restores: math/saved_state/.
  void state(StateArchive& archive);

 private:
  /// Landmarks that are wanted in this frame, and for which the map has room.
  struct NewLandmarks {
    int wanted = 0, possible = 0;
  };
  NewLandmarks new_landmarks(const Estimate& estimate) const;
  int fill_gaps(Estimate& estimate);
  void correct_by_target(Estimate& estimate);
  void expect_depth_of_target(const Estimate& estimate);
  void add_landmarks(Estimate& estimate);
  bool add_keyframe(Estimate& estimate, const AnyMotion& motion);
  Eigen::Matrix<double, 6, 6> pose_cov(const Estimate& estimate) const;
  void add_new_landmarks_to_keyframe(std::int64_t newest);
  LinearizedMeasurement with_lasting(LinearizedMeasurement measurement, const FeatureMatch& match) const;

  TrackedCamera camera_;
  CameraPlacement placement_;
  Keyframes keyframes_;
  bool moved_estimate_ = false;
  bool keyframes_are_old_ = false;  ///< of before a drift was corrected
  std::optional<int>
      reference_frames_;  ///< known for more, landmarks are references: of the map as corrected
  PixelNoise pixel_noise_;
  RollingShutter rolling_shutter_;
  Relocalization relocalization_;
  LoopClosure loop_closure_;
  ImagePyramid pyramid_;
  SmallImage small_, small_before_;
  std::vector<Eigen::Vector3d> small_rays_, predicted_rays_;
  std::optional<CameraState> before_;  ///< when small_before_ was taken
  double before_t_ = 0;                ///< s, the time of that
  bool sees_ = false;
  bool has_map_ = false;  ///< since start_map()
  RandomStream random_;
};

}  // namespace incognita
