// What the looks along an imagined path would teach: mutual information between the state and the
// measurements, thesis (6.6).
//
// The thesis takes determinants of the whole covariance. By the matrix determinant lemma the same number is
// (log|S| - log|R|)/2 with S the covariance of the expected measurements, which is as small as they are few,
// does not underflow, and needs no posterior (tested equal on small maps). Along a path of several steps the
// measurements of all steps are stacked: S grows by the rows of each step, and its factor with it, so that
// paths that begin alike share what they have in common (push, pop).
#pragma once

#include <Eigen/Core>
#include <vector>

#include "incognita/belief/any_belief.hpp"
#include "incognita/decision/predicted_measurement.hpp"

namespace incognita {

class InformationGain {
 public:
  /// Begins at the present belief, with no step taken. `belief` must stay as it is until the next start.
  void start(const Belief& belief, BlockId vehicle);
  void start(const AnyBelief& belief, BlockId vehicle);

  /// Goes on by one step. `rows`, Jacobians and blocks must fit the belief: std::invalid_argument otherwise.
  void push(const ImaginedStep& step);
  /// Takes the last step back.
  void pop();
  int steps() const { return static_cast<int>(steps_.size()); }

  /// I(X; Z) in nats of all steps so far: whole state, X as it is now and as it moves. 0 without looks; not a
  /// number where S is not positive definite.
  double of_state() const { return gain_; }
  /// I(X_v; Z): the vehicle alone, at the end of the path (end of thesis 6.1.1).
  double of_vehicle() const;
  /// I(X_p, M; Z): the vehicle's first `kept` errors at the end of the path, and the map (thesis 6.3.2); with
  /// 0 of the map alone. By the chain rule: what the rest would learn were those known is taken off.
  /// `vehicle_given_map`: covariance of the vehicle were the map known, see vehicle_given_map(). Of paths of
  /// one step: std::logic_error otherwise; std::invalid_argument where the vehicle has not so many errors.
  double of_position_and_map(int kept, const BlockMatrix& vehicle_given_map) const;

  /// Sum over the looks of the last step of the trace of H' S_i^-1 H, thesis (6.8), with S_i the covariance
  /// of each look alone; units are mixed, as printed.
  double fisher_trace() const;
  /// The same with R in place of S: the Fisher information of the looks, given the state.
  double fisher_trace_given_state() const;

 private:
  struct Known {  ///< a landmark that the path has looked at
    PredictedMeasurement::Of of;
    std::int64_t id;  ///< block, or which of the unseen
    int column;       ///< of its errors in P_
    int size;
  };
  struct Step {
    int rows_before, columns_before;
    std::size_t known_before;
    double gain_before;
    BlockMatrix A_total;  ///< from now to the end of the step
    BlockMatrix A;        ///< of the step
    BlockMatrix N_total;  ///< noise gathered up to the end of the step
    Eigen::MatrixXd Hv;   ///< of its looks, stacked
    double log_det_R = 0;
    std::vector<PredictedMeasurement> measurements;
    std::vector<int> columns;  ///< of their landmarks' errors in P_; -1 for an anchor
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

  const Belief* belief_ = nullptr;
  const AnyBelief* any_ = nullptr;
  BlockId vehicle_ = 0;
  int vehicle_errors_ = 0;

  std::vector<Known> known_;
  std::vector<Step> steps_, spare_;  ///< taken back, kept for their storage
  Eigen::MatrixXd P_;                ///< covariance of the vehicle now and of what was looked at
  Eigen::MatrixXd Hv_;               ///< all looks by the vehicle now
  Eigen::MatrixXd PvH_;              ///< covariance of the vehicle now and all looks, noise on the way aside
  Eigen::MatrixXd S_;                ///< covariance of all looks
  Eigen::MatrixXd L_;                ///< its lower factor
  Eigen::MatrixXd PH_;               ///< covariance of all in P_ and the looks of a step
  int rows_ = 0, columns_ = 0;
  double gain_ = 0;
};

/// Covariance of a vehicle were the map known: P_v - P_vm P_m^-1 P_mv. Cubic in the map.
BlockMatrix vehicle_given_map(const Belief& belief, BlockId vehicle);
BlockMatrix vehicle_given_map(const AnyBelief& belief, BlockId vehicle);

}  // namespace incognita
