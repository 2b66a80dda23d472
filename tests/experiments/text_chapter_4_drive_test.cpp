// The simulated vehicle that maps by bearings: its errors, the covariance at the truth, what the modes share.
#include "experiments/text_chapter_4_drive.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "incognita/analysis/evaluation/statistics.hpp"
#include "incognita/models/sensors/bearing.hpp"

namespace incognita::bearing_drive {
namespace {

using Eigen::MatrixXd, Eigen::Vector2d, Eigen::Vector3d, Eigen::VectorXd;

Drive arc_by_two_features() {
  Drive d;
  d.features = {{20, 0}, {12, 12}};
  d.input = [](double t_s) { return t_s < 2 ? Vector2d(0, 0) : Vector2d(0.5, 0.25); };
  return d;
}

TEST(BearingDriveTest, IsConsistentWhereItIsNearlyLinear) {
  Drive d = arc_by_two_features();
  d.unknowns = {0.02, radians(0.2), 0.1};
  d.noise = {0.005, 0.002, 0.005};
  constexpr int runs = 100;
  std::vector<double> nees;
  for (std::uint64_t seed = 1; seed <= runs; ++seed) nees.push_back(drive(d, {8}, seed)[0].nees());
  const Interval band = nees_band(runs, 7, 0.999);
  EXPECT_TRUE(band.contains(mean_of(nees).value)) << mean_of(nees).value;
}

TEST(BearingDriveTest, AllModesDriveTheSameWay) {
  Drive d = arc_by_two_features();
  const auto pose = [&](Linearized linearized) {
    d.linearized = linearized;
    return drive(d, {5}, 7)[0].pose;
  };
  const Vector3d ekf = pose(Linearized::at_estimates);
  EXPECT_EQ(pose(Linearized::at_first_estimates), ekf);
  EXPECT_EQ(pose(Linearized::at_truth), ekf);
  EXPECT_GT(ekf.head<2>().norm(), 1);
}

TEST(BearingDriveTest, MomentsDoNotDependOnEachOther) {
  const Drive d = arc_by_two_features();
  const auto both = drive(d, {1, 4}, 3);
  EXPECT_EQ(both[1].error, drive(d, {4}, 3)[0].error);
  EXPECT_EQ(both[0].t_s, 1);
}

/// The first information, of pose and feature, and that of n measurements at rest.
MatrixXd information_at_rest(const Drive& d, int n) {
  const Unknowns& u = d.unknowns;
  const VectorXd sigmas = Vector3d(u.sigma_position_m, u.sigma_position_m, u.sigma_heading_rad);
  MatrixXd Y = MatrixXd::Zero(5, 5);
  Y.topLeftCorner(3, 3) = sigmas.cwiseAbs2().cwiseInverse().asDiagonal();
  const Vector2d f = d.features[0];
  const auto h = Bearing::predict_measurement(Vector3d::Zero(), f).value();
  VectorXd bearing(5), distance(5);
  bearing << h.Hv.transpose(), h.Hl.transpose();
  distance << -f.normalized(), 0, f.normalized();
  Y += (n + 1) * std::pow(d.noise.sigma_bearing_rad, -2) * bearing * bearing.transpose();  // one placed it
  return Y + std::pow(u.sigma_distance_m, -2) * distance * distance.transpose();
}

TEST(BearingDriveTest, CovarianceAtTheTruthIsTheInverseOfTheInformation) {
  Drive d;
  d.features = {{15, 5}};
  d.input = [](double) { return Vector2d(0, 0); };
  d.linearized = Linearized::at_truth;
  const Moment m = drive(d, {2}, 1)[0];
  EXPECT_TRUE(m.error.isZero());
  EXPECT_LT((m.covariance * information_at_rest(d, 21) - MatrixXd::Identity(5, 5)).cwiseAbs().maxCoeff(),
            1e-6);
}

TEST(BearingDriveTest, NothingIsLearnedOfADistanceAtRest) {
  Drive d = arc_by_two_features();
  d.input = [](double) { return Vector2d(0, 0); };
  d.linearized = Linearized::at_truth;
  const Moment m = drive(d, {10}, 1)[0];
  for (const int feature : {0, 1}) {
    const VectorXd c = away(d, m, feature);
    EXPECT_NEAR(std::sqrt(c.dot(m.covariance * c)), d.unknowns.sigma_distance_m, 1e-6);
  }
}

}  // namespace
}  // namespace incognita::bearing_drive
