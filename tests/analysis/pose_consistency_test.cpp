#include "incognita/analysis/evaluation/pose_consistency.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "incognita/math/quaternion.hpp"
#include "incognita/math/random.hpp"

namespace incognita {
namespace {

TEST(PoseError, IsExpressedInTheWorldAndInTheBody) {
  const StampedPose estimate{0, {1, 2, 3}, quaternion_exp<double>(Eigen::Vector3d(0.3, -2, 0.5))};
  const Eigen::Vector3d turn(0.01, -0.02, 0.03);
  const StampedPose truth{
      0, {1.1, 2, 2.8}, quaternion_product<double>(estimate.orientation, quaternion_exp(turn))};
  const PoseError error = pose_error(truth, estimate);
  EXPECT_TRUE(error.head<3>().isApprox(Eigen::Vector3d(0.1, 0, -0.2), 1e-12));
  EXPECT_TRUE(error.tail<3>().isApprox(turn, 1e-12)) << error.transpose();
}

TEST(PoseNees, MatchesAHandComputedValue) {
  PoseCovariance P = PoseCovariance::Identity();
  P(0, 0) = 4;
  PoseError e = PoseError::Zero();
  e[0] = 2;  // one sigma
  e[5] = 3;  // three sigma
  EXPECT_NEAR(*pose_nees(e, P), 10.0 / 6, 1e-12);
  P(2, 2) = 0;
  e[2] = 1e-9;  // error in a component with zero variance
  EXPECT_FALSE(pose_nees(e, P));
}

TEST(PoseNees, OmitsComponentsThatAreNotStates) {
  PoseCovariance P = PoseCovariance::Zero();
  P(0, 0) = P(1, 1) = P(5, 5) = 1;
  PoseError e = PoseError::Zero();
  e[0] = 2, e[5] = 1;
  EXPECT_NEAR(*pose_nees(e, P), 5.0 / 3, 1e-12);  // planar
  e.tail<3>().setConstant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_NEAR(*pose_nees(e, P), 4.0 / 2, 1e-12);  // planar, true heading unknown
  EXPECT_FALSE(pose_nees(PoseError::Zero(), PoseCovariance::Zero()));
  PoseCovariance line = PoseCovariance::Identity();  // positive definite only by rounding
  line(0, 1) = line(1, 0) = 1 - 1e-16;
  line(1, 1) = 1 + 4e-16;
  EXPECT_FALSE(pose_nees(PoseError::Zero(), line));
}

TEST(PoseNees, OfAFilterOnAPlaneOmitsTheHeightOfUnevenGround) {
  PoseCovariance P = PoseCovariance::Zero();
  P(0, 0) = P(1, 1) = P(5, 5) = 1;
  const PoseError e = (PoseError() << 2, 0, 0.3, 0.01, -0.02, 1).finished();
  EXPECT_NEAR(*pose_nees(e, P), 5.0 / 3, 1e-12);
  EXPECT_FALSE(beyond_three_sigma(e.head<3>(), P.topLeftCorner<3, 3>()));
  EXPECT_TRUE(beyond_three_sigma(2 * e.head<3>(), P.topLeftCorner<3, 3>())) << "4 sigma in x";
}

/// On uneven ground position and heading determine the other components: six errors with rank 3.
TEST(PoseNees, UsesPositionAndHeadingOnUnevenGround) {
  Eigen::Matrix<double, 6, 3> J;
  J << 1, 0, 0, 0, 1, 0, 0.2, -0.1, 0, 0.3, 0.1, 0, 0.1, 0.4, 0, 0, 0, 1;
  const Eigen::Vector3d state(0.02, -0.02, 0.01);
  const PoseCovariance P = 1e-4 * J * J.transpose();
  EXPECT_NEAR(*pose_nees(J * state, P), state.squaredNorm() / 1e-4 / 3, 1e-6);
  EXPECT_FALSE(beyond_three_sigma((J * state).head<3>(), P.topLeftCorner<3, 3>()));
  EXPECT_TRUE(beyond_three_sigma((J * state).head<3>() * 2, P.topLeftCorner<3, 3>()));
}

TEST(PoseNees, AveragesToOneForConsistentErrors) {
  RandomStream random(3, "nees");
  PoseCovariance root = PoseCovariance::Identity() * 0.1;
  root(1, 0) = 0.05;
  root(4, 2) = -0.08;
  const PoseCovariance P = root * root.transpose();
  double sum = 0;
  constexpr int runs = 4000;  // standard error sqrt(2/6/4000) = 0.009
  for (int i = 0; i < runs; ++i) {
    PoseError normal;
    for (double& value : normal) value = random.normal();
    sum += *pose_nees(root * normal, P);
  }
  EXPECT_NEAR(sum / runs, 1, 0.04);
}

TEST(BeyondThreeSigma, IsTheChiSquareQuantile) {
  const Eigen::Matrix3d P = 0.04 * Eigen::Matrix3d::Identity();
  EXPECT_FALSE(beyond_three_sigma({0.2 * 3.7624, 0, 0}, P));  // sqrt(14.1556)
  EXPECT_TRUE(beyond_three_sigma({0.2 * 3.7626, 0, 0}, P));   // sqrt(14.1572)
  EXPECT_TRUE(beyond_three_sigma({1e-9, 0, 0}, Eigen::Matrix3d::Zero()));
  EXPECT_FALSE(beyond_three_sigma({0, 0, 0}, Eigen::Matrix3d::Zero()));
  const Eigen::Matrix3d flat = Eigen::Vector3d(0.04, 0.04, 0).asDiagonal();
  EXPECT_FALSE(beyond_three_sigma({0.2 * 3.439, 0, 0}, flat));  // sqrt(11.829)
  EXPECT_TRUE(beyond_three_sigma({0.2 * 3.440, 0, 0}, flat));
}

TEST(MeanPoseNees, UsesOnlyCovariancesWithTheSameStamp) {
  const StampedPose truth{1, {1, 0, 0}, {1, 0, 0, 0}}, later{2, {1, 0, 0}, {1, 0, 0, 0}};
  const StampedPose first{1, {0, 0, 0}, {1, 0, 0, 0}}, second{2, {0, 0, 0}, {1, 0, 0, 0}};
  const MatchedTrajectories matched{{first, second}, {truth, later}};
  EXPECT_NEAR(mean_pose_nees(matched, {{2, PoseCovariance::Identity()}})->value, 1.0 / 6, 1e-12);
  EXPECT_FALSE(mean_pose_nees(matched, {{3, PoseCovariance::Identity()}}));
}

}  // namespace
}  // namespace incognita
