// Bundle adjustment over keyframes moves the means of the belief to what their matches say.
#include "incognita/slam/bundle/keyframes.hpp"

#include <algorithm>

#include "incognita/slam/features/predict_matches.hpp"
#include "incognita/slam/mapper/landmarks.hpp"
#include "tests/slam/synthetic_scene.hpp"

namespace incognita::synthetic {
namespace {

const CameraState start = camera_at({0, 0, 1});
constexpr double keyframe_s = 0.2;

CameraState pose_at(int keyframe) {
  CameraState x = start;
  x.head<3>() += Eigen::Vector3d(0.01, 0.05, 0.02) * keyframe;
  return x;
}

/// Points in front of the camera; the first four are anchors, which give the scale.
struct KeyframeScene {
  static constexpr int points = 30, anchors = 4;
  Tracking t{start, 1e-4 * CameraCov::Identity()};
  std::vector<Eigen::Vector3d> truth;
  Keyframes keyframes;

  explicit KeyframeScene(double error_m) {
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
    keyframes.start(start, Eigen::Matrix<double, 6, 6>::Zero(), 0);
    for (const KeyframeMatch& match : matches(0)) keyframes.add_new(match, {});
  }

  /// Keyframes whose first pose is no origin.
  void begin_in_the_middle() {
    keyframes.start(start, 1e-4 * Eigen::Matrix<double, 6, 6>::Identity(), 0);
    for (const KeyframeMatch& match : matches(0)) keyframes.add_new(match, {});
  }

  std::vector<KeyframeMatch> matches(int keyframe) const {
    std::vector<KeyframeMatch> out;
    for (int i = 0; i < points; ++i)
      out.push_back({i, pixel_of(pose_at(keyframe), truth[static_cast<std::size_t>(i)]),
                     0.25 * Eigen::Matrix2d::Identity()});
    return out;
  }

