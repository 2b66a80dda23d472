// What the single-camera estimator does when it sees nothing it knows: degraded, lost, and back again.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "incognita/slam/estimator/single_camera.hpp"
#include "incognita/slam/mapper/health.hpp"
#include "tests/slam/scene_with_target.hpp"

namespace incognita {
namespace {

using namespace synthetic;

/// Tracks the wall from a known start: the camera slides to the left by 2 cm a frame, so that depths are
/// known.
struct Tracked {
  CameraSlamSettings settings = few_features();
  SlamEstimator estimator;
  Estimate estimate;
  CameraState truth = origin;
  int k = 0;

  explicit Tracked(const CameraSlamSettings& s = defaults())
      : settings(s), estimator(single_camera(camera, sheet_target(), s, 10, 1)) {
    for (int i = 0; i < 12; ++i) {
      truth = camera_at({0, 0.02 * std::min(i, 8), 0});
      see(wall_with_sheet().shared_view(truth));
    }
    EXPECT_EQ(estimate.status.state, TrackingState::tracking) << estimate.status.reason;
    EXPECT_GE(estimate.last.matched, 8);
    EXPECT_LT(position_error_m(), 0.02);
  }
  static CameraSlamSettings defaults() {
    CameraSlamSettings settings = few_features();
    settings.filter.sigma_pixel_px = 0.5;
    return settings;
  }

