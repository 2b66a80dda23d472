// Covariance of a body and of the landmarks around it after measurements that are only imagined.
//
// The joint covariance of the body and of some landmarks of the map follows the Kalman filter along a plan, so that
// correlations count: a drift that all of them share is not reduced by looking at them again. Landmarks that are
// expected and not mapped yet are independent of each other given the path, whose uncertainty is noise of their
// measurements.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "incognita/decision/exploration.hpp"
#include "incognita/decision/predicted_measurement.hpp"
#include "incognita/slam/mapper/estimate.hpp"

namespace incognita {

class StateArchive;

/// Constant during one comparison of plans.
class PlannedMap {
 public:
  /// Takes the body and those landmarks of the map. `expected_var_m2`: variance of each coordinate of an expected landmark.
  /// `others`, 0 or more: of the other point landmarks at most that many, evenly, which stand for all of them, since an error that
  /// the whole map shares counts for each of its landmarks; ours.
  void start(const Estimate& estimate, std::size_t body, std::span<const BlockId> landmarks,
             double expected_var_m2, int others = 0);

  /// Leaves out landmarks whose estimate has moved, or has another form, since start(). Their measurements, predicted at the new
  /// estimate, are inconsistent with the old covariance: they would seem to constrain the heading of the whole map.
  void leave_out_moved(const Estimate& estimate);

  /// First row of a landmark's errors in the joint covariance; -1: it was not taken, or has moved.
  int row_of(BlockId block) const;
  int body_errors() const { return body_errors_; }
  const Eigen::MatrixXd& covariance() const { return covariance_; }
  double expected_var_m2() const { return expected_var_m2_; }

  struct Taken {
    BlockId block = 0;
    int row = 0, errors = 0;
    Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 6> J;  ///< d(position) / d(errors)
    Eigen::Vector3d position{0, 0, 0};                    ///< world, m
    bool moved = false;                                   ///< since then
    double weight = 1;                                    ///< landmarks of the map that it stands for
  };
  const std::vector<Taken>& taken() const { return taken_; }
  /// Saves or restores: math/saved_state/.
  void state(StateArchive& archive);

 private:
  void take(const Estimate& estimate, const Landmark& landmark, double weight);
  int rows() const { return taken_.empty() ? body_errors_ : taken_.back().row + taken_.back().errors; }

  int body_errors_ = 0;
  double expected_var_m2_ = 0;
  std::vector<Taken> taken_;
  Eigen::MatrixXd covariance_;
};

/// What information is worth: none beyond these standard deviations.
struct Resolution {
  double position_m = 0.025;  ///< of a landmark and of the body, per coordinate
  double angle_rad = 0.01;    ///< of the body
};

class ImaginedMap {
 public:
  explicit ImaginedMap(const PlannedMap& map);

  /// Motion of the body: error after = A * error before + noise of covariance N.
  void predict(const BlockMatrix& A, const BlockMatrix& N);
  /// EKF update by all of them at once. Measurements of landmarks that were not taken are left out.
  void update(const PlannedMap& map, std::span<const PredictedMeasurement> measurements);

  /// Information about the landmarks, about each as if it were alone, gained since the start, to that resolution, nats.
  double about_map(const PlannedMap& map, const Resolution& resolution) const;
  /// The same about the expected landmarks, each times the probability that it is there.
  double about_expected(const PlannedMap& map, std::span<const ExpectedLandmark> expected,
                        const Resolution& resolution) const;
  /// Information about an expected landmark that is still to be gained, nats: the decrease of its entropy down to that of a point at
  /// `way` (world, m) from the body, whose pose error it shares: cov = J P_pose J', J = [I, -[way]x R]; ours. `R`: world_from_body,
  /// in whose axes the orientation errors are.
  double missing_about(const PlannedMap& map, int expected_index, const Eigen::Vector3d& way,
                       const Eigen::Matrix3d& R, const Resolution& resolution) const;
  /// Saves or restores: math/saved_state/.
  void state(StateArchive& archive);
  struct Expected {
    int index;
    Eigen::Matrix3d P;
  };

  /// Entropy of the pose of the body, to that resolution, nats: not of its velocities.
  double entropy_of_pose(const Resolution& resolution) const;

 private:
  void update_known(const PlannedMap& map, std::span<const PredictedMeasurement> measurements);
  void update_expected(const PredictedMeasurement& measurement, double var_m2);

  Eigen::MatrixXd P_;               ///< of the body, then of the landmarks taken
  std::vector<Expected> expected_;  ///< those measured so far, by index
};

}  // namespace incognita
