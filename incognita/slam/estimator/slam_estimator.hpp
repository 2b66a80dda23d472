// Localization and mapping by any number of bodies in one belief, thesis (5.16)-(5.19) and Appendix C. Each body has its
// own motion model and sensors: cameras, whose images are searched for features, and point sensors, which detect
// landmarks, with or without identity, and other bodies.
//
// One tick: predict the bodies; the front ends match what the sensors measured with what the back end predicts; one
// correction with all inliers; then the map is maintained and the health of the estimate assessed.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "incognita/slam/estimator/estimator_start.hpp"
#include "incognita/slam/features/feature_tracker.hpp"
#include "incognita/slam/features/frame_counter.hpp"
#include "incognita/slam/mapper/entropy.hpp"
#include "incognita/slam/mapper/estimator.hpp"
#include "incognita/slam/mapper/settings.hpp"
#include "incognita/slam/points/associate_detections.hpp"
#include "incognita/slam/points/depth_lines.hpp"
#include "incognita/slam/points/prune_landmarks.hpp"

namespace incognita {

struct Jump;
class StageClock;

class SlamEstimator final : public Estimator {
 public:
  /// Throws std::invalid_argument with the reason when the settings are invalid.
  explicit SlamEstimator(EstimatorSettings settings, std::vector<FeatureTracker> cameras = {});

  const EstimatorSettings& settings() const { return settings_; }
  const std::vector<FeatureTracker>& cameras() const { return cameras_; }
  FeatureTracker& camera(std::size_t index) { return cameras_.at(index); }
  const DepthLines& depth_lines() const { return depth_lines_; }

  /// Advances the estimate from the previous tick to this one. `observation.bodies` has one entry per body, in the
  /// order of the settings. Throws std::invalid_argument, and changes nothing, for what check_observation() refuses and
  /// for an image whose size is not that of its camera.
  /// `command`: since the previous tick, for bodies that are predicted by it. The appearance of the landmarks is kept
  /// here: an estimator goes with one estimate.
  void update(Estimate& estimate, const Command& command, const Observation& observation,
              const Tick& tick) override;

  void state(StateArchive& archive) override;

  /// Takes the map of a restored estimate into another run: times and poses are forgotten, and all bodies are lost until their
  /// cameras recognize the map. `reason`: of that, for the status. Throws std::invalid_argument if they could not, and changes
  /// nothing then.
  void forget_poses(Estimate& estimate, const std::string& reason);

 private:
  void begin_errors(Estimate& estimate) const;
  void see(const Observation& observation);
  void count_frames(const Tick& tick);
  std::optional<int> missed_frames(std::size_t body) const;
  void note_lost(const Estimate& estimate);
  bool carries_camera(std::size_t body) const;
  void predict(Estimate& estimate, const Command& command, const Observation& observation, const Tick& tick);
  void predict_features(Estimate& estimate, FeatureTracker& camera);
  void search_features(const Estimate& estimate, FeatureTracker& camera, StageClock& stage);
  bool may_jump(const Estimate& estimate, const FeatureTracker& camera) const;
  void search_after_jump(Estimate& estimate, FeatureTracker& camera, const Jump& jump, int least,
                         StageClock& stage);
  void search_after_turn(Estimate& estimate, FeatureTracker& camera, const Eigen::Vector3d& turn,
                         StageClock& stage);
  void search_after_jolt(Estimate& estimate, FeatureTracker& camera, StageClock& stage);
  bool found_few(const FeatureTracker& camera) const;
  void match_image(Estimate& estimate, FeatureTracker& camera, StageClock& stage);
  void close_loop(Estimate& estimate, FeatureTracker& camera, StageClock& stage);
  void match_images(Estimate& estimate, StageClock& stage);
  double least_found(int searched, bool after_few) const;
  void discard_few_matches();
  bool searches_whole_map(const FeatureTracker& camera) const;
  void find_in_map(Estimate& estimate, FeatureTracker& camera);
  bool correct(Estimate& estimate);
  void update_map(Estimate& estimate, StageClock& stage);
  void assess(Estimate& estimate, bool corrected);
  void relocate(Estimate& estimate, std::size_t body);
  void search_around_last_pose(Estimate& estimate, std::size_t body);
  void maintain_maps(Estimate& estimate);
  void report(Estimate& estimate) const;
  const AnyMotion& motion_of(const FeatureTracker& camera) const {
    return settings_.bodies[camera.camera().body].motion;
  }

  /// Of a body at the current tick.
  struct TrackedBody {
    int frames = 0;  ///< of its cameras: 1 with an image, else those that all of them have missed since
    int missed = 0;  ///< since their last image
    bool was_lost = false;     ///< before this tick, of a body with cameras
    bool matched_few = false;  ///< a small share of its features, when they were searched last
    void state(StateArchive& archive);
  };

  EstimatorSettings settings_;
  std::vector<FeatureTracker> cameras_;
  std::vector<FrameCounter> frame_counters_;  ///< of each camera
  EstimatorStart start_;
  std::vector<TrackedBody> bodies_;
  Inliers inliers_;
  LandmarkPruning pruning_;
  DepthLines depth_lines_;
  RunningEntropy entropy_;
  FrameReport in_images_;                            ///< workspace: the matches of the cameras
  std::vector<LinearizedMeasurement> measurements_;  ///< workspace: inliers of images, then of points
};

}  // namespace incognita
