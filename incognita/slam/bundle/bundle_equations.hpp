// The normal equations of a bundle, linearized at its values, and their solution with the landmarks eliminated.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <optional>
#include <vector>

#include "incognita/models/sensors/camera.hpp"
#include "incognita/slam/bundle/bundle.hpp"

namespace incognita {

/// Weight of a measurement whose normalized error exceeds `limit_sigmas` (Huber): as if its error were constant from there.
struct RobustCost {
  double limit_sigmas = 3;
  double cost(double squared_sigmas) const;    ///< half the squared error of an inlier
  double weight(double squared_sigmas) const;  ///< of its equations, 1 for an inlier
};

/// Where a measurement is predicted, px; nothing for a point that is not in front of the camera.
std::optional<Eigen::Vector2d> predicted_pixel(const Bundle& bundle, const BundleObservation& observation,
                                               const Camera& camera);

/// Cost of a bundle: the sum over its measurements and priors. A point that is not in front of a camera costs as much as
/// an error of 100 sigma.
double cost_of(const Bundle& bundle, const Camera& camera, const RobustCost& robust);

class BundleEquations {
 public:
  using Block6x3 = Eigen::Matrix<double, 6, 3>;

  /// Linearizes all measurements. Jacobians are of the models of camera_measurement.hpp.
  void linearize(const Bundle& bundle, const Camera& camera, const RobustCost& robust);

  /// Eliminates the landmarks (Schur complement), with the diagonal of the equations increased by the factor
  /// 1 + `damping`. False when the equations are not positive definite: some pose is not determined.
  bool factorize(double damping);

  /// The step that minimizes the damped equations, after factorize().
  void solve();
  /// Of any view: zero if it is fixed.
  Eigen::Matrix<double, 6, 1> view_step(int view) const;
  const Eigen::Vector3d& point_step(int point) const { return point_steps_[static_cast<std::size_t>(point)]; }

 private:
  struct Coupling {
    int view = 0, row = 0;  ///< a view that is not fixed, and its first row in the equations
    Block6x3 H;             ///< second derivative by the errors of the view and of the point
  };
  struct PointTerms {
    Eigen::Matrix3d H = Eigen::Matrix3d::Zero();
    Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
    int first = 0, count = 0;  ///< of its couplings
    bool estimated = false;
  };

  void add_measurement(const Bundle& bundle, const BundleObservation& observation, const Camera& camera,
                       const RobustCost& robust);
  void add_priors(const Bundle& bundle);
  Coupling& coupling(PointTerms& terms, int view);

  std::vector<int> rows_;  ///< first row of each view; -1: fixed
  std::vector<PointTerms> points_;
  std::vector<Coupling> couplings_;
  Eigen::MatrixXd H_views_;  ///< lower triangle
  Eigen::VectorXd gradient_views_;

  std::vector<Eigen::Matrix3d> inverse_points_;  ///< of the damped blocks
  Eigen::LLT<Eigen::MatrixXd> reduced_;
  Eigen::VectorXd view_steps_;
  std::vector<Eigen::Vector3d> point_steps_;
};

}  // namespace incognita
