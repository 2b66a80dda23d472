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

#include "incognita/slam/features/feature_tracker.hpp"
#include "incognita/slam/mapper/estimator.hpp"
#include "incognita/slam/mapper/settings.hpp"
#include "incognita/slam/points/associate_detections.hpp"

namespace incognita {

class StageClock;

class SlamEstimator final : public Estimator {
 public:
  /// Throws std::invalid_argument with the reason when the settings are invalid.
  explicit SlamEstimator(EstimatorSettings settings, std::vector<FeatureTracker> cameras = {});

  const EstimatorSettings& settings() const { return settings_; }
  const std::vector<FeatureTracker>& cameras() const { return cameras_; }
  FeatureTracker& camera(std::size_t index) { return cameras_.at(index); }

  /// Advances the estimate from the previous tick to this one. `observation.bodies` has one entry per body, in the
  /// order of the settings. Throws std::invalid_argument, and changes nothing, when their number differs, for an
  /// image whose size is not that of its camera, and for a detection of a sensor or a body that does not exist.
  /// `command`: since the previous tick, for bodies that are predicted by it. The appearance of the landmarks is kept
  /// here: an estimator goes with one estimate.
  void update(Estimate& estimate, const Command& command, const Observation& observation,
              const Tick& tick) override;

 private:
  void see(const Observation& observation);
  void start(Estimate& estimate, const Observation& observation, const Tick& tick);
  bool has_target(std::size_t body) const;
  bool has_first_fixes(const Observation& observation);
  bool has_camera_starts(Estimate& estimate, double waited_s);
  void add_bodies(Estimate& estimate, const Observation& observation, const Tick& tick) const;
  void predict(Estimate& estimate, const Command& command, const Observation& observation, const Tick& tick,
               bool waits_in_place);
  bool carries_camera(std::size_t body) const;
  void match_images(Estimate& estimate, bool was_lost, StageClock& stage);
  bool correct(Estimate& estimate);
  void update_map(Estimate& estimate, StageClock& stage);
  void maintain_maps(Estimate& estimate);
  int count_frames(const Tick& tick);
  void assess(Estimate& estimate, int frames);
  void relocate(Estimate& estimate, bool corrected);
  void search_around_last_pose(Estimate& estimate);
  void report(Estimate& estimate) const;
  void refresh_entropy(Estimate& estimate, double t) const;
  void update_poses(Estimate& estimate) const;
  const AnyMotion& motion_of(const FeatureTracker& camera) const {
    return settings_.bodies[camera.camera().body].motion;
  }

  EstimatorSettings settings_;
  std::vector<FeatureTracker> cameras_;
  std::vector<FeatureTracker::Start> starts_;                ///< of each camera, until the start
  std::vector<std::optional<PositionReading>> first_fixes_;  ///< of each body that starts at one
  std::optional<double> image_t_;                            ///< s, of the last image
  double image_period_s_ = 1;  ///< between the last two images; assumed before the second
  int missed_frames_ = 0;      ///< since the last image, at that period
  Inliers inliers_;
  std::vector<LinearizedMeasurement> measurements_;  ///< workspace: inliers of images, then of points
};

}  // namespace incognita
