// SLAM for programs that have their own loop: they add what their sensors measure, when it comes, and read the estimate.
//
//   Navigator navigator(SlamEstimator(settings));
//   navigator.add_odometry(speed_and_turn_rate, t);
//   navigator.add_detections(detections, t);
//   const BodyPose pose = navigator.pose();
//
// Times are in seconds on any one clock and must not be before the estimate's. Odometry and position fixes are kept, each in
// time order, and used at their own times by the call that advances the estimate beyond them: add_image(),
// add_detections() or advance().
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "incognita/decision/strategy.hpp"
#include "incognita/slam/estimator/slam_estimator.hpp"

namespace incognita {

/// A gray image in the caller's memory, 8 bits per pixel, rows from top to bottom. Its pixels are copied once, since the
/// search reads some bytes beyond the last pixel.
struct ImageView {
  const std::uint8_t* pixels = nullptr;
  int width = 0, height = 0;
  std::ptrdiff_t stride = 0;  ///< bytes from one row to the next
};

/// Pose of a body in the world with the covariance of its error: position (m), right rotation error (rad).
struct BodyPose {
  RigidPose pose;
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
};

/// A mapped landmark in the world, m and m^2; on a plane or a line the missing coordinates are 0 with zero covariance.
struct MappedLandmark {
  std::int64_t id = 0;
  bool anchor = false;  ///< at a known position
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
};

class Navigator {
 public:
  explicit Navigator(SlamEstimator estimator);

  // Measurements. All throw std::invalid_argument for a body or a sensor that does not exist, for a time that is not finite or
  // before the estimate's, and for a measurement that the model of the body does not use.

  /// `input`: as the motion model of the body takes it, e.g. m/s and rad/s; held until the next.
  void add_odometry(const Eigen::Vector2d& input, double t, std::size_t body = 0);
  /// Position of the body, m, from an external sensor such as GPS.
  void add_fix(const Eigen::Vector2d& position, double t, std::size_t body = 0);
  /// Advances the estimate to the image. Throws std::invalid_argument for an image of another size than the camera's.
  const TrackingStatus& add_image(const ImageView& image, double t, std::size_t body = 0,
                                  std::size_t camera = 0);
  /// Advances the estimate to the detections of landmarks, and of other bodies by their index.
  const TrackingStatus& add_detections(std::vector<PointDetection> landmarks, double t, std::size_t body = 0,
                                       std::vector<PointDetection> bodies = {});
  /// Predicts the bodies to a time, with the odometry and fixes until then.
  const TrackingStatus& advance(double t);
  /// The command that is executed from now on, for bodies that are predicted by it.
  void set_command(const Command& command) { command_ = command; }

  // The estimate

  /// Of the body that is worst.
  const TrackingStatus& status() const { return estimate_.status; }
  /// Of one body. Throws std::logic_error before the start.
  const TrackingStatus& status(std::size_t body) const { return started(body).status; }
  /// Throws std::logic_error before the start; see status().
  BodyPose pose(std::size_t body = 0) const;
  std::vector<MappedLandmark> landmarks() const;
  const Estimate& estimate() const { return estimate_; }

  /// The next action by a strategy, e.g. the most informative one.
  Goal choose(Strategy& strategy) const;

 private:
  BodyObservation& pending(std::size_t body, double t);
  const Body& started(std::size_t body) const;

  SlamEstimator estimator_;
  Estimate estimate_;
  Observation pending_;  ///< since the last tick
  Command command_;
  Tick tick_;
};

}  // namespace incognita
