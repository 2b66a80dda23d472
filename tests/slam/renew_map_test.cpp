// The belief after a wrong start: means from the keyframes, covariances of landmarks that just began, corrected by one frame.
#include "incognita/slam/features/renew_map.hpp"

#include "incognita/slam/features/predict_matches.hpp"
#include "tests/slam/synthetic_scene.hpp"

namespace incognita::synthetic {
namespace {

constexpr double elapsed_s = 0.1;
const CameraState first = camera_at({0, 0, 1}), second = camera_at({0.5, 0.1, 1}, 0.05);

std::vector<KeyframeMatch> matches_from(const CameraState& from,
                                        const std::map<std::int64_t, Eigen::Vector3d>& points) {
  std::vector<KeyframeMatch> matches;
  for (const auto& [id, at] : points)
    matches.push_back({id, pixel_of(from, at), Eigen::Matrix2d::Identity()});
  return matches;
}

/// Tracks 30 points of unknown depth from the first camera, then has a wrong pose where the second is.
struct RenewedMapScene {
  Wall wall{3};
  Tracking t{first, 1e-8 * CameraCov::Identity()};
  std::map<std::int64_t, Eigen::Vector3d> truth;
  Keyframes keyframes;
  std::int64_t late = -1;  ///< began in no keyframe

  RenewedMapScene() {
    const Image image = wall.seen_from(first);
    RandomStream random(1, "renew");
    keyframes.start(first, Eigen::Matrix<double, 6, 6>::Zero(), 0);
    for (int i = 0; i < 30; ++i) {
      const Eigen::Vector2d pixel(random.uniform(60, 260), random.uniform(50, 190));
      const Eigen::Vector3d ray =
          rotation_matrix<double>(free_camera::orientation(first)) * *camera.unproject(pixel);
      const Eigen::Vector3d at = first.head<3>() + random.uniform(1.5, 6) * ray;
      EXPECT_TRUE(t.initialize(image, pixel));
      const std::int64_t id = t.tracked.features.rbegin()->first;
      truth[id] = at;
      keyframes.add_new({id, pixel, Eigen::Matrix2d::Identity()}, {});
    }
    t.move_to(camera_at({-0.1, 0.05, 1}, -0.1), 0.01);
    EXPECT_TRUE(t.initialize(wall.seen_from(t.estimate.belief.mean(t.camera_block())), {160, 120}));
    late = t.tracked.features.rbegin()->first;
    keyframes.add(t.estimate, t.camera_block(), matches_from(second, truth), elapsed_s);
    keyframes.adjust(t.estimate, t.camera_block(), camera, {.max_iterations = 1}, {0.5, 0.5}, 15);
    EXPECT_TRUE(keyframes.start_again(camera, {.max_iterations = 30}));
    for (const auto& [id, at] : truth) {
      FeatureMatch match;
      match.id = id;
      match.measured = pixel_of(second, at);
      match.outcome = MatchOutcome::matched;
      t.tracked.matches.push_back(match);
    }
    renew_map(keyframes, t.estimate, t.tracked);
  }
};

TEST(RenewMap, TakesPosesAndDepthsOfTheKeyframes) {
  RenewedMapScene scene;
  const CameraState x = scene.t.estimate.belief.mean(scene.t.camera_block());
  const Eigen::Vector3d shift = x.head<3>() - first.head<3>(),
                        true_shift = second.head<3>() - first.head<3>();
  EXPECT_GT(shift.normalized().dot(true_shift.normalized()), std::cos(0.05));
  const double scale = shift.norm() / true_shift.norm();
  EXPECT_LT((x.segment<3>(7) * elapsed_s - shift).norm(), 0.05 * shift.norm());
  for (const auto& [id, at] : scene.truth) {
    const auto y = scene.t.estimate.belief.mean(scene.t.landmark(id).block);
    const double depth = PointLandmark::in_camera<double>(first, at).z();
    EXPECT_NEAR(y[5] * depth * scale, 1, 0.2) << id;
  }
}

TEST(RenewMap, RemovesLandmarksThatBeganLater) {
  RenewedMapScene scene;
  EXPECT_FALSE(scene.t.estimate.landmarks.contains(scene.late));
  EXPECT_FALSE(scene.t.tracked.features.contains(scene.late));
  EXPECT_EQ(scene.t.tracked.features.size(), scene.truth.size());
}

/// The first view is the world; the scale is not known better than the prior of the depths lets.
TEST(RenewMap, KnowsAsMuchAsTwoViewsTell) {
  RenewedMapScene scene;
  const Eigen::MatrixXd P = scene.t.estimate.belief.dense_covariance();
  EXPECT_GT(P.ldlt().vectorD().minCoeff(), 0);
  const Eigen::MatrixXd camera_cov = scene.t.estimate.belief.covariance(scene.t.camera_block());
  const double sigma_rotation = std::sqrt(camera_cov.diagonal().segment<3>(3).maxCoeff());
  EXPECT_LT(sigma_rotation, 0.05);
  EXPECT_GT(sigma_rotation, 1e-4);
  const double shift =
      (scene.t.estimate.belief.mean(scene.t.camera_block()).head<3>() - first.head<3>()).norm();
  const double sigma_position = std::sqrt(camera_cov.diagonal().head<3>().maxCoeff());
  EXPECT_GT(sigma_position, 0.05 * shift);
  EXPECT_LT(sigma_position, shift);
}

}  // namespace
}  // namespace incognita::synthetic
