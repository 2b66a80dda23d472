// Expected information gain along a predicted path: mutual information between state and measurements, thesis (6.6).
//
// The thesis takes determinants of the full covariance. By the matrix determinant lemma the same value is
// (log|S| - log|R|)/2 with S the covariance of the predicted measurements, which is small, does not
// underflow, and needs no posterior (tested equal on small maps). For a path of several steps the
// measurements of all steps are stacked: S and its Cholesky factor grow by the rows of each step, so that
// paths with a common beginning share its computation (push, pop).
#pragma once

#include <Eigen/Core>
#include <vector>

#include "incognita/belief/any_belief.hpp"
#include "incognita/decision/metric.hpp"
#include "incognita/decision/predicted_measurement.hpp"

namespace incognita {

class InformationGain {
 public:
  /// Starts at the current belief, with no step taken. `belief` must not change until the next start().
  void start(const AnyBelief& belief, BlockId vehicle);

  /// Appends one step. Throws std::invalid_argument if rows, Jacobians or blocks do not fit the belief.
  void push(const ImaginedStep& step);
  /// Removes the last step.
  void pop();
  int steps() const { return static_cast<int>(steps_.size()); }

  /// Value in the unit of the metric: nats, or for the Fisher traces the sum of inverse squares of m, rad etc.
  double of(Metric metric, int position_errors, const BlockMatrix& vehicle_given_map) const;

  /// I(X; Z) in nats over all steps: X is the full state, now and along the path. 0 without measurements; NaN
  /// if S is not positive definite.
  double of_state() const { return gain_; }
  /// I(X_v; Z): only the vehicle, at the end of the path (end of thesis 6.1.1).
  double of_vehicle() const;
  /// I(X_p, M; Z): the vehicle's first `kept` errors at the end of the path, and the map (thesis 6.3.2);
  /// `kept` = 0: only the map. Computed by the chain rule: the information about the remaining errors given
  /// those and the map is subtracted. `vehicle_given_map`: see vehicle_given_map(). For paths of one step,
  /// else throws std::logic_error; throws std::invalid_argument if the vehicle has fewer errors.
  double of_position_and_map(int kept, const BlockMatrix& vehicle_given_map) const;

  /// Sum of trace(H' S_i^-1 H) over the measurements of the last step, thesis (6.8), with S_i the innovation
  /// covariance of each measurement on its own; mixes units, as printed in the thesis.
  double fisher_trace() const;
  /// The same with R in place of S: the Fisher information of the measurements given the state.
  double fisher_trace_given_state() const;

 private:
  struct Known {  ///< a landmark measured on the path
    PredictedMeasurement::Of of;
    std::int64_t id;  ///< block, or index of the unmapped landmark
    int column;       ///< first column of its errors in P_
    int size;
  };
  struct Step {
    int rows_before, columns_before;
    std::size_t known_before;
    double gain_before;
    BlockMatrix A_total;  ///< transition from now to the end of the step
    BlockMatrix A;        ///< transition of this step
    BlockMatrix N_total;  ///< accumulated motion noise at the end of the step
    Eigen::MatrixXd Hv;   ///< stacked, rows of the step x vehicle errors
    double log_det_R = 0;
    std::vector<PredictedMeasurement> measurements;
    std::vector<int> columns;  ///< first columns of their landmarks in P_; -1 for an anchor
  };

  void begin(int vehicle_errors);
  BlockMatrix covariance(const Known& a, const Known& b) const;
  int column_of(const PredictedMeasurement& measurement);
  void add_landmark_columns(const PredictedMeasurement& measurement, int size);
  void apply_measurements(Step& step);
  void fill_rows(const Step& step);
  void add_landmarks(const Step& of, int first, int rows);
  void add_noise(const Step& step);
  void factorize(const Step& step);
  BlockMatrix vehicle_now() const;

  const AnyBelief* belief_ = nullptr;
  BlockId vehicle_ = 0;
  int vehicle_errors_ = 0;

  std::vector<Known> known_;
  std::vector<Step> steps_, spare_;  ///< popped steps, kept for their storage
  Eigen::MatrixXd P_;                ///< covariance of the current vehicle and the measured landmarks
  Eigen::MatrixXd Hv_;               ///< Jacobian of all measurements with respect to the current vehicle
  Eigen::MatrixXd PvH_;              ///< cov(current vehicle, all measurements), without motion noise
  Eigen::MatrixXd S_;                ///< covariance of all measurements
  Eigen::MatrixXd L_;                ///< lower Cholesky factor of S_
  Eigen::MatrixXd PH_;               ///< cov(all in P_, measurements of a step)
  int rows_ = 0, columns_ = 0;
  double gain_ = 0;
};

/// Covariance of a vehicle given the map: P_v - P_vm P_m^-1 P_mv. Cost is cubic in the size of the map.
BlockMatrix vehicle_given_map(const AnyBelief& belief, BlockId vehicle);

}  // namespace incognita
