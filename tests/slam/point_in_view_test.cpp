// A landmark of the belief as a point in inverse depth of a view: its value against geometry, its deviation against numeric
// derivatives.
#include "incognita/slam/bundle/point_in_view.hpp"

#include "tests/slam/synthetic_scene.hpp"

namespace incognita::synthetic {
namespace {

const CameraState host = camera_at({0.3, -0.2, 1.1}, 0.2, {0.1, -0.05, 0.3});

Landmark point_at(Estimate& estimate, const Eigen::Vector3d& position) {
  Landmark landmark;
  landmark.block = estimate.belief.augment(
      PointLandmark::chart, position, {{{estimate.body().block, 0.3 * Eigen::Matrix<double, 3, 12>::Ones()}}},
      0.04 * Eigen::Matrix3d::Identity());
  return landmark;
}

Landmark inverse_depth_at(Estimate& estimate, double inverse_depth) {
  const CameraState from = camera_at({-0.4, 0.1, 0.9}, -0.1, {0, 0.1, 0});
  InverseDepthLandmark::State y;
  y << from.head<3>(), 0.1, -0.2, inverse_depth;
  Landmark landmark;
  landmark.form.kind = Kind::inverse_depth;
  landmark.form.initial_axes = from.segment<4>(3);
  landmark.block = estimate.belief.augment(
      InverseDepthLandmark::chart, y, {{{estimate.body().block, 0.2 * Eigen::Matrix<double, 6, 12>::Ones()}}},
      0.01 * Eigen::Matrix<double, 6, 6>::Identity());
  return landmark;
}

/// The same landmark and body, moved by an error: 12 of the body, then those of the landmark.
double moved_inverse_depth(const Estimate& estimate, const Landmark& landmark, const Eigen::VectorXd& error) {
  AnyBelief belief = estimate.belief;
  const BlockId body = estimate.body().block;
  const CameraState x =
      plus(FreeCameraMotion::chart, CameraState(belief.mean(body)), error.head<12>().eval());
  belief.set_mean(body, x);
  belief.set_mean(landmark.block, belief.mean(landmark.block) + error.tail(error.size() - 12));
  return point_in_view(landmark, belief, view_of(x)).value().z();
}

void expect_sigma(const Estimate& estimate, const Landmark& landmark, int errors) {
  const Eigen::MatrixXd J = numeric_jacobian(12 + errors, 1e-6, [&](const Eigen::VectorXd& e) {
    return Eigen::VectorXd::Constant(1, moved_inverse_depth(estimate, landmark, e));
  });
  const BlockId body = estimate.body().block;
  Eigen::MatrixXd P(12 + errors, 12 + errors);
  P << Eigen::MatrixXd(estimate.belief.covariance(body)),
      Eigen::MatrixXd(estimate.belief.covariance(body, landmark.block)),
      Eigen::MatrixXd(estimate.belief.covariance(landmark.block, body)),
      Eigen::MatrixXd(estimate.belief.covariance(landmark.block));
  const double expected = std::sqrt((J * P * J.transpose()).value());
  EXPECT_NEAR(sigma_inverse_depth_in_view(landmark, estimate.belief, body), expected, 1e-6 * expected);
}

TEST(PointInView, OfAPointIsWhereTheCameraSeesIt) {
  Estimate estimate = estimate_at(host, correlated_covariance(0.1, 1));
  const Eigen::Vector3d position(2.5, 0.3, 1.2);
  const Landmark landmark = point_at(estimate, position);
  const auto point = point_in_view(landmark, estimate.belief, view_of(host));
  ASSERT_TRUE(point);
  const Eigen::Vector3d along = PointLandmark::in_camera<double>(host, position);
  EXPECT_TRUE(point->isApprox(Eigen::Vector3d(along.x(), along.y(), 1) / along.z(), 1e-12));
}

TEST(PointInView, AtInfinityHasNoDepth) {
  Estimate estimate = estimate_at(host, correlated_covariance(0.1, 1));
  const auto point = point_in_view(inverse_depth_at(estimate, 0), estimate.belief, view_of(host));
  ASSERT_TRUE(point);
  EXPECT_EQ(point->z(), 0);
}

TEST(PointInView, IsNothingBehind) {
  Estimate estimate = estimate_at(host, correlated_covariance(0.1, 1));
  EXPECT_FALSE(point_in_view(point_at(estimate, {-3, 0, 1}), estimate.belief, view_of(host)));
}

TEST(PointInView, HasTheDeviationOfBothErrors) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    Estimate estimate = estimate_at(host, correlated_covariance(0.1, seed));
    expect_sigma(estimate, point_at(estimate, {2.5, 0.3, 1.2}), 3);
    expect_sigma(estimate, point_at(estimate, {0.8, -0.1, 1.1}), 3);
    for (const double inverse_depth : {1e-9, 0.5, 1.0})
      expect_sigma(estimate, inverse_depth_at(estimate, inverse_depth), 6);
  }
}

}  // namespace
}  // namespace incognita::synthetic
