// What decides that a loop is closed, and what its correction does. That drifts are found and corrected in images of a room:
// tests/app/loop_closure_in_room_test.cpp.
#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <numbers>
#include <vector>

#include "incognita/slam/estimator/single_camera.hpp"
#include "incognita/slam/features/loop_closure.hpp"
#include "incognita/slam/features/predict_matches.hpp"
#include "tests/slam/scene_with_target.hpp"

namespace incognita::synthetic {
namespace {

// ---- The transform

/// A camera, an inverse depth and a point, all correlated.
struct LoopScene {
  Tracking t{camera_at({0.1, 0.2, 1}, 0.3, {0.1, 0.2, -0.1}), correlated_covariance(0.05, 3)};
  std::vector<std::int64_t> ids;

  LoopScene() {
    CameraState& camera_now = t.tracked.view.camera;
    camera_now.segment<3>(7) << 0.1, -0.2, 0.3;
    t.move_to(camera_now);
    add(InverseDepthLandmark::chart, (SmallVector(6) << 0.1, 0.2, 1, 0.1, -0.2, 0.5).finished(),
        LandmarkParametrization::Kind::inverse_depth);
    add(PointLandmark::chart, (SmallVector(3) << 2, 0.5, 1.2).finished(),
        LandmarkParametrization::Kind::point);
  }
  void add(const Chart& chart, const SmallVector& mean, LandmarkParametrization::Kind kind) {
    Landmark landmark;
    landmark.id = new_id(t.estimate);
    landmark.form.kind = kind;
    landmark.form.initial_axes = free_camera::orientation(t.tracked.view.camera);
    landmark.first_view = free_camera::position(t.tracked.view.camera);
    const Eigen::MatrixXd noise = 0.01 * Eigen::MatrixXd::Identity(mean.size(), mean.size());
    BlockMatrix J = BlockMatrix::Zero(mean.size(), 12);
    J.topLeftCorner<3, 3>().setIdentity();
    const Belief::Parent parents[] = {{t.camera_block(), J}};
    landmark.block = t.estimate.belief.augment(chart, mean, parents, noise);
    ids.push_back(landmark.id);
    t.estimate.landmarks.emplace(landmark.id, landmark);
  }
  std::vector<DriftingLandmark> shares(double of_first, double of_second) const {
    return {{ids[0], of_first}, {ids[1], of_second}};
  }
  Eigen::Vector2d pixel(std::size_t i) const {
    return predict_pixel(t.landmark(ids[i]), t.estimate.belief, camera,
                         t.estimate.belief.mean(t.camera_block()), t.tracked.settings)
        .value()
        .predicted;
  }
};

DriftCorrection some_correction() {
  DriftCorrection drift;
  drift.center = LoopScene().t.tracked.view.camera.head<3>();
  drift.translation << 0.1, -0.2, 0.05;
  drift.turn << 0.1, 0.2, -0.15;
  return drift;
}

TEST(Drift, OfCameraAndLandmarksTogetherDoesNotShow) {
  LoopScene scene;
  const Eigen::Vector2d before[] = {scene.pixel(0), scene.pixel(1)};
  const SmallVector x = scene.t.estimate.belief.mean(scene.t.camera_block());
  correct_drift(scene.t.estimate, 0, some_correction(), scene.shares(1, 1));
  for (std::size_t i = 0; i < 2; ++i) EXPECT_LT((scene.pixel(i) - before[i]).norm(), 1e-9) << i;
  const CameraState moved = scene.t.estimate.belief.mean(scene.t.camera_block());
  EXPECT_LT((moved.head<3>() - x.head<3>() - some_correction().translation).norm(), 1e-12);
  EXPECT_NEAR(moved.segment<3>(7).norm(), x.segment<3>(7).norm(), 1e-12);
  EXPECT_EQ(moved.tail<3>(), x.tail<3>());
}

/// The means after a transform that differs from `drift` by `error`: translation, turn after it, logarithm of the scale.
Eigen::VectorXd means_after(const DriftCorrection& drift, const Eigen::VectorXd& error, double of_first,
                            double of_second) {
  LoopScene scene;
  correct_drift(scene.t.estimate, 0, drift, scene.shares(of_first, of_second));
  const AnyBelief& belief = scene.t.estimate.belief;
  const CameraState x = belief.mean(scene.t.camera_block());
  const auto moved = [&](const Eigen::Vector3d& p, double share) -> Eigen::Vector3d {
    const Eigen::Vector3d center = drift.center + share * drift.translation;
    return center + share * error.head<3>() +
           std::exp(share * error[6]) *
               (rotation_exp<double>(Eigen::Vector3d(share * error.segment<3>(3))) * (p - center));
  };
  Eigen::VectorXd out(18);
  const Eigen::Matrix3d turn = rotation_exp<double>(Eigen::Vector3d(error.segment<3>(3)));
  const Eigen::Matrix3d axes = rotation_matrix<double>(Eigen::Vector4d(x.segment<4>(3)));
  out.head<3>() = moved(x.head<3>(), 1);
  out.segment<3>(3) = quaternion_log(quaternion_from_matrix(axes.transpose() * turn * axes));
  out.segment<3>(6) = std::exp(error[6]) * (turn * x.segment<3>(7));
  const Landmark& ray = scene.t.landmark(scene.ids[0]);
  const InverseDepthLandmark::State y = belief.mean(ray.block);
  const Eigen::Matrix3d initial = rotation_matrix<double>(ray.form.initial_axes);
  const Eigen::Vector3d direction = initial.transpose() *
                                    rotation_exp<double>(Eigen::Vector3d(of_first * error.segment<3>(3))) *
                                    initial * Eigen::Vector3d(y[3], y[4], 1);
  out.segment<3>(9) = moved(y.head<3>(), of_first);
  out.segment<3>(12) << direction.head<2>() / direction.z(),
      y[5] / (std::exp(of_first * error[6]) * direction.z());
  out.tail<3>() = moved(belief.mean(scene.t.landmark(scene.ids[1]).block), of_second);
  return out;
}

TEST(Drift, IsAsUncertainAsItSays) {
  for (const double share : {1.0, 0.4}) {
    DriftCorrection drift = some_correction();
    const Eigen::MatrixXd J = numeric_jacobian(
        7, 1e-6, [&](const Eigen::VectorXd& error) { return means_after(drift, error, 1, share); });
    LoopScene certain, uncertain;
    correct_drift(certain.t.estimate, 0, drift, certain.shares(1, share));
    drift.cov = 0.01 * correlated_covariance(1, 5).topLeftCorner<7, 7>();
    correct_drift(uncertain.t.estimate, 0, drift, uncertain.shares(1, share));
    const Eigen::MatrixXd added =
        uncertain.t.estimate.belief.dense_covariance() - certain.t.estimate.belief.dense_covariance();
    Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(21, 7);  // the rate does not change
    rows.topRows<9>() = J.topRows<9>();
    rows.bottomRows<9>() = J.bottomRows<9>();
    Eigen::MatrixXd expected = rows * drift.cov * rows.transpose();
    if (share < 1) expected.bottomRightCorner<3, 3>() *= 1 + (1 - share) / share;  // its own part
    EXPECT_LT((added - expected).cwiseAbs().maxCoeff(), 1e-7) << share;
  }
}

/// On the way a drift may be anywhere near its share: half-way its variance is a quarter of that at the end, and as much again as
/// share of the common one.
TEST(Drift, IsUncertainBetweenItsEnds) {
  DriftCorrection certain = some_correction(), uncertain = certain;
  uncertain.cov.topLeftCorner<3, 3>() = 0.01 * Eigen::Matrix3d::Identity();
  const auto variance = [](const DriftCorrection& drift, double share) {
    LoopScene scene;
    correct_drift(scene.t.estimate, 0, drift, scene.shares(1, share));
    return scene.t.estimate.belief.covariance(scene.t.landmark(scene.ids[1]).block).trace();
  };
  EXPECT_NEAR(variance(uncertain, 1) - variance(certain, 1), 0.03, 1e-9);
  EXPECT_NEAR(variance(uncertain, 0.5) - variance(certain, 0.5), 0.03 * (0.25 + 0.25), 1e-9);
}

/// What was seen at the same time stays where it was relative to each other, however far it drifted.
TEST(Drift, LeavesWhatWasSeenTogetherTogether) {
  const auto difference_cov = [](double sigma_m) {
    LoopScene scene;
    DriftCorrection drift = some_correction();
    drift.cov.topLeftCorner<3, 3>() = sigma_m * sigma_m * Eigen::Matrix3d::Identity();
    correct_drift(scene.t.estimate, 0, drift, scene.shares(0.47, 0.47));
    const AnyBelief& belief = scene.t.estimate.belief;
    const BlockId first = scene.t.landmark(scene.ids[0]).block, second = scene.t.landmark(scene.ids[1]).block;
    const Eigen::Matrix3d cross = belief.covariance(first, second).topLeftCorner<3, 3>();
    return Eigen::Matrix3d(belief.covariance(first).topLeftCorner<3, 3>() + belief.covariance(second) -
                           cross - cross.transpose());
  };
  EXPECT_LT((difference_cov(0.3) - difference_cov(0)).cwiseAbs().maxCoeff(), 1e-9);
}

/// What is left where it was stays as certain; what moves keeps its certainty relative to the camera.
TEST(Drift, WithoutUncertaintyTurnsTheCovariance) {
  LoopScene before, after;
  correct_drift(after.t.estimate, 0, some_correction(), after.shares(1, 0));
  const auto variance = [](const LoopScene& s, std::size_t i) {
    return s.t.estimate.belief.covariance(s.t.landmark(s.ids[i]).block);
  };
  EXPECT_LT((variance(before, 1) - variance(after, 1)).norm(), 1e-12);
  EXPECT_NEAR(variance(before, 0).trace(), variance(after, 0).trace(), 1e-9);
  EXPECT_GT((variance(before, 0) - variance(after, 0)).norm(), 1e-5);
}

// ---- Appearance

/// Camera, landmark and the view of its patch, moved together by a turn about the line of sight and toward the wall: the patch is
/// warped as before.
TEST(MoveViews, KeepsTheWarpsOfPatches) {
  const CameraState from = camera_at({0, 0, 1}, 0.1), now = camera_at({0.1, 0.1, 1.1}, 0.05, {0.1, 0, 0.1});
  Tracking t(now, 1e-4 * CameraCov::Identity());
  const auto corners = wall_with_sheet().corners_in_view(from);
  const Eigen::Vector3d at = corners[corners.size() / 2];
  const std::int64_t id = t.add_point(wall_with_sheet().seen_from(from), from, at, at, 0.01);
  PatchPlane& plane = t.feature(id).view.plane;
  plane.slope << 0.2, -0.1;
  plane.slope_cov << 0.02, 0.01, 0.01, 0.03;
  const auto predicted = [&] {
    return predict_match(t.landmark(id), t.feature(id).view, t.estimate.belief, camera,
                         t.estimate.belief.mean(t.camera_block()), t.tracked.settings)
        .value();
  };
  const FeatureMatch before = predicted();
  const Eigen::Vector3d normal = plane.normal(), steeper = plane.normal({0.3, 0.1});
  ClosedLoop loop;
  loop.correction.center = now.head<3>();
  loop.correction.translation << 0.3, -0.1, 0.1;
  loop.correction.turn << 0.3, 0.05, -0.1;
  loop.landmarks = {{id, 1}};
  correct_drift(t.estimate, 0, loop.correction, loop.landmarks);
  move_views(t.tracked, loop);
  const FeatureMatch after = predicted();
  EXPECT_LT((after.predicted - before.predicted).norm(), 1e-9);
  EXPECT_LT((after.texture_from_view - before.texture_from_view).norm(), 1e-9);
  const Eigen::Matrix3d R = rotation_exp<double>(loop.correction.turn);
  EXPECT_LT((plane.normal() - R * normal).norm(), 1e-12);
  // A tilt that was as unlikely is as unlikely
  Eigen::Vector2d slope;
  const Eigen::Vector3d turned = R * steeper / (R * steeper).dot(plane.facing) - plane.facing;
  slope << turned.dot(plane.facing.unitOrthogonal()),
      turned.dot(plane.facing.cross(plane.facing.unitOrthogonal()));
  const Eigen::Vector2d off = slope - plane.slope, off_before(0.1, 0.2);
  Eigen::Matrix2d cov_before;
  cov_before << 0.02, 0.01, 0.01, 0.03;
  EXPECT_NEAR(off.dot(plane.slope_cov.inverse() * off), off_before.dot(cov_before.inverse() * off_before),
              1e-9);
}

// ---- What is missed

/// Eight landmarks that are tracked and began 50 frames ago, and six that return after 200 and are not found.
struct Missing {
  TrackedCamera camera{.camera = synthetic::camera};
  std::int64_t next = 0;