  void see(const std::shared_ptr<const Image>& image, const Command& command = {}) {
    estimator.update(estimate, command, seeing(image), tick(k++));
  }
  void see_gray() { see(seeing_gray(8).bodies[0].images.at(0)); }
  void see_nothing(const Command& command = {}) { see(nullptr, command); }
  const std::map<std::int64_t, Feature>& features() const { return estimator.cameras()[0].camera().features; }
  double position_error_m() const { return camera_error(truth, estimate.camera_state()).head<3>().norm(); }
};

TEST(CameraLost, ACoveredLensIsDegradedAndThenLost) {
  for (const bool covered : {true, false}) {  // or no image at all
    Tracked t;
    const std::size_t landmarks = t.estimate.landmarks.size();
    const auto before = t.features();
    if (!covered) t.see_nothing();  // is overdue a quarter of a period later
    for (int i = 1; i < t.settings.health.max_ticks; ++i) {
      covered ? t.see_gray() : t.see_nothing();
      EXPECT_EQ(t.estimate.status.state, TrackingState::degraded) << i;
      EXPECT_EQ(t.estimate.body().health.frames_with_few, i);
      EXPECT_EQ(t.estimate.last.matched, 0);
      EXPECT_NE(t.estimate.status.reason.find("0 of "), std::string::npos) << t.estimate.status.reason;
      ASSERT_EQ(t.estimate.landmarks.size(), landmarks) << "none is deleted, none begun";
    }
    covered ? t.see_gray() : t.see_nothing();
    EXPECT_EQ(t.estimate.status.state, TrackingState::lost);
    EXPECT_NE(t.estimate.status.reason.find("10 frames in a row with fewer than 3"), std::string::npos)
        << t.estimate.status.reason;
    ASSERT_EQ(t.estimate.landmarks.size(), landmarks);
    for (const auto& [id, feature] : t.features())
      EXPECT_EQ(feature.attempts, before.at(id).attempts) << "the lens failed, not the landmarks";
  }
}

TEST(CameraLost, NotAfterAShortBlink) {
  Tracked t;
  for (int i = 0; i < 5; ++i) t.see_gray();
  EXPECT_EQ(t.estimate.status.state, TrackingState::degraded);
  t.see(wall_with_sheet().shared_view(t.truth));
  EXPECT_EQ(t.estimate.status.state, TrackingState::tracking) << t.estimate.status.reason;
  EXPECT_EQ(t.estimate.body().health.frames_with_few, 0);
  EXPECT_LT(t.position_error_m(), 0.02);
}

TEST(CameraLost, WhenThePositionIsTooUncertain) {
  CameraSlamSettings settings = Tracked::defaults();
  settings.health.max_ticks = 1000;
  settings.health.max_sigma_position_m = 0.2;
  settings.filter.sigma_acceleration_m_s2 = 5;
  Tracked t(settings);
  double sigma_before = 0;
  for (int i = 0; t.estimate.status.state != TrackingState::lost; ++i) {
    ASSERT_LT(i, 60);
    sigma_before = sigma_position(t.estimate.body());
    ASSERT_LE(sigma_before, 0.2) << "beyond the limit it must say so";
    t.see_gray();
  }
  EXPECT_GT(sigma_before, 0.1) << "and not long before";
  EXPECT_NE(t.estimate.status.reason.find("position sigma"), std::string::npos) << t.estimate.status.reason;
  EXPECT_NE(t.estimate.status.reason.find("limit 0.2 m"), std::string::npos) << t.estimate.status.reason;
}

/// Without a limit in the world: relative to the wall, which it last saw 1.4 m away.
TEST(CameraLost, WhenThePositionIsTooUncertainRelativeToTheLandmarks) {
  CameraSlamSettings settings = Tracked::defaults();
  settings.health.max_ticks = 1000;
  settings.health.max_sigma_position_m = 1e6;
  settings.filter.sigma_acceleration_m_s2 = 5;
  Tracked t(settings);
  double sigma_before = 0;
  for (int i = 0; t.estimate.status.state != TrackingState::lost; ++i) {
    ASSERT_LT(i, 100);
    sigma_before = sigma_position(t.estimate.body());
    t.see_gray();
  }
  EXPECT_GT(sigma_before, 0.4);
  EXPECT_LT(sigma_before, 1);
  EXPECT_NE(t.estimate.status.reason.find("limit 0.5 of the distance"), std::string::npos)
      << t.estimate.status.reason;
}

void declare_lost(Tracked& t) {
  for (int i = 0; i < t.settings.health.max_ticks; ++i) t.see_gray();
  ASSERT_EQ(t.estimate.status.state, TrackingState::lost);
}

/// Nothing that is commanded or imagined moves a camera that is lost: it is looked for where it was.
TEST(CameraLost, StaysWhereItWas) {
  Tracked t;
  declare_lost(t);
  const CameraState there = t.estimate.camera_state();
  EXPECT_LT((there.head<3>() - t.truth.head<3>()).norm(), 0.1) << "ten frames further at the last velocity";
  EXPECT_TRUE(there.tail<6>().isZero(0)) << "at rest";
  const double sigma_m = sigma_position(t.estimate.body());
  EXPECT_GT(sigma_m, 0.1) << "as uncertain as a search around allows";
  EXPECT_LT(sigma_m, 0.3);
  const Eigen::MatrixXd P = t.estimate.belief.dense_covariance();
  const Command push{{BodyCommand{(SmallVector(6) << 3, -2, 1, 1, 1, -2).finished()}}};
  const auto elsewhere = Wall(1.4, 99).shared_view(t.truth);
  for (int i = 0; i < 30; ++i) {
    i % 3 == 0 ? t.see_nothing(push)
               : t.see(i % 3 == 1 ? seeing_gray(8).bodies[0].images.at(0) : elsewhere, push);
    ASSERT_EQ(t.estimate.status.state, TrackingState::lost) << i;
    EXPECT_EQ(t.estimate.camera_state(), there) << i;
    EXPECT_EQ(t.estimate.last.matched, 0) << "what matched by chance is not used";
    EXPECT_FALSE(t.estimate.status.reason.empty());
    for (const Match& match : t.estimate.last.matches) EXPECT_NE(match.outcome, MatchOutcome::matched);
  }
  EXPECT_EQ(t.estimate.belief.dense_covariance(), P);
}

/// How far it is looked for is a setting.
TEST(CameraLost, IsSearchedForWithinTheSigmasOfTheSettings) {
  CameraSlamSettings far = Tracked::defaults();
  far.health.sigma_search_position_m = 0.3, far.health.sigma_search_rotation_rad = 0.25;
  far.health.sigma_search_velocity_m_s = 0.7, far.health.sigma_search_rate_rad_s = 0.9;
  Tracked t(far);
  declare_lost(t);
  const Eigen::VectorXd sigmas = t.estimate.belief.covariance(t.estimate.body().block).diagonal().cwiseSqrt();
  EXPECT_GE(sigmas.head<3>().minCoeff(), 0.3) << "added to what it was";
  EXPECT_LT(sigmas.head<3>().maxCoeff(), 0.45);
  EXPECT_GE(sigmas.segment<3>(3).minCoeff(), 0.25);
  EXPECT_LT(sigmas.segment<3>(3).maxCoeff(), 0.45);
  EXPECT_NEAR((sigmas.segment<3>(6).array() - 0.7).abs().maxCoeff(), 0, 1e-9)
      << "at rest, as well as is known";
  EXPECT_NEAR((sigmas.tail<3>().array() - 0.9).abs().maxCoeff(), 0, 1e-9);
}

TEST(CameraLost, IsRelocatedWhenTheViewIsBack) {
  Tracked t;
  declare_lost(t);
  // Carried away from where it was lost, by as much as it is looked for
  t.truth = camera_at(t.truth.head<3>() + Eigen::Vector3d(0.03, -0.05, 0.02), 0.03);
  // Three frames in a row confirm it
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(t.estimate.status.state, TrackingState::lost) << i;
    t.see(wall_with_sheet().shared_view(t.truth));
  }
  ASSERT_EQ(t.estimate.status.state, TrackingState::relocated) << t.estimate.status.reason;
  EXPECT_GE(t.estimate.last.matched, 6);
  EXPECT_NE(t.estimate.status.reason.find(std::to_string(t.estimate.last.matched)), std::string::npos)
      << t.estimate.status.reason;
  EXPECT_EQ(t.estimate.body().health.frames_with_few, 0);
  EXPECT_LT(t.position_error_m(), 0.03);
  EXPECT_LT(sigma_position(t.estimate.body()), 0.1);
  for (int i = 0; i < 5; ++i) {
    t.see(wall_with_sheet().shared_view(t.truth));
    ASSERT_EQ(t.estimate.status.state, TrackingState::tracking) << t.estimate.status.reason;
  }
  EXPECT_LT(t.position_error_m(), 0.02);
  const auto error = camera_error(t.truth, t.estimate.camera_state());
  EXPECT_LT(error.segment<3>(3).norm(), 0.015);
}

/// Six agreeing matches end it; fewer may be chance.
TEST(CameraLost, IsNotRelocatedByAFewMatches) {
  Tracked t;
  declare_lost(t);
  Image part = Wall(1.4, 99).seen_from(t.truth);
  const Image whole = wall_with_sheet().seen_from(t.truth);
  // Another wall but around four of the landmarks
  const CameraState x = t.estimate.camera_state();
  int shown = 0;
  for (const auto& [id, landmark] : t.estimate.landmarks) {
    const auto at = position_of(landmark, t.estimate);
    if (!at || shown == 4) continue;
    const Eigen::Vector2d pixel = pixel_of(x, at->position);
    if (!camera.contains(pixel, 20)) continue;
    ++shown;
    for (int v = -12; v <= 12; ++v)
      for (int u = -12; u <= 12; ++u) {
        const int pu = static_cast<int>(pixel.x()) + u, pv = static_cast<int>(pixel.y()) + v;
        part(pu, pv) = whole(pu, pv);
      }
  }
  ASSERT_EQ(shown, 4);
  for (int i = 0; i < 3; ++i) {
    t.see(std::make_shared<const Image>(part));
    EXPECT_EQ(t.estimate.status.state, TrackingState::lost) << t.estimate.status.reason;
    EXPECT_EQ(t.estimate.camera_state(), x);
  }
}

/// The depth hypotheses of lines are those of a camera that was known: they go.
bool searches_rays(const Estimate& estimate) {
  return std::any_of(estimate.last.matches.begin(), estimate.last.matches.end(),
                     [](const Match& match) { return match.ray; });
}

TEST(CameraLost, ForgetsItsDepthLines) {
  CameraSlamSettings settings = Tracked::defaults();
  settings.initialization.method = InitializationSettings::Method::depth_line;
  settings.initialization.depth_ratio = 0.01;  // none becomes a point
  settings.initialization.max_line_failures = 1000;
  settings.map.wanted_visible = 16;
  SlamEstimator estimator = single_camera(camera, sheet_target(), settings, 10, 1);
  Estimate estimate;
  const auto view = wall_with_sheet().shared_view(origin);
  for (int k = 0; k < 5; ++k) estimator.update(estimate, {}, seeing(view), tick(k));
  ASSERT_GT(estimate.landmarks.size(), 8u);
  ASSERT_TRUE(searches_rays(estimate));
  for (int k = 5; estimate.status.state != TrackingState::lost; ++k) {
    ASSERT_LT(k, 30);
    // In ticks without an image nothing is left of the image before, which is gone
    estimator.update(estimate, {}, k % 2 ? Observation{} : seeing_gray(8), tick(k));
    EXPECT_FALSE(searches_rays(estimate));
  }
  EXPECT_EQ(estimate.landmarks.size(), 4u) << "the anchors stay";
  EXPECT_EQ(estimate.belief.errors(), 12);
}

/// Two cameras side by side; the lens of the second is covered and uncovered again.
struct TwoCameras {
  SlamEstimator estimator = of_two(Tracked::defaults());
  Estimate estimate;
  int k = 0;

