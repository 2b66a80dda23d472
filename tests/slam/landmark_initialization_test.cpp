// Landmarks from an image: where they are begun, with which mean and covariance, as thesis C.2 to C.4 say.
#include <gtest/gtest.h>

#include <algorithm>

#include "incognita/slam/features/landmark_initialization.hpp"
#include "incognita/slam/features/predict_matches.hpp"
#include "tests/slam/synthetic_scene.hpp"

namespace incognita {
namespace {

using namespace synthetic;

const CameraState oblique = camera_at({0.1, -0.2, 0.3}, 0.2, {0.1, -0.05, 0.15});
const Eigen::Vector2d pixel(211.3, 74.6);
constexpr double regularization_var = 1e-8;  // of the position, that the covariance stays positive definite

/// An estimate with a correlated camera and another landmark that depends on the camera.
struct Correlated : Tracking {
  BlockId other;

  explicit Correlated(const CameraSlamSettings& settings)
      : Tracking(oblique, correlated_covariance(0.05, 3), settings) {
    Eigen::Matrix<double, 3, 12> J = Eigen::Matrix<double, 3, 12>::Zero();
    J.leftCols<6>().setConstant(0.4);
    J.leftCols<3>() += Eigen::Matrix3d::Identity();
    const Belief::Parent parent{camera_block(), J};
    other = estimate.belief.augment(PointLandmark::chart, Eigen::Vector3d(2, 0, 0), {&parent, 1},
                                    1e-4 * Eigen::Matrix3d::Identity());
  }
};

/// Position and direction (x, y, 1) in the axes of the first view, from errors of camera (12) and pixel (2).
Eigen::VectorXd begun_with(const Eigen::VectorXd& errors) {
  const CameraState x = plus(FreeCameraMotion::chart, oblique, Eigen::VectorXd(errors.head(12)));
  const Eigen::Vector3d ray = rotation_matrix<double>(free_camera::orientation(oblique)).transpose() *
                              rotation_matrix<double>(free_camera::orientation(x)) *
                              *camera.unproject(pixel + errors.tail(2));
  Eigen::VectorXd y(5);
  y << free_camera::position(x), ray.x() / ray.z(), ray.y() / ray.z();
  return y;
}

/// Own and cross-covariances of a new landmark against J P J' + noise with a numeric J; the first five errors
/// are those of the ray.
void expect_propagated(const AnyBelief& belief, BlockId camera_block, BlockId other, BlockId begun,
                       double sigma_pixel_px) {
  const Eigen::MatrixXd J = numeric_jacobian(14, 1e-5, begun_with);
  const Eigen::MatrixXd Jv = J.leftCols(12), Jz = J.rightCols(2);
  Eigen::MatrixXd own = Jv * belief.covariance(camera_block) * Jv.transpose() +
                        sigma_pixel_px * sigma_pixel_px * Jz * Jz.transpose();
  own.diagonal().head(3).array() += regularization_var;
  const Eigen::MatrixXd P = belief.covariance(begun), with_camera = belief.covariance(begun, camera_block),
                        with_other = belief.covariance(begun, other);
  EXPECT_TRUE(P.topLeftCorner(5, 5).isApprox(own, 1e-6)) << P << "\nnumeric\n" << own;
  EXPECT_TRUE(with_camera.topRows(5).isApprox(Jv * belief.covariance(camera_block), 1e-6));
  EXPECT_TRUE(with_other.topRows(5).isApprox(Jv * belief.covariance(camera_block, other), 1e-6));
}

TEST(LandmarkInitialization, OfAnInverseDepthIsTheRayWithItsPropagatedCovariance) {
  CameraSlamSettings settings = few_features();
  settings.filter.sigma_pixel_px = 0.7;
  settings.initialization.inverse_depth_per_m = 0.4;
  settings.initialization.sigma_inverse_depth_per_m = 0.3;
  Correlated c(settings);
  Estimate& estimate = c.estimate;
  const Eigen::MatrixXd before = estimate.belief.dense_covariance();
  ASSERT_TRUE(c.initialize(Wall(2).seen_from(oblique), pixel));

  ASSERT_EQ(estimate.landmarks.size(), 1u);
  const Landmark& landmark = c.landmark(0);
  EXPECT_EQ(landmark.form.kind, Kind::inverse_depth);
  EXPECT_EQ(landmark.camera, 0);
  EXPECT_EQ(landmark.first_view, Eigen::Vector3d(free_camera::position(oblique)));
  EXPECT_TRUE(landmark.mapped());
  EXPECT_EQ(c.feature(0).attempts, 0);
  EXPECT_EQ(estimate.next_id, landmark.id + 1);
  const InverseDepthLandmark::State y = estimate.belief.mean(landmark.block);
  EXPECT_TRUE(y.head<5>().isApprox(begun_with(Eigen::VectorXd::Zero(14)), 1e-9)) << y.transpose();
  EXPECT_EQ(y[5], 0.4);
  const auto position = position_of(landmark, estimate);
  ASSERT_TRUE(position);
  EXPECT_TRUE(pixel_of(oblique, position->position).isApprox(pixel, 1e-9)) << "it is on its own ray";

  expect_propagated(estimate.belief, c.camera_block(), c.other, landmark.block, 0.7);
  const Eigen::MatrixXd P = estimate.belief.covariance(landmark.block);
  EXPECT_NEAR(P(5, 5), 0.09, 1e-12) << "the prior's";
  EXPECT_LT(P.row(5).head(5).norm(), 1e-12) << "no measurement so far informs the depth";
  EXPECT_LT(estimate.belief.covariance(landmark.block, c.camera_block()).row(5).norm(), 1e-12);
  EXPECT_EQ(estimate.belief.dense_covariance().topLeftCorner(15, 15), before) << "all else is as it was";
}

TEST(LandmarkInitialization, TheDepthPriorIsScaledToTheView) {
  using enum InitializationSettings::ScalePrior;
  TrackedCamera tracked{.camera = camera};
  const auto prior = [&](double median_depth_m, InitializationSettings::ScalePrior scaled) {
    tracked.median_depth_m = median_depth_m;
    tracked.settings.initialization.scale_prior_to_view = scaled;
    const DepthPrior of_new = tracked.depth_prior();
    return Eigen::Vector2d(of_new.mean, of_new.sigma);
  };
  tracked.settings.initialization.inverse_depth_per_m = 0.5;
  tracked.settings.initialization.sigma_inverse_depth_per_m = 0.4;
  for (const auto scaled : {nearer, always}) {
    EXPECT_TRUE(prior(0.5, scaled).isApprox(Eigen::Vector2d(2, 1.6)));
    EXPECT_TRUE(prior(2, scaled).isApprox(Eigen::Vector2d(0.5, 0.4)));
  }
  EXPECT_TRUE(prior(4, nearer).isApprox(Eigen::Vector2d(0.5, 0.4)));
  EXPECT_TRUE(prior(4, always).isApprox(Eigen::Vector2d(0.25, 0.2)));
  EXPECT_TRUE(prior(100, always).isApprox(Eigen::Vector2d(0.15, 0.12)))
      << "something nearer may come into view";
  EXPECT_TRUE(prior(0.5, never).isApprox(Eigen::Vector2d(0.5, 0.4)));
}

TEST(LandmarkInitialization, TheDepthOfTheViewIsThatOfLandmarksOfKnownDepth) {
  using enum InitializationSettings::ScalePrior;
  Estimate estimate;
  TrackedCamera tracked{.camera = camera};
  tracked.view.camera = origin;
  const auto add = [&](std::int64_t id, double x_m, LandmarkParametrization::Kind kind,
                       MatchOutcome outcome) {
    Landmark landmark;
    landmark.id = id;
    landmark.form.kind = kind;
    estimate.landmarks[id] = landmark;
    FeatureMatch match;
    match.id = id;
    match.point = {x_m, 0, 0};
    match.outcome = outcome;
    tracked.matches.push_back(match);
  };
  const auto depth_m = [&](InitializationSettings::ScalePrior scaled) {
    tracked.settings.initialization.scale_prior_to_view = scaled;
    return depth_of_view(estimate, tracked);
  };
  EXPECT_FALSE(depth_m(always)) << "no match";
  for (int i = 0; i < 3; ++i) add(i, 2, LandmarkParametrization::Kind::inverse_depth, MatchOutcome::matched);
  EXPECT_EQ(depth_m(nearer), 2);
  EXPECT_FALSE(depth_m(always)) << "the prior of these landmarks says nothing of the depth";
  add(3, 4, LandmarkParametrization::Kind::point, MatchOutcome::matched);
  add(4, 9, LandmarkParametrization::Kind::point, MatchOutcome::outlier);
  EXPECT_EQ(depth_m(nearer), 2);
  EXPECT_EQ(depth_m(always), 4);
}

TEST(LandmarkInitialization, OfADepthLineIsTheRayAndUniformParticles) {
  CameraSlamSettings settings = few_features();
  settings.initialization.method = InitializationSettings::Method::depth_line;
  settings.initialization.particles = 100;  // thesis C.1: 100, 0.5 m to 5 m
  Correlated c(settings);
  Estimate& estimate = c.estimate;
  ASSERT_TRUE(c.initialize(Wall(2).seen_from(oblique), pixel));

  const Landmark& line = c.landmark(0);
  const std::vector<DepthHypothesis>& depths = c.feature(0).depths;
  EXPECT_EQ(line.form.kind, Kind::ray);
  EXPECT_FALSE(line.mapped());
  EXPECT_EQ(estimate.mapped_count(), 0);
  EXPECT_TRUE(estimate.belief.mean(line.block).isApprox(begun_with(Eigen::VectorXd::Zero(14)), 1e-9));
  EXPECT_EQ(estimate.belief.covariance(line.block).rows(), 5);
  expect_propagated(estimate.belief, c.camera_block(), c.other, line.block, settings.filter.sigma_pixel_px);

  ASSERT_EQ(depths.size(), 100u);
  InverseDepthLandmark::State y;
  y.head<5>() = estimate.belief.mean(line.block);
  for (int i = 0; i < 100; ++i) {
    EXPECT_DOUBLE_EQ(depths[i].weight, 0.01);
    y[5] = depths[i].inverse_depth;
    const double distance_m = (axes_of(line).point(y).position - y.head<3>()).norm();
    EXPECT_NEAR(distance_m, 0.5 + 4.5 * i / 99, 1e-9) << "along the ray, not along the optical axis";
  }
}

TEST(LandmarkInitialization, KeepsTheViewItWasSeenFrom) {
  const CameraSlamSettings settings = few_features();
  const Image image = Wall(2).seen_from(oblique);
  const auto view = cut_view(ImagePyramid(image), pixel, oblique, camera, settings);
  ASSERT_TRUE(view);
  EXPECT_EQ(view->pixel, pixel);
  EXPECT_EQ(view->camera_position, Eigen::Vector3d(free_camera::position(oblique)));
  EXPECT_EQ(view->world_from_camera, Eigen::Vector4d(free_camera::orientation(oblique)));
  const Eigen::Vector3d to_wall = Wall(2).point_at(oblique, pixel) - view->camera_position;
  EXPECT_TRUE(view->plane.normal().isApprox(-to_wall.normalized(), 1e-9)) << "taken to face the camera";
  EXPECT_FALSE(view->plane.known());
  for (int dv = -5; dv <= 5; ++dv)
    for (int du = -5; du <= 5; ++du)
      EXPECT_NEAR(view->texture.pixels.sample(view->texture.center.x() + du, view->texture.center.y() + dv),
                  image.sample(pixel.x() + du, pixel.y() + dv), 1e-9);
}

TEST(LandmarkInitialization, WithoutAWholePatchChangesNothing) {
  for (const auto method :
       {InitializationSettings::Method::inverse_depth, InitializationSettings::Method::depth_line}) {
    CameraSlamSettings settings = few_features();
    settings.initialization.method = method;
    Tracking t(oblique, correlated_covariance(0.05, 3), settings);
    const Estimate& estimate = t.estimate;
    const Image image = Wall(2).seen_from(oblique);
    for (const Eigen::Vector2d& at : {Eigen::Vector2d(3, 100), {317, 100}, {100, 2}, {100, 238}})
      EXPECT_FALSE(t.initialize(image, at));
    EXPECT_TRUE(estimate.landmarks.empty());
    EXPECT_TRUE(t.tracked.features.empty());
    EXPECT_EQ(estimate.next_id, 0);
    EXPECT_EQ(estimate.belief.errors(), 12);
    EXPECT_TRUE(t.initialize(image, {9, 100})) << "this one fits";
  }
}

}  // namespace
}  // namespace incognita