  /// Adds keyframes up to `last`, each with a wrong pose, and adjusts after each.
  void run(int last, int window, double error_m) {
    for (int k = keyframes.view_count(); k <= last; ++k) {
      CameraState wrong = pose_at(k);
      wrong.head<3>() += error_m * Eigen::Vector3d(1, -1, 0.5);
      t.move_to(wrong);
      keyframes.add(t.estimate, t.camera_block(), matches(k), k * keyframe_s);
      const AdjustmentReport report =
          keyframes.adjust(t.estimate, t.camera_block(), camera, {.max_iterations = 20}, {0.5, 0.5}, window);
      ASSERT_NE(report.outcome, AdjustmentReport::Outcome::refused) << k;
    }
  }
  /// Of all landmarks but the anchors, as seen from the first keyframe.
  void take_wrong_depths() {
    for (int i = anchors; i < points; ++i) {
      const Eigen::Vector3d ray = PointLandmark::in_camera<double>(start, truth[static_cast<std::size_t>(i)]);
      const double depth = i % 2 == 0 ? 0.5 : 40;
      t.estimate.belief.set_mean(
          t.landmark(i).block,
          start.head<3>() + rotation_matrix<double>(free_camera::orientation(start)) * ray * depth / ray.z());
    }
  }
  double camera_error(int keyframe) const {
    return (t.estimate.belief.mean(t.camera_block()).head<3>() - pose_at(keyframe).head<3>()).norm();
  }
};

TEST(Keyframes, MoveCameraAndPointsToTheTruth) {
  KeyframeScene scene(0.1);
  scene.run(6, 15, 0.03);
  EXPECT_LT(scene.camera_error(6), 1e-3);
  for (int i = KeyframeScene::anchors; i < KeyframeScene::points; ++i)
    EXPECT_LT((Eigen::Vector3d(scene.t.estimate.belief.mean(scene.t.landmark(i).block)) -
               scene.truth[static_cast<std::size_t>(i)])
                  .norm(),
              0.02)
        << i;
}

TEST(Keyframes, LeaveTheCovariance) {
  KeyframeScene scene(0.1);
  const Eigen::MatrixXd before = scene.t.estimate.belief.covariance(scene.t.landmark(10).block);
  scene.run(3, 15, 0.03);
  EXPECT_EQ(Eigen::MatrixXd(scene.t.estimate.belief.covariance(scene.t.landmark(10).block)), before);
}

TEST(Keyframes, OfAWindowFindTheTruthToo) {
  KeyframeScene scene(0.1);
  scene.run(12, 4, 0.03);
  EXPECT_LT(scene.camera_error(12), 2e-3);
}

/// The filter moved them with the camera; what bundle adjustment takes back, it takes back of them too.
TEST(Keyframes, MoveLandmarksOutOfViewAsTheCamera) {
  KeyframeScene scene(0.1);
  AnyBelief& belief = scene.t.estimate.belief;
  const auto add = [&](std::int64_t id, bool with_camera) {
    Landmark landmark;
    landmark.id = id;
    BlockMatrix J = BlockMatrix::Zero(3, 12);
    if (with_camera) J.leftCols<3>().setIdentity();
    const Belief::Parent parents[] = {{scene.t.camera_block(), J}};
    landmark.block = belief.augment(PointLandmark::chart, Eigen::Vector3d(-2, 0, 1), parents,
                                    1e-4 * Eigen::Matrix3d::Identity());
    scene.t.estimate.landmarks.emplace(id, landmark);
    return landmark.block;
  };
  const BlockId with_camera = add(100, true), alone = add(101, false);
  CameraState wrong = pose_at(1);
  wrong.head<3>() += Eigen::Vector3d(0.03, -0.03, 0.015);
  scene.run(1, 15, 0.03);
  const Eigen::Vector3d shift = belief.mean(scene.t.camera_block()).head<3>() - wrong.head<3>();
  EXPECT_GT(shift.norm(), 0.02);
  const Eigen::Vector3d moved = belief.mean(with_camera);
  EXPECT_LT((moved - Eigen::Vector3d(-2, 0, 1) - shift).norm(), 1e-6);
  EXPECT_EQ(Eigen::Vector3d(belief.mean(alone)), Eigen::Vector3d(-2, 0, 1));
}

/// After a closed loop, landmarks are known better than from the keyframes: these fit to them, wherever the belief has them now.
TEST(Keyframes, FitToReferences) {
  constexpr int keyframes = 4;
  const Eigen::Vector3d shift(0.02, 0.05, -0.03);
  KeyframeScene scene(0);
  AnyBelief& belief = scene.t.estimate.belief;
  scene.begin_in_the_middle();
  for (int k = 1; k <= keyframes; ++k) {
    if (k == 3)
      for (int i = KeyframeScene::anchors; i < KeyframeScene::points; ++i)
        belief.set_mean(scene.t.landmark(i).block, scene.truth[static_cast<std::size_t>(i)] + shift);
    std::vector<KeyframeMatch> matches = scene.matches(k);
    std::erase_if(matches, [](const KeyframeMatch& match) { return match.id < KeyframeScene::anchors; });
    for (KeyframeMatch& match : matches) match.is_reference = true;
    scene.t.move_to(pose_at(k));
    scene.keyframes.add(scene.t.estimate, scene.t.camera_block(), matches, k * keyframe_s);
    scene.keyframes.adjust(scene.t.estimate, scene.t.camera_block(), camera, {.max_iterations = 20},
                           {0.5, 0.5}, 2);
  }
  const CameraState x = belief.mean(scene.t.camera_block());
  EXPECT_LT((x.head<3>() - pose_at(keyframes).head<3>() - shift).norm(), 2e-3);
  for (int i = KeyframeScene::anchors; i < KeyframeScene::points; ++i)
    EXPECT_EQ(Eigen::Vector3d(belief.mean(scene.t.landmark(i).block)),
              scene.truth[static_cast<std::size_t>(i)] + shift)
        << i;
}

TEST(Keyframes, KeepWhatTheySawOfDeletedLandmarks) {
  KeyframeScene scene(0.1);
  scene.run(4, 15, 0.03);
  for (int i = 10; i < 20; ++i) remove_landmark(scene.t.estimate, i);
  CameraState wrong = pose_at(5);
  wrong[1] += 0.03;
  scene.t.move_to(wrong);
  std::vector<KeyframeMatch> matches = scene.matches(5);
  std::erase_if(matches, [](const KeyframeMatch& match) { return match.id >= 10 && match.id < 20; });
  scene.keyframes.add(scene.t.estimate, scene.t.camera_block(), matches, 5 * keyframe_s);
  EXPECT_NE(
      scene.keyframes
          .adjust(scene.t.estimate, scene.t.camera_block(), camera, {.max_iterations = 20}, {0.5, 0.5}, 15)
          .outcome,
      AdjustmentReport::Outcome::refused);
  EXPECT_LT(scene.camera_error(5), 1e-3);
}

TEST(Keyframes, MoveInverseDepths) {
  KeyframeScene scene(0.1);
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

/// The filter had its velocity from poses that were wrong by a growing error.
TEST(Keyframes, CorrectTheVelocityByTheChangeBetweenTheLastTwo) {
  KeyframeScene scene(0);
  scene.run(4, 15, 0);
  const Eigen::Vector3d drift(0.02, -0.02, 0.01);
  CameraState wrong = pose_at(5);
  wrong.head<3>() += drift;
  wrong.segment<3>(7) = (pose_at(5) - pose_at(4)).head<3>() / keyframe_s + drift / keyframe_s;
  scene.t.move_to(wrong);
  scene.keyframes.add(scene.t.estimate, scene.t.camera_block(), scene.matches(5), 5 * keyframe_s);
  scene.keyframes.adjust(scene.t.estimate, scene.t.camera_block(), camera, {.max_iterations = 20}, {0.5, 0.5},
                         15);
  const CameraState after = scene.t.estimate.belief.mean(scene.t.camera_block());
  EXPECT_LT((after.segment<3>(7) - (pose_at(5) - pose_at(4)).head<3>() / keyframe_s).norm(), 0.02);
}

/// The last two keyframes are turned by the same error about an axis of the world, and the camera rolls between them: its rate,
/// in camera axes, is right and stays.
TEST(Keyframes, LeaveTheRateWhereTheLastTwoWereTurnedTogether) {
  KeyframeScene scene(0);
  scene.run(2, 15, 0);
  const Eigen::Vector4d error = quaternion_exp<double>(Eigen::Vector3d(0, 0.03, 0));
  const Eigen::Vector3d rate(0, 0, 0.5 / keyframe_s);
  for (int k : {3, 4}) {
    const CameraState truth = camera_at(pose_at(k).head<3>(), 0, {0, 0, k == 4 ? 0.5 : 0.0});
    std::vector<KeyframeMatch> matches;
    for (int i = 0; i < KeyframeScene::points; ++i)
      matches.push_back(
          {i, pixel_of(truth, scene.truth[static_cast<std::size_t>(i)]), 0.25 * Eigen::Matrix2d::Identity()});
    CameraState believed = truth;
    believed.segment<4>(3) = quaternion_product<double>(error, free_camera::orientation(truth));
    believed.tail<3>() = rate;
    scene.t.move_to(believed);
    scene.keyframes.add(scene.t.estimate, scene.t.camera_block(), matches, k * keyframe_s);
  }
  scene.keyframes.adjust(scene.t.estimate, scene.t.camera_block(), camera, {.max_iterations = 20}, {0.5, 0.5},
                         15);
  const CameraState after = scene.t.estimate.belief.mean(scene.t.camera_block());
  const Eigen::Vector4d left =
      quaternion_product<double>(quaternion_conjugate<double>(free_camera::orientation(after)),
                                 camera_at({0, 0, 0}, 0, {0, 0, 0.5}).segment<4>(3));
  EXPECT_LT(quaternion_log<double>(left).norm(), 1e-3) << "the error is corrected";
  EXPECT_LT((after.tail<3>() - rate).norm(), 0.01);
}

TEST(Keyframes, AreNoStartAfterTheyBeganInTheMiddle) {
  KeyframeScene scene(0);
  scene.run(1, 15, 0);
  EXPECT_TRUE(scene.keyframes.is_starting());
  scene.begin_in_the_middle();
  EXPECT_FALSE(scene.keyframes.is_starting());
}

TEST(Keyframes, KeepFewOldViewsInALongRun) {
  KeyframeScene scene(0);
  scene.run(60, 4, 0.001);
  // The first, the last 20 fixed, and the window
  EXPECT_LE(scene.keyframes.view_count(), 1 + 20 + 4);
  EXPECT_LT(scene.camera_error(60), 5e-3);
}

/// Three views or more, since two fit nearly any depths.
TEST(Keyframes, DoNotStartAgainWhereTheEstimateIsRight) {
  KeyframeScene scene(0);
  for (int i = 0; i < KeyframeScene::anchors; ++i) remove_landmark(scene.t.estimate, i);
  RandomStream random(7, "pixels");
  for (int k = 1; k <= 5; ++k) {
    std::vector<KeyframeMatch> matches = scene.matches(2 * k);
    matches.erase(matches.begin(), matches.begin() + KeyframeScene::anchors);
    for (KeyframeMatch& match : matches)
      match.pixel += 0.5 * Eigen::Vector2d(random.normal(), random.normal());
    scene.t.move_to(pose_at(2 * k));
    scene.keyframes.add(scene.t.estimate, scene.t.camera_block(), matches, k * keyframe_s);
    scene.keyframes.adjust(scene.t.estimate, scene.t.camera_block(), camera, {.max_iterations = 2},
                           {0.5, 0.5}, 15);
    EXPECT_TRUE(scene.keyframes.is_starting());
    EXPECT_FALSE(scene.keyframes.start_again(camera, {.max_iterations = 5})) << k;
  }
}

/// A start that explains a motion forward by a rotation is a minimum, too. Few iterations do not leave it.
TEST(Keyframes, StartAgainFromTwoViewsWhereTheFirstEstimateIsWrong) {
  KeyframeScene scene(0);
  for (int i = 0; i < KeyframeScene::anchors; ++i) remove_landmark(scene.t.estimate, i);
  std::vector<KeyframeMatch> matches;
  const CameraState second = camera_at({0.4, 0.1, 1}, 0.05);
  for (int i = KeyframeScene::anchors; i < KeyframeScene::points; ++i) {
    matches.push_back(
        {i, pixel_of(second, scene.truth[static_cast<std::size_t>(i)]), 0.25 * Eigen::Matrix2d::Identity()});
  }
  scene.take_wrong_depths();
  scene.t.move_to(camera_at({-0.1, 0, 1}, -0.1));
  scene.keyframes.add(scene.t.estimate, scene.t.camera_block(), matches, keyframe_s);
  scene.keyframes.adjust(scene.t.estimate, scene.t.camera_block(), camera, {.max_iterations = 1}, {0.5, 0.5},
                         15);
  ASSERT_TRUE(scene.keyframes.start_again(camera, {.max_iterations = 2}));
  const Eigen::Vector3d shift = scene.keyframes.last_view().position - Eigen::Vector3d(start.head<3>());
  EXPECT_GT(shift.normalized().dot(Eigen::Vector3d(0.4, 0.1, 0).normalized()), std::cos(0.05));
  EXPECT_FALSE(scene.keyframes.start_again(camera, {.max_iterations = 2})) << "it is right already";
}

/// Each trial takes longer than the one before, in the frame of its keyframe.
TEST(Keyframes, StartAgainAfterTheNearOnesOnlyAtTheLast) {
  constexpr int last_near = 10;
  const auto is_tried = [](int k, int window) {
    const int last = std::min(14, window - 1);
    return k <= last && (k <= last_near || k == last);
  };
  for (const int window : {8, 11, 12, 13, 20}) {
    KeyframeScene scene(0);
    for (int i = 0; i < KeyframeScene::anchors; ++i) remove_landmark(scene.t.estimate, i);
    scene.take_wrong_depths();
    for (int k = 1; k <= 15; ++k) {
      std::vector<KeyframeMatch> matches = scene.matches(k);
      matches.erase(matches.begin(), matches.begin() + KeyframeScene::anchors);
      scene.t.move_to(camera_at({-0.1, 0, 1}, -0.1));  // wrong
      scene.keyframes.add(scene.t.estimate, scene.t.camera_block(), matches, k * keyframe_s);
      scene.keyframes.adjust(scene.t.estimate, scene.t.camera_block(), camera, {.max_iterations = 0},
                             {0.5, 0.5}, window);
      if (k == 1) continue;  // two views fit nearly any depths
      Keyframes tried = scene.keyframes;
      EXPECT_EQ(tried.start_again(camera, {.max_iterations = 5}), is_tried(k, window))
          << "keyframe " << k << ", window " << window;
    }
  }
}

TEST(Keyframes, SayHowFarTheFilterMovedTheirPoints) {
  KeyframeScene scene(0);
  scene.run(3, 15, 0);
  EXPECT_LT(scene.keyframes.moved_px(scene.t.estimate, pose_at(3), camera), 0.1);
  for (int i = KeyframeScene::anchors; i < KeyframeScene::points; ++i) {
    const BlockId block = scene.t.landmark(i).block;
    scene.t.estimate.belief.set_mean(block, scene.t.estimate.belief.mean(block) + Eigen::Vector3d(0, 0.1, 0));
  }
  // 0.1 m at 1.5 to 3 m, 195 px focal length
  const double moved = scene.keyframes.moved_px(scene.t.estimate, pose_at(3), camera);
  EXPECT_GT(moved, 195 * 0.1 / 3);
  EXPECT_LT(moved, 195 * 0.1 / 1.4);
}

TEST(Keyframes, CountLandmarksThatReturnFromBeforeTheWindow) {
  constexpr int window = 3, kept = 20;
  KeyframeScene scene(0.02);
  scene.run(2, window, 0.01);
  EXPECT_EQ(scene.keyframes.returning_count(scene.matches(3)), 0);
  for (int k = 3; k <= 5; ++k) {
    // The other landmarks were last matched in keyframe 2, which leaves the window with keyframe 5
    EXPECT_EQ(scene.keyframes.returning_count(scene.matches(k)), 0) << k;
    std::vector<KeyframeMatch> matches = scene.matches(k);
    matches.resize(kept);
    scene.t.move_to(pose_at(k));
    scene.keyframes.add(scene.t.estimate, scene.t.camera_block(), matches, k * keyframe_s);
    scene.keyframes.adjust(scene.t.estimate, scene.t.camera_block(), camera, {}, {0.5, 0.5}, window);
  }
  EXPECT_EQ(scene.keyframes.returning_count(scene.matches(6)), KeyframeScene::points - kept);
  std::vector<KeyframeMatch> unknown = scene.matches(6);
  for (KeyframeMatch& match : unknown) match.id += KeyframeScene::points;
  EXPECT_EQ(scene.keyframes.returning_count(unknown), 0) << "new landmarks do not return";
}

TEST(Keyframes, AreDueAfterMotionOrLostMatches) {
  KeyframeScene scene(0);
  scene.begin_in_the_middle();
  const KeyframePolicy policy{
      .min_frames = 2, .min_motion_px = 5, .min_start_motion_px = 0, .min_matched_share = 0.8};
  EXPECT_FALSE(scene.keyframes.is_due(scene.matches(3), policy)) << "too early";
  EXPECT_FALSE(scene.keyframes.is_due(scene.matches(0), policy)) << "nothing moved";
  EXPECT_TRUE(scene.keyframes.is_due(scene.matches(3), policy));
  std::vector<KeyframeMatch> few = scene.matches(0);
  few.resize(20);
  EXPECT_TRUE(scene.keyframes.is_due(few, policy));
}

/// By 4 to 10 px from one keyframe to the next.
TEST(Keyframes, AreNearerTogetherWhileTheMapStarts) {
  KeyframeScene scene(0);
  const auto is_due = [&](int keyframe, double start_px, double px) {
    return scene.keyframes.is_due(scene.matches(keyframe),
                                  {.min_frames = 1, .min_motion_px = px, .min_start_motion_px = start_px});
  };
  EXPECT_FALSE(is_due(0, 3, 1000));
  EXPECT_TRUE(is_due(1, 3, 1000));
  EXPECT_FALSE(is_due(1, 20, 1000));
  EXPECT_TRUE(is_due(1, 20, 3)) << "never farther apart than later";
  scene.run(9, 15, 0);
  EXPECT_TRUE(is_due(10, 3, 1000));
  scene.run(10, 15, 0);
  EXPECT_FALSE(is_due(11, 0.5, 1000)) << "started";
  scene.begin_in_the_middle();
  EXPECT_FALSE(is_due(3, 0.5, 1000)) << "the first pose is no origin";
}

}  // namespace
}  // namespace incognita::synthetic
