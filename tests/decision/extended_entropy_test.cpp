// The entropy of a map of fixed dimension: Figure 6.3.
#include "incognita/decision/extended_entropy.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "incognita/math/gaussian.hpp"
#include "incognita/math/random.hpp"
#include "incognita/models/motion/heading.hpp"

namespace incognita {
namespace {

Eigen::MatrixXd some_covariance(int size) {
  RandomStream random(5, "test");
  Eigen::MatrixXd root(size, size + 2);
  for (int j = 0; j < root.cols(); ++j)
    for (int i = 0; i < size; ++i) root(i, j) = random.normal();
  return root * root.transpose();
}

TEST(ExtendedEntropy, IsThatOfTheGivenTransformation) {
  const Eigen::MatrixXd P = some_covariance(12 + 3 + 6);
  const Eigen::MatrixXd transforms = some_covariance(6).topRows(3);
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(18, 21);
  J.topLeftCorner(15, 15).setIdentity();
  J.bottomRightCorner(3, 6) = transforms;
  const double expected = gaussian_entropy(log_det(J * P * J.transpose()), 18);
  const BlockMatrix camera = BlockMatrix::Identity(12, 12), point = BlockMatrix::Identity(3, 3);
  EXPECT_NEAR(entropy_of(P, {{0, camera}, {12, point}, {15, transforms}}), expected, 1e-9);
  EXPECT_NEAR(entropy_of(P, {{15, transforms}, {0, camera}, {12, point}}), expected, 1e-9) << "in any order";
  EXPECT_TRUE(std::isnan(entropy_of(-P, {{0, camera}})));
}

Estimate camera_alone() {
  Estimate e;
  CameraState x = CameraState::Zero();
  x.segment<4>(3) = level_gaze(0);
  e.bodies.emplace_back().block =
      e.belief.add_vehicle(FreeCameraMotion::chart, x, 1e-2 * FreeCameraMotion::Jacobian::Identity());
  e.started = true;
  return e;
}

TEST(ExtendedEntropy, ALandmarkAsUncertainAsItsPriorGainsNothing) {
  ExplorationSettings exploration;
  exploration.expected_landmarks = 4;
  exploration.variance_expected_m2 = 1.5;
  Estimate e = camera_alone();
  const double before = extended_entropy(e, exploration).value();
  Landmark landmark{};
  landmark.block =
      e.belief.augment(PointLandmark::chart, Eigen::Vector3d(1, 2, 3), {}, 1.5 * Eigen::Matrix3d::Identity());
  e.landmarks[0] = landmark;
  EXPECT_NEAR(extended_entropy(e, exploration).value(), before, 1e-9);
  landmark.block = e.belief.augment(PointLandmark::chart, Eigen::Vector3d(1, 2, 3), {},
                                    0.015 * Eigen::Matrix3d::Identity());
  e.landmarks[1] = landmark;
  EXPECT_NEAR(extended_entropy(e, exploration).value(), before - 1.5 * std::log(100), 1e-9);
  exploration.expected_landmarks = 1;
  EXPECT_FALSE(extended_entropy(e, exploration)) << "more are mapped: another dimension";
}

}  // namespace
}  // namespace incognita
