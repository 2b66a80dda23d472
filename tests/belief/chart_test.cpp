// Means on manifolds: the update moves them along their charts.
#include <cmath>
#include <numbers>

#include "incognita/math/quaternion.hpp"
#include "tests/belief/dense.hpp"

namespace incognita::testing {
namespace {

const Chart planar_pose{{Chart::Kind::line, 2}, {Chart::Kind::angle, 1}};
const Chart spatial_pose{{Chart::Kind::line, 3}, {Chart::Kind::quaternion, 4}};

TEST(Charts, AngleIsWrappedWhenTheUpdateCrossesPi) {
  Belief belief;
  const BlockId robot = belief.add_vehicle(planar_pose, Eigen::Vector3d(1, 2, std::numbers::pi - 0.1),
                                           Eigen::Matrix3d::Identity());
  LinearizedMeasurement compass;
  compass.add(robot, Eigen::RowVector3d(0, 0, 1));
  compass.residual = MeasurementVector::Constant(1, 0.4);
  compass.R = MeasurementMatrix::Identity(1, 1);
  belief.update({&compass, 1});
  EXPECT_NEAR(belief.mean(robot)[2], -std::numbers::pi + 0.1, 1e-14);  // half of the residual, across pi
  EXPECT_EQ(belief.mean(robot)[0], 1);
}

TEST(Charts, RotationErrorIsInTheBodyFrameAndTheQuaternionStaysUnit) {
  Belief belief;
  const Eigen::Vector4d start = quaternion_exp<double>(Eigen::Vector3d(0.3, -1.1, 0.7));
  Eigen::VectorXd mean(7);
  mean << 1, 2, 3, start;
  const BlockId camera = belief.add_vehicle(spatial_pose, mean, Eigen::MatrixXd::Identity(6, 6));
  LinearizedMeasurement measurement;
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(3, 6);
  H.rightCols(3).setIdentity();
  measurement.add(camera, H);
  measurement.residual = Eigen::Vector3d(0.2, 0.5, -0.8);
  measurement.R = 3 * Eigen::Matrix3d::Identity();  // gain 1/4
  belief.update({&measurement, 1});
  const Eigen::Vector4d expected =
      quaternion_product<double>(start, quaternion_exp<double>(Eigen::Vector3d(0.05, 0.125, -0.2)));
  EXPECT_TRUE(close(belief.mean(camera).tail(4), expected, 1e-14));
  for (int i = 0; i < 10000; ++i) {
    belief.predict(
        {camera, belief.mean(camera), BlockMatrix::Identity(6, 6), 0.1 * BlockMatrix::Identity(6, 6)});
    belief.update({&measurement, 1});
  }
  EXPECT_NEAR(belief.mean(camera).tail(4).norm(), 1, 1e-14);
}

TEST(Charts, BlocksWithMoreStatesThanErrorsKeepTheirIndices) {
  RandomStream random(1, "places");
  Belief belief;
  Eigen::VectorXd pose(7);
  pose << 1, 2, 3, 1, 0, 0, 0;
  const BlockId camera = belief.add_vehicle(spatial_pose, pose, Eigen::MatrixXd::Identity(6, 6));
  const BlockId robot =
      belief.add_vehicle(planar_pose, Eigen::Vector3d(4, 5, 0.5), Eigen::Matrix3d::Identity());
  const Belief::Parent parent{camera, random_matrix(random, 6, 6)};
  const BlockId body = belief.augment(spatial_pose, pose, {&parent, 1}, Eigen::MatrixXd::Identity(6, 6));
  const BlockId point =
      belief.augment(Chart::line(3), Eigen::Vector3d(7, 8, 9), {}, Eigen::Matrix3d::Identity());
  EXPECT_EQ(belief.offset(point), 15);
  belief.replace(body, Chart::line(3), Eigen::Vector3d(-1, -2, -3), BlockMatrix::Identity(3, 6),
                 BlockMatrix::Zero(3, 3));
  EXPECT_EQ(belief.offset(point), 12);
  EXPECT_EQ(belief.mean(point), Eigen::Vector3d(7, 8, 9));
  EXPECT_EQ(belief.mean(body), Eigen::Vector3d(-1, -2, -3));
  belief.drop(camera);
  EXPECT_EQ(belief.mean(robot), Eigen::Vector3d(4, 5, 0.5));
  EXPECT_EQ(belief.mean(point), Eigen::Vector3d(7, 8, 9));
  EXPECT_EQ(belief.offset(point), 6);
  // The opposite case: the same number of errors, more states
  belief.replace(body, Chart{{Chart::Kind::quaternion, 4}}, Eigen::Vector4d(1, 0, 0, 0),
                 BlockMatrix::Identity(3, 3), BlockMatrix::Zero(3, 3));
  EXPECT_EQ(belief.mean(body), Eigen::Vector4d(1, 0, 0, 0));
  EXPECT_EQ(belief.mean(point), Eigen::Vector3d(7, 8, 9));
}

}  // namespace
}  // namespace incognita::testing
