// Which landmarks are searched for, where, and with which innovation covariance: S = H P H' + R (thesis C.2).
#include <gtest/gtest.h>

#include <algorithm>

#include "incognita/slam/features/predict_matches.hpp"
#include "tests/slam/synthetic_scene.hpp"

namespace incognita {
namespace {

using namespace synthetic;

const Wall wall(2);

std::vector<FeatureMatch> predicted(Tracking& t) {
  predict_matches(t.estimate, t.tracked);
  return t.tracked.matches;
}

/// A camera with every correlation and one landmark each: anchor, point, inverse depth, ray.
Tracking one_of_each(const CameraSlamSettings& settings) {
  Tracking t(origin, correlated_covariance(0.01, 4), settings);
  const Image image = wall.seen_from(origin);
  const Eigen::Vector3d at = wall.point_at(origin, {100, 80});
  add_anchor(at, cut_view(ImagePyramid(image), pixel_of(origin, at), origin, camera, settings).value(),
             t.estimate, t.tracked);
  const Eigen::Vector3d other = wall.point_at(origin, {200, 100});
  t.add_point(image, origin, other, other, 0.02);
  EXPECT_TRUE(t.initialize(image, {150, 140}));
  t.tracked.settings.initialization.method = InitializationSettings::Method::depth_line;
  EXPECT_TRUE(t.initialize(image, {120, 160}));
  return t;
}

/// The pixel of a landmark from errors of the camera (12) and the landmark's own.
Eigen::VectorXd pixel_with(const Estimate& estimate, const Landmark& landmark,
                           const Eigen::VectorXd& errors) {
  const CameraState x =
      plus(FreeCameraMotion::chart, estimate.camera_state(), Eigen::VectorXd(errors.head(12)));
  if (landmark.fixed) return pixel_of(x, landmark.position);
  const Eigen::VectorXd y =
      Eigen::VectorXd(estimate.belief.mean(landmark.block)) + errors.tail(errors.size() - 12);
  if (landmark.form.kind == Kind::point) return pixel_of(x, y);
  return pixel_of(x, axes_of(landmark).point(y).position);
}

TEST(ExpectedMatches, HaveTheInnovationCovarianceOfNumericPropagation) {
  CameraSlamSettings settings = few_features();
  settings.filter.sigma_pixel_px = 0.6;
  Tracking t = one_of_each(settings);
  const Estimate& estimate = t.estimate;
  t.move_to(camera_at({0.1, 0.15, -0.05}, -0.03, {0.02, 0, 0.05}));
  const std::vector<FeatureMatch> matches = predicted(t);
  ASSERT_EQ(matches.size(), 3u) << "a line has no depth: it is searched for elsewhere";
  for (const FeatureMatch& match : matches) {
    const Landmark& landmark = estimate.landmarks.at(match.id);
    EXPECT_EQ(match.outcome, MatchOutcome::not_searched);
    const bool known = landmark.fixed;
    const int own = known ? 0 : estimate.belief.covariance(landmark.block).rows();
    const auto f = [&](const Eigen::VectorXd& e) { return pixel_with(estimate, landmark, e); };
    EXPECT_TRUE(match.predicted.isApprox(f(Eigen::VectorXd::Zero(12 + own)), 1e-9));
    const Eigen::MatrixXd H = numeric_jacobian(12 + own, 1e-6, f);
    Eigen::MatrixXd P(12 + own, 12 + own);
    P.topLeftCorner(12, 12) = estimate.belief.covariance(t.camera_block());
    if (!known) {
      P.bottomRightCorner(own, own) = estimate.belief.covariance(landmark.block);
      P.topRightCorner(12, own) = estimate.belief.covariance(t.camera_block(), landmark.block);
      P.bottomLeftCorner(own, 12) = P.topRightCorner(12, own).transpose();
    }
    const Eigen::Matrix2d S = H * P * H.transpose() + 0.36 * Eigen::Matrix2d::Identity();
    EXPECT_TRUE(match.innovation_cov.isApprox(S, 1e-5)) << match.innovation_cov << "\nnumeric\n" << S;
  }
}

/// Whether the one landmark, first seen from the origin, is expected from here.
bool expected_from(const CameraState& from, const Eigen::Vector2d& first_seen = {160, 120},
                   const MapSettings& map = {}) {
  CameraSlamSettings settings = few_features();
  settings.map = map;
  Tracking t(origin, 1e-6 * CameraCov::Identity(), settings);
  const Eigen::Vector3d at = wall.point_at(origin, first_seen);
  t.add_point(wall.seen_from(origin), origin, at, at, 0.01);
  t.move_to(from);
  return predicted(t).size() == 1;
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
  Tracking t(origin, 1e-6 * CameraCov::Identity());
  t.add_point(wall.seen_from(origin), origin, at, at, 0.01);
  const CameraState from = camera_at({0.5, 0.4, 0.1}, -0.2, {0, 0, 0.3});
  t.move_to(from);
  const auto measurements = predicted(t);
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