  static SlamEstimator of_two(const CameraSlamSettings& s) {
    EstimatorSettings settings;
    settings.bodies = {free_camera_body(s.filter), free_camera_body(s.filter)};
    settings.health = s.health;
    std::vector<FeatureTracker> cameras;
    for (std::size_t body = 0; body < 2; ++body)
      cameras.emplace_back(camera, s, CameraPlacement{.body = body, .target = sheet_target()}, body + 1);
    return SlamEstimator(std::move(settings), std::move(cameras));
  }
  CameraState truth(std::size_t body) const {
    return camera_at({0, 0.02 * std::min(k, 8) - 0.1 * static_cast<double>(body), 0});
  }
  void see(bool second_is_covered) {
    Observation observation;
    for (std::size_t body = 0; body < 2; ++body)
      observation.bodies.push_back(seeing(wall_with_sheet().shared_view(truth(body))).bodies[0]);
    if (second_is_covered) observation.bodies[1] = seeing_gray(8).bodies[0];
    estimator.update(estimate, {}, observation, tick(k));
    ++k;
  }
  TrackingState state(std::size_t body) const { return estimate.bodies[body].status.state; }
};

TEST(CameraLost, DoesNotDisturbTheOtherBodiesOfATeam) {
  TwoCameras t;
  EXPECT_FALSE(t.estimator.cameras()[0].camera().settings.relocalization.close_loops) << "of one camera only";
  for (int i = 0; i < 12; ++i) t.see(false);
  ASSERT_EQ(t.estimate.status.state, TrackingState::tracking) << t.estimate.status.reason;
  for (int i = 0; i < 15; ++i) {
    t.see(true);
    ASSERT_EQ(t.state(0), TrackingState::tracking) << i << t.estimate.bodies[0].status.reason;
    EXPECT_LT(sigma_position(t.estimate.bodies[0]), 0.05) << "it is not searched for, which adds 0.1 m";
  }
  EXPECT_EQ(t.state(1), TrackingState::lost);
  EXPECT_GT(sigma_position(t.estimate.bodies[1]), 0.1);
  EXPECT_EQ(t.estimate.status.state, TrackingState::lost) << "of the body that is worst";
  EXPECT_EQ(t.estimate.status.reason.find("vehicle 2: 10 frames in a row"), 0u) << t.estimate.status.reason;
  for (int i = 0; i < 3; ++i) t.see(false);
  EXPECT_EQ(t.state(0), TrackingState::tracking);
  EXPECT_EQ(t.state(1), TrackingState::relocated) << t.estimate.bodies[1].status.reason;
  EXPECT_EQ(t.estimate.status.state, TrackingState::relocated);
  t.see(false);
  EXPECT_EQ(t.estimate.status.state, TrackingState::tracking) << t.estimate.status.reason;
  for (std::size_t body = 0; body < 2; ++body) {
    const auto error = camera_error(t.truth(body), t.estimate.belief.mean(t.estimate.bodies[body].block));
    EXPECT_LT(error.head<3>().norm(), 0.03) << body;
  }
}

}  // namespace
}  // namespace incognita
