// Bundle adjustment over keyframes moves the means of the belief to what their matches say.
#include "incognita/slam/bundle/keyframes.hpp"

#include "incognita/slam/features/predict_matches.hpp"
#include "incognita/slam/mapper/landmarks.hpp"
#include "tests/slam/synthetic_scene.hpp"

namespace incognita::synthetic {
namespace {

const CameraState start = camera_at({0, 0, 1});

CameraState pose_at(int keyframe) {
  CameraState x = start;
  x.head<3>() += Eigen::Vector3d(0.01, 0.05, 0.02) * keyframe;
  return x;
}

/// Points in front of the camera; the first four are anchors, which give the scale.
struct Scene {
  static constexpr int points = 30, anchors = 4;
  Tracking t{start, 1e-4 * CameraCov::Identity()};
  std::vector<Eigen::Vector3d> truth;
  Keyframes keyframes;

  explicit Scene(double error_m) {
    RandomStream random(1, "keyframes");
    for (int i = 0; i < points; ++i) {
      truth.emplace_back(random.uniform(1.5, 3), random.uniform(-0.5, 0.7), random.uniform(0.6, 1.4));
      Landmark landmark;
      landmark.id = i;
      landmark.fixed = i < anchors;
      const Eigen::Vector3d mean =
          truth.back() + error_m * Eigen::Vector3d(random.normal(), random.normal(), random.normal());
      if (landmark.fixed)
        landmark.position = truth.back();
      else
        landmark.block =
            t.estimate.belief.augment(PointLandmark::chart, mean, {}, 0.01 * Eigen::Matrix3d::Identity());
      t.estimate.landmarks.emplace(i, landmark);
    }
    keyframes.start(start);
    for (const KeyframeMatch& match : matches(0)) keyframes.add_match(match);
  }

  std::vector<KeyframeMatch> matches(int keyframe) const {
    std::vector<KeyframeMatch> out;
    for (int i = 0; i < points; ++i)
      out.push_back({i, pixel_of(pose_at(keyframe), truth[static_cast<std::size_t>(i)]),
                     0.25 * Eigen::Matrix2d::Identity()});
    return out;
  }

  /// Adds keyframes 1 to `count`, each with a wrong pose, and adjusts after each.
  void run(int count, int window, double error_m) {
    for (int k = 1; k <= count; ++k) {
      CameraState wrong = pose_at(k);
      wrong.head<3>() += error_m * Eigen::Vector3d(1, -1, 0.5);
      t.move_to(wrong);
      keyframes.add(wrong, matches(k));
      const AdjustmentReport report =
          keyframes.adjust(t.estimate, t.camera_block(), camera, {.max_iterations = 20}, {0.5, 0.5}, window);
      ASSERT_NE(report.outcome, AdjustmentReport::Outcome::refused) << k;
    }
  }
  double camera_error(int keyframe) const {
    return (t.estimate.belief.mean(t.camera_block()).head<3>() - pose_at(keyframe).head<3>()).norm();
  }
};

TEST(Keyframes, MoveCameraAndPointsToTheTruth) {
  Scene scene(0.1);
  scene.run(6, 15, 0.03);
  EXPECT_LT(scene.camera_error(6), 1e-3);
  for (int i = Scene::anchors; i < Scene::points; ++i)
    EXPECT_LT((Eigen::Vector3d(scene.t.estimate.belief.mean(scene.t.landmark(i).block)) -
               scene.truth[static_cast<std::size_t>(i)])
                  .norm(),
              0.02)
        << i;
}

TEST(Keyframes, LeaveTheCovariance) {
  Scene scene(0.1);
  const Eigen::MatrixXd before = scene.t.estimate.belief.covariance(scene.t.landmark(10).block);
  scene.run(3, 15, 0.03);
  EXPECT_EQ(Eigen::MatrixXd(scene.t.estimate.belief.covariance(scene.t.landmark(10).block)), before);
}

TEST(Keyframes, OfAWindowFindTheTruthToo) {
  Scene scene(0.1);
  scene.run(12, 4, 0.03);
  EXPECT_LT(scene.camera_error(12), 2e-3);
}

TEST(Keyframes, KeepWhatTheySawOfDeletedLandmarks) {
  Scene scene(0.1);
  scene.run(4, 15, 0.03);
  for (int i = 10; i < 20; ++i) remove_landmark(scene.t.estimate, i);
  CameraState wrong = pose_at(5);
  wrong[1] += 0.03;
  scene.t.move_to(wrong);
  std::vector<KeyframeMatch> matches = scene.matches(5);
  std::erase_if(matches, [](const KeyframeMatch& match) { return match.id >= 10 && match.id < 20; });
  scene.keyframes.add(wrong, matches);
  EXPECT_NE(
      scene.keyframes
          .adjust(scene.t.estimate, scene.t.camera_block(), camera, {.max_iterations = 20}, {0.5, 0.5}, 15)
          .outcome,
      AdjustmentReport::Outcome::refused);
  EXPECT_LT(scene.camera_error(5), 1e-3);
}

TEST(Keyframes, MoveInverseDepths) {
  Scene scene(0.1);
  Landmark& landmark = scene.t.landmark(20);
  scene.t.estimate.belief.drop(landmark.block);
  const CameraState from = pose_at(-1);  // where it was seen first, not a keyframe
  const Eigen::Vector3d along = PointLandmark::in_camera<double>(from, scene.truth[20]);
  InverseDepthLandmark::State y;
  y << from.head<3>(), along.x() / along.z(), along.y() / along.z(), 1.5 / along.z();
  landmark.form.kind = LandmarkParametrization::Kind::inverse_depth;
  landmark.form.initial_axes = from.segment<4>(3);
  landmark.block = scene.t.estimate.belief.augment(InverseDepthLandmark::chart, y, {},
                                                   0.01 * Eigen::Matrix<double, 6, 6>::Identity());
  scene.run(6, 15, 0.03);
  EXPECT_LT((nominal_position(landmark, scene.t.estimate.belief) - scene.truth[20]).norm(), 0.02);
}

TEST(Keyframes, AreDueAfterMotionOrLostMatches) {
  Scene scene(0);
  const KeyframePolicy policy{.min_frames = 2, .min_motion_px = 5, .min_matched_share = 0.8};
  EXPECT_FALSE(scene.keyframes.is_due(scene.matches(3), policy)) << "too early";
  EXPECT_FALSE(scene.keyframes.is_due(scene.matches(0), policy)) << "nothing moved";
  EXPECT_TRUE(scene.keyframes.is_due(scene.matches(3), policy));
  std::vector<KeyframeMatch> few = scene.matches(0);
  few.resize(20);
  EXPECT_TRUE(scene.keyframes.is_due(few, policy));
}

}  // namespace
}  // namespace incognita::synthetic
