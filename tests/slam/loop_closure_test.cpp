// A drift that the covariance does not know of is found when landmarks return, and taken back.
#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "incognita/slam/estimator/single_camera.hpp"
#include "incognita/slam/features/loop_closure.hpp"
#include "incognita/slam/features/predict_matches.hpp"
#include "tests/slam/scene_with_target.hpp"

namespace incognita::synthetic {
namespace {

// ---- The transform

/// A camera, an inverse depth and a point, all correlated.
struct Scene {
  Tracking t{camera_at({0.1, 0.2, 1}, 0.3, {0.1, 0.2, -0.1}), correlated_covariance(0.05, 3)};
  std::vector<std::int64_t> ids;

  Scene() {
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

Drift some_drift() {
  Drift drift;
  drift.translation << 0.1, -0.2, 0.05;
  drift.turn << 0.1, 0.2, -0.15;
  return drift;
}

TEST(Drift, OfCameraAndLandmarksTogetherDoesNotShow) {
  Scene scene;
  const Eigen::Vector2d before[] = {scene.pixel(0), scene.pixel(1)};
  const SmallVector x = scene.t.estimate.belief.mean(scene.t.camera_block());
  undo_drift(scene.t.estimate, 0, some_drift(), scene.shares(1, 1));
  for (std::size_t i = 0; i < 2; ++i) EXPECT_LT((scene.pixel(i) - before[i]).norm(), 1e-9) << i;
  const CameraState moved = scene.t.estimate.belief.mean(scene.t.camera_block());
  EXPECT_LT((moved.head<3>() - x.head<3>() - some_drift().translation).norm(), 1e-12);
  EXPECT_NEAR(moved.segment<3>(7).norm(), x.segment<3>(7).norm(), 1e-12);
  EXPECT_EQ(moved.tail<3>(), x.tail<3>());
}

/// The means after a transform that differs from `drift` by `error`: translation, turn after it, logarithm of the scale.
Eigen::VectorXd means_after(const Drift& drift, const Eigen::VectorXd& error, double of_first,
                            double of_second) {
  Scene scene;
  undo_drift(scene.t.estimate, 0, drift, scene.shares(of_first, of_second));
  const AnyBelief& belief = scene.t.estimate.belief;
  const CameraState x = belief.mean(scene.t.camera_block());
  const auto moved = [&](const Eigen::Vector3d& p, double share) -> Eigen::Vector3d {
    const Eigen::Vector3d center = Scene().t.tracked.view.camera.head<3>() + share * drift.translation;
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
    Drift drift = some_drift();
    const Eigen::MatrixXd J = numeric_jacobian(
        7, 1e-6, [&](const Eigen::VectorXd& error) { return means_after(drift, error, 1, share); });
    Scene certain, uncertain;
    undo_drift(certain.t.estimate, 0, drift, certain.shares(1, share));
    drift.cov = 0.01 * correlated_covariance(1, 5).topLeftCorner<7, 7>();
    undo_drift(uncertain.t.estimate, 0, drift, uncertain.shares(1, share));
    const Eigen::MatrixXd added =
        uncertain.t.estimate.belief.dense_covariance() - certain.t.estimate.belief.dense_covariance();
    Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(21, 7);  // the rate does not change
    rows.topRows<9>() = J.topRows<9>();
    rows.bottomRows<9>() = J.bottomRows<9>();
    const Eigen::MatrixXd expected = rows * drift.cov * rows.transpose();
    EXPECT_LT((added - expected).cwiseAbs().maxCoeff(), 1e-7) << share;
  }
}

/// What is left where it was stays as certain; what moves keeps its certainty relative to the camera.
TEST(Drift, WithoutUncertaintyTurnsTheCovariance) {
  Scene before, after;
  undo_drift(after.t.estimate, 0, some_drift(), after.shares(1, 0));
  const auto variance = [](const Scene& s, std::size_t i) {
    return s.t.estimate.belief.covariance(s.t.landmark(s.ids[i]).block);
  };
  EXPECT_LT((variance(before, 1) - variance(after, 1)).norm(), 1e-12);
  EXPECT_NEAR(variance(before, 0).trace(), variance(after, 0).trace(), 1e-9);
  EXPECT_GT((variance(before, 0) - variance(after, 0)).norm(), 1e-5);
}

// ---- In images

/// Slides along a wall until what it saw first is out of view, drifts, and slides back.
class Return {
 public:
  explicit Return(bool closes_loops)
      : estimator_(single_camera(camera, sheet_target(), settings_with(closes_loops), 10, 1)) {
    for (int i = 0; i <= frames; ++i) see(step_m * i);
    EXPECT_EQ(estimate_.status.state, TrackingState::tracking);
    EXPECT_LT(error_m(), 0.05);
  }
  void drift(const Drift& drift) {
    std::vector<DriftingLandmark> in_view;
    for (const auto& [id, feature] : estimator_.cameras()[0].camera().features)
      if (feature.frames_away < 30 && estimate_.landmarks.at(id).mapped()) in_view.push_back({id, 1});
    undo_drift(estimate_, 0, drift, in_view);
  }
  /// `changed`: the part of the wall that was seen first has another texture.
  void slide_back(bool changed = false) {
    for (int i = frames; i >= 0; --i) {
      see(step_m * i, changed);
      lost_ |= estimate_.status.state == TrackingState::lost;
    }
  }
  double error_m() const { return camera_error(truth_, estimate_.camera_state()).head<3>().norm(); }
  double error_rad() const { return camera_error(truth_, estimate_.camera_state()).segment<3>(3).norm(); }
  int closed() const { return closed_; }
  bool was_lost() const { return lost_; }

 private:
  static constexpr int frames = 110;
  static constexpr double step_m = 0.03;

  static CameraSlamSettings settings_with(bool closes_loops) {
    CameraSlamSettings settings = few_features();
    settings.filter.sigma_pixel_px = 0.5;
    settings.search.max_measurements = settings.map.wanted_visible = 30;
    settings.initialization.selection = InitializationSettings::Selection::grid;
    settings.initialization.max_new_per_frame = 5;
    settings.relocalization.close_loops = closes_loops;
    return settings;
  }
  void see(double left_m, bool changed = false) {
    static const Wall other(1.4, 77);
    truth_ = camera_at({0, left_m, 0});
    Image image = wall_with_sheet().seen_from(truth_);
    if (changed) {
      const Image elsewhere = other.seen_from(truth_);
      for (int v = 0; v < image.height(); ++v)
        for (int u = 0; u < image.width(); ++u)
          if (wall_with_sheet().point_at(truth_, Eigen::Vector2d(u, v)).y() < 1.2)
            image(u, v) = elsewhere(u, v);
    }
    estimator_.update(estimate_, {}, seeing(std::make_shared<const Image>(std::move(image))), tick(frame_++));
    closed_ += estimate_.last.loop_closed;
  }

  SlamEstimator estimator_;
  Estimate estimate_;
  CameraState truth_ = camera_at({0, 0, 0});
  int frame_ = 0, closed_ = 0;
  bool lost_ = false;
};

Drift drift_of(double right_m, double turn_rad) {
  Drift drift;
  drift.translation << 0, -right_m, 0.3 * right_m;
  drift.turn << 0, 0, turn_rad;
  return drift;
}

TEST(LoopClosure, TakesADriftBack) {
  for (const auto& [right_m, turn_rad] : {std::pair{0.1, 0.0}, {-0.1, 0.03}, {0.2, -0.05}}) {
    Return t(true);
    t.drift(drift_of(right_m, turn_rad));
    t.slide_back();
    EXPECT_EQ(t.closed(), 1) << right_m;
    EXPECT_FALSE(t.was_lost());
    EXPECT_LT(t.error_m(), 0.03) << right_m;
    EXPECT_LT(t.error_rad(), 0.01) << right_m;
  }
}

TEST(LoopClosure, IsWhatKeepsTheCameraOnTheMap) {
  Return t(false);
  t.drift(drift_of(0.2, -0.05));
  t.slide_back();
  EXPECT_EQ(t.closed(), 0);
  EXPECT_TRUE(t.was_lost() || t.error_m() > 0.05);
}

TEST(LoopClosure, IsNotSeenWithoutDrift) {
  Return t(true);
  t.slide_back();
  EXPECT_EQ(t.closed(), 0);
  EXPECT_LT(t.error_m(), 0.03);
}

TEST(LoopClosure, IsNotSeenWhereTheWorldChanged) {
  Return t(true);
  t.slide_back(true);
  EXPECT_EQ(t.closed(), 0);
}

}  // namespace
}  // namespace incognita::synthetic