  Missing() {
    for (int i = 0; i < 8; ++i) add(MatchOutcome::matched, 50, 0, 50);
    for (int i = 0; i < 6; ++i) add(MatchOutcome::not_found, 400, 200, 4);
  }
  Feature& add(MatchOutcome outcome, int known, int away, int in_view) {
    Feature& feature = camera.features[next];
    feature.frames_known = known;
    feature.frames_away = away;
    feature.frames_in_view = in_view;
    camera.matches.emplace_back().id = next++;
    camera.matches.back().outcome = outcome;
    return feature;
  }
  std::size_t missed() const { return missed_landmarks(camera).ids.size(); }
};

TEST(MissedLandmarks, AreThoseThatReturnAndAreNotFound) {
  Missing m;
  EXPECT_EQ(m.missed(), 6u);
  EXPECT_EQ(missed_landmarks(m.camera).frames_gone, 200);
  m.add(MatchOutcome::not_found, 400, 200, 175);  // 25 frames after its last match it was in view again
  EXPECT_EQ(m.missed(), 6u);
  m.add(MatchOutcome::not_found, 400, 200, 175).frames_out_of_view = 3;  // and left since
  EXPECT_EQ(m.missed(), 7u);
  m.camera.settings.relocalization.close_loops = false;
  EXPECT_EQ(m.missed(), 0u);
}

/// Things that moved are not the camera's drift: what is older than their absence is where it was.
TEST(MissedLandmarks, AreNoneWhileOthersOfTheirTimeAreFound) {
  Missing m;
  m.add(MatchOutcome::matched, 201, 0, 30);
  EXPECT_EQ(m.missed(), 6u) << "one may be a false match";
  m.add(MatchOutcome::matched, 201, 0, 30);
  EXPECT_EQ(m.missed(), 0u);
}

TEST(MissedLandmarks, MayBeRightForSomeTime) {
  Missing m;
  const std::int64_t long_in_view = m.next;
  m.add(MatchOutcome::not_found, 400, 200, 60);
  const MissedLandmarks missed = missed_landmarks(m.camera);
  EXPECT_TRUE(missed.may_be_right(8));
  EXPECT_FALSE(missed.may_be_right(0)) << "matched";
  EXPECT_FALSE(missed.may_be_right(long_in_view));
}

TEST(Confirms, IfTheMissedMatchWithThoseThatDrifted) {
  const Missing before;
  ClosedLoop loop;
  for (std::int64_t id = 0; id < 8; ++id) loop.landmarks.push_back({id, 1});
  for (std::int64_t id = 8; id < 14; ++id) loop.missed.push_back(id);
  const auto confirmed = [&](const std::function<void(TrackedCamera&)>& change) {
    TrackedCamera after = before.camera;
    for (FeatureMatch& match : after.matches) match.outcome = MatchOutcome::matched;
    change(after);
    return confirms(loop, after, before.camera);
  };
  EXPECT_TRUE(confirmed([](TrackedCamera&) {}));
  EXPECT_FALSE(confirmed([](TrackedCamera& c) { c.matches[8].outcome = MatchOutcome::not_found; }))
      << "five of six, where six are needed";
  EXPECT_FALSE(confirmed([](TrackedCamera& c) { c.matches[0].outcome = MatchOutcome::outlier; }))
      << "seven of eight tracked";
  const auto without = [](int first) {
    return [first](TrackedCamera& c) {
      for (int id = first; id < 8; ++id) c.matches[id].outcome = MatchOutcome::not_searched;
    };
  };
  EXPECT_TRUE(confirmed(without(4)));
  EXPECT_FALSE(confirmed(without(3))) << "three of eight tracked were searched for again";
}

TEST(Confirms, NotAgainstAKnownPosition) {
  Missing before;
  before.add(MatchOutcome::matched, 500, 0, 500);
  before.camera.matches.back().anchor = true;
  ClosedLoop loop;
  for (std::int64_t id = 8; id < 14; ++id) loop.missed.push_back(id);
  TrackedCamera after = before.camera;
  for (FeatureMatch& match : after.matches) match.outcome = MatchOutcome::matched;
  EXPECT_TRUE(confirms(loop, after, before.camera));
  after.matches.back().outcome = MatchOutcome::not_found;
  EXPECT_FALSE(confirms(loop, after, before.camera));
}

// ---- Where no loop is to be closed

enum class Beginning { as_before, repainted, moved };

/// Slides along a wall until what it saw first is out of view, and back. Meanwhile the part of the wall that was seen first may be
/// painted anew, or moved by 0.2 m. Whether a loop was closed.
bool closes_loop(Beginning beginning) {
  static const Wall other(1.4, 77);
  constexpr int frames = 110;
  constexpr double step_m = 0.03;
  CameraSlamSettings settings = few_features();
  settings.filter.sigma_pixel_px = 0.5;
  settings.search.max_measurements = settings.map.wanted_visible = 30;
  settings.initialization.selection = InitializationSettings::Selection::grid;
  settings.initialization.max_new_per_frame = 5;
  settings.map.memory_attempts = 10;
  SlamEstimator estimator = single_camera(camera, sheet_target(), settings, 10, 1);
  Estimate estimate;
  bool closed = false;
  CameraState truth;
  for (int k = 0; k <= 2 * frames; ++k) {
    const double left_m = step_m * std::min(k, 2 * frames - k);
    truth = camera_at({0, left_m, 0});
    Image image = wall_with_sheet().seen_from(truth);
    if (k > frames && beginning != Beginning::as_before) {
      const Image changed = beginning == Beginning::moved
                                ? wall_with_sheet().seen_from(camera_at({0, left_m + 0.2, 0}))
                                : other.seen_from(truth);
      for (int v = 0; v < image.height(); ++v)
        for (int u = 0; u < image.width(); ++u)
          if (wall_with_sheet().point_at(truth, Eigen::Vector2d(u, v)).y() < 1.2) image(u, v) = changed(u, v);
    }
    estimator.update(estimate, {}, seeing(std::make_shared<const Image>(std::move(image))), tick(k));
    closed |= estimate.last.loop_closed;
  }
  if (beginning == Beginning::as_before) {
    EXPECT_LT(camera_error(truth, estimate.camera_state()).head<3>().norm(), 0.03);
  }
  return closed;
}

TEST(LoopClosure, IsNotSeenWithoutDrift) { EXPECT_FALSE(closes_loop(Beginning::as_before)); }
TEST(LoopClosure, IsNotSeenWhereTheWorldChanged) { EXPECT_FALSE(closes_loop(Beginning::repainted)); }
TEST(LoopClosure, IsNotSeenWhereThingsMoved) { EXPECT_FALSE(closes_loop(Beginning::moved)); }

}  // namespace
}  // namespace incognita::synthetic
