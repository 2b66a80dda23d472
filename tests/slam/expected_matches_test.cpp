// Which landmarks are searched for, where, and with which innovation covariance: S = H P H' + R (thesis C.2).
#include <gtest/gtest.h>

#include <algorithm>

#include "incognita/slam/features/predict_matches.hpp"
#include "tests/slam/synthetic_scene.hpp"

namespace incognita {
namespace {

using namespace synthetic;

const Wall wall(2);
const CameraState origin = camera_at({0, 0, 0});

std::vector<FeatureMatch> predicted(const Estimate& estimate, const CameraSlamSettings& settings = {}) {
  std::vector<FeatureMatch> matches;
  predict_matches(estimate, camera, settings, matches);
  return matches;
}

/// A camera with every correlation and one landmark each: anchor, point, inverse depth, line.
Estimate one_of_each(const CameraSlamSettings& settings) {
  Estimate estimate = estimate_at(origin, correlated_covariance(0.01, 4));
  const Image image = wall.seen_from(origin);
  const Eigen::Vector3d at = wall.point_at(origin, {100, 80});
  add_point(estimate, image, origin, at, at, 0.02, settings).kind = Landmark::Kind::anchor;
  estimate.belief.drop(estimate.catalog.back().block);
  estimate.catalog.back().anchor = at;
  const Eigen::Vector3d other = wall.point_at(origin, {200, 100});
  add_point(estimate, image, origin, other, other, 0.02, settings);
  CameraSlamSettings changed = settings;
  EXPECT_TRUE(initialize_landmark(image, {150, 140}, estimate, camera, changed));
  changed.initialization.method = InitializationSettings::Method::depth_line;
  EXPECT_TRUE(initialize_landmark(image, {120, 160}, estimate, camera, changed));
  return estimate;
}

/// The pixel of a landmark from errors of the camera (12) and the landmark's own.
Eigen::VectorXd pixel_with(const Estimate& estimate, const Landmark& landmark,
                           const Eigen::VectorXd& errors) {
  const CameraState x =
      plus(FreeCameraMotion::chart, estimate.camera_state(), Eigen::VectorXd(errors.head(12)));
  if (landmark.kind == Landmark::Kind::anchor) return pixel_of(x, landmark.anchor);
  const Eigen::VectorXd y =
      Eigen::VectorXd(estimate.belief.mean(landmark.block)) + errors.tail(errors.size() - 12);
  if (landmark.kind == Landmark::Kind::point) return pixel_of(x, y);
  return pixel_of(x, landmark.initial_axes.point(y).position);
}

TEST(ExpectedMatches, HaveTheInnovationCovarianceOfNumericPropagation) {
  CameraSlamSettings settings;
  settings.filter.sigma_pixel_px = 0.6;
  Estimate estimate = one_of_each(settings);
  move_camera(estimate, camera_at({0.1, 0.15, -0.05}, -0.03, {0.02, 0, 0.05}));
  const std::vector<FeatureMatch> matches = predicted(estimate, settings);
  ASSERT_EQ(matches.size(), 3u) << "a line has no depth: it is searched for elsewhere";
  for (const FeatureMatch& match : matches) {
    const Landmark& landmark = estimate.catalog[match.landmark];
    EXPECT_EQ(match.id, landmark.id);
    EXPECT_EQ(match.outcome, MatchOutcome::not_searched);
    const bool known = landmark.kind == Landmark::Kind::anchor;
    const int own = known ? 0 : estimate.belief.covariance(landmark.block).rows();
    const auto f = [&](const Eigen::VectorXd& e) { return pixel_with(estimate, landmark, e); };
    EXPECT_TRUE(match.predicted.isApprox(f(Eigen::VectorXd::Zero(12 + own)), 1e-9));
    const Eigen::MatrixXd H = numeric_jacobian(12 + own, 1e-6, f);
    Eigen::MatrixXd P(12 + own, 12 + own);
    P.topLeftCorner(12, 12) = estimate.belief.covariance(estimate.camera);
    if (!known) {
      P.bottomRightCorner(own, own) = estimate.belief.covariance(landmark.block);
      P.topRightCorner(12, own) = estimate.belief.covariance(estimate.camera, landmark.block);
      P.bottomLeftCorner(own, 12) = P.topRightCorner(12, own).transpose();
    }
    const Eigen::Matrix2d S = H * P * H.transpose() + 0.36 * Eigen::Matrix2d::Identity();
    EXPECT_TRUE(match.innovation_cov.isApprox(S, 1e-5)) << match.innovation_cov << "\nnumeric\n" << S;
  }
}

/// Whether the one landmark, first seen from the origin, is expected from here.
bool expected_from(const CameraState& from, const Eigen::Vector2d& first_seen = {160, 120},
                   const MapSettings& map = {}) {
  CameraSlamSettings settings;
  settings.map = map;
  Estimate estimate = estimate_at(origin, 1e-6 * CameraCov::Identity());
  const Eigen::Vector3d at = wall.point_at(origin, first_seen);
  add_point(estimate, wall.seen_from(origin), origin, at, at, 0.01, settings);
  move_camera(estimate, from);
  return predicted(estimate, settings).size() == 1;
}

TEST(ExpectedMatches, LieInTheImageAndBeforeTheCamera) {
  EXPECT_TRUE(expected_from(origin));
  EXPECT_FALSE(expected_from(camera_at({0, 0, 0}, M_PI))) << "behind";
  EXPECT_FALSE(expected_from(camera_at({0, 0, 0}, 0.8))) << "out of the image";
  const double near_edge_rad = std::atan((159.5 - 7) / 195);  // a patch and a pixel inside: the last one
  EXPECT_TRUE(expected_from(camera_at({0, 0, 0}, near_edge_rad - 0.005), {159.5, 119.5}));
  EXPECT_FALSE(expected_from(camera_at({0, 0, 0}, near_edge_rad + 0.005), {159.5, 119.5}));
}

TEST(ExpectedMatches, AreSeenAboutAsTheyWereAtFirst) {
  MapSettings map;
  map.max_scale = 1.8;
  EXPECT_TRUE(expected_from(camera_at({2 - 2 / 1.75, 0, 0}), {160, 120}, map));
  EXPECT_FALSE(expected_from(camera_at({2 - 2 / 1.85, 0, 0}), {160, 120}, map)) << "too near";
  EXPECT_TRUE(expected_from(camera_at({2 - 2 * 1.75, 0, 0}), {160, 120}, map));
  EXPECT_FALSE(expected_from(camera_at({2 - 2 * 1.85, 0, 0}), {160, 120}, map)) << "too far";
  map.max_view_angle_rad = 0.5;
  const auto aside = [](double angle) {  // on a circle around the landmark, looking at it
    return camera_at({2 - 2 * std::cos(angle), 2 * std::sin(angle), 0}, -angle);
  };
  EXPECT_TRUE(expected_from(aside(0.49), {159.5, 119.5}, map));
  EXPECT_FALSE(expected_from(aside(0.51), {159.5, 119.5}, map));
  EXPECT_TRUE(expected_from(camera_at({0, 0, 0}, 0.6), {159.5, 119.5}, map)) << "turned, not moved";
}

/// The map from pixels of this view to those of the first one, against the wall itself.
TEST(ExpectedMatches, WarpTheirPatchAsTheirPlaneIsSeen) {
  const Eigen::Vector2d first_seen(180, 100);
  const Eigen::Vector3d at = wall.point_at(origin, first_seen);
  Estimate estimate = estimate_at(origin, 1e-6 * CameraCov::Identity());
  add_point(estimate, wall.seen_from(origin), origin, at, at, 0.01, {});
  const CameraState from = camera_at({0.5, 0.4, 0.1}, -0.2, {0, 0, 0.3});
  move_camera(estimate, from);
  const auto measurements = predicted(estimate);
  ASSERT_EQ(measurements.size(), 1u);
  const Eigen::MatrixXd warp = numeric_jacobian(2, 1, [&](const Eigen::VectorXd& d) {
    return Eigen::VectorXd(pixel_of(origin, wall.point_at(from, measurements[0].predicted + d)));
  });
  EXPECT_TRUE(measurements[0].texture_from_view.isApprox(warp, 0.01))
      << measurements[0].texture_from_view << "\n"
      << warp;
}

}  // namespace
}  // namespace incognita
