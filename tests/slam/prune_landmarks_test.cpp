// Landmarks that are not detected again are deleted; real ones, anchors and what is out of view stay.
#include "incognita/slam/points/prune_landmarks.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>

#include "incognita/math/random.hpp"
#include "incognita/models/motion/arc_motion.hpp"
#include "incognita/models/sensors/range_bearing.hpp"
#include "incognita/slam/estimator/single_vehicle.hpp"
#include "incognita/slam/estimator/slam_estimator.hpp"

namespace incognita {
namespace {

using Pose = planar::Pose<double>;
using Method = DataAssociationSettings::Method;

PlanarSlamSettings settings_with(double min_detected_share) {
  PlanarSlamSettings s;
  s.vehicle.model = "differential-drive";
  s.vehicle.sigma_speed_m_s = 0.05;
  s.vehicle.sigma_turn_rate_rad_s = 0.02;
  s.sensor.sigma_range_m = 0.05;
  s.association.method = Method::joint;
  s.association.gate_probability = 0.999;
  s.association.initialization_probability = 0.999999;
  s.association.initialization_distance_m = 1;
  s.pruning.min_detected_share = min_detected_share;
  return s;
}

/// A circle of 10 m radius among twelve posts, four scans a second. Nine of ten posts in range are detected, and in
/// every fourth scan something that is nowhere.
struct Circling {
  static constexpr double dt = 0.25, range_m = 12;
  Pose truth{0, 0, 0};
  RandomStream random;
  std::vector<Eigen::Vector2d> posts;
  double spurious = 0.25;
  std::int64_t frame = 0;

  explicit Circling(int seed = 1) : random(static_cast<std::uint64_t>(seed), "circling") {
    for (int i = 0; i < 12; ++i) {
      const double angle = i * M_PI / 6, radius = i % 2 == 0 ? 5 : 15;
      posts.emplace_back(radius * std::cos(angle), 10 + radius * std::sin(angle));
    }
  }

  PointDetection noisy(const Eigen::Vector2d& z, const PlanarSlamSettings& s) {
    return {Detection::unknown,
            Eigen::Vector2d(z[0] + s.sensor.sigma_range_m * random.normal(),
                            wrap_angle(z[1] + s.sensor.sigma_bearing_rad * random.normal()))};
  }

  void step(SlamEstimator& estimator, Estimate& e, const PlanarSlamSettings& s) {
    Observation observation;
    BodyObservation& body = observation.bodies.emplace_back();
    const double t = dt * static_cast<double>(frame);
    const Eigen::Vector2d input(1, 0.1);
    if (frame > 0) {
      const Eigen::Vector2d off(s.vehicle.sigma_speed_m_s * random.normal(),
                                s.vehicle.sigma_turn_rate_rad_s * random.normal());
      truth = ArcMotion<DifferentialDrive>{}.f<double>(truth, input + off, dt);
    }
    body.odometry = {{t, input}};
    for (const Eigen::Vector2d& post : posts) {
      const Eigen::Vector2d z = RangeBearing::h<double>(truth, post);
      if (z[0] < range_m && random.uniform(0, 1) < 0.9) body.landmarks.push_back(noisy(z, s));
    }
    if (random.uniform(0, 1) < spurious)
      body.landmarks.push_back(noisy({random.uniform(2, range_m), random.uniform(-M_PI, M_PI)}, s));
    estimator.update(e, {}, observation, {frame, t, frame > 0 ? dt : 0});
    ++frame;
  }

  Estimate run(const PlanarSlamSettings& s, int scans = 500) {
    SlamEstimator estimator(single_vehicle(s));
    Estimate e;
    for (int k = 0; k < scans; ++k) step(estimator, e, s);
    return e;
  }

  /// Posts without a landmark within half a meter, and landmarks farther than that from every post.
  std::pair<int, int> missing_and_spurious(const Estimate& e) const {
    int missing = 0, wrong = 0;
    const auto near = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return (a - b).norm() < 0.5; };
    for (const Eigen::Vector2d& post : posts)
      missing += std::ranges::none_of(
          e.landmarks, [&](const auto& l) { return near(position_of(l.second, e)->position, post); });
    for (const auto& [id, landmark] : e.landmarks)
      wrong += std::ranges::none_of(
          posts, [&](const auto& post) { return near(position_of(landmark, e)->position, post); });
    return {missing, wrong};
  }
};

TEST(LandmarkPruning, DeletesSpuriousLandmarksAndKeepsRealOnes) {
  Circling never, some;
  const auto [missing_before, wrong_before] = never.missing_and_spurious(never.run(settings_with(0)));
  const auto [missing, wrong] = some.missing_and_spurious(some.run(settings_with(0.1)));
  EXPECT_EQ(missing_before, 0);
  EXPECT_GT(wrong_before, 40);
  EXPECT_EQ(missing, 0);
  EXPECT_LT(wrong, wrong_before / 3) << "of " << wrong_before << "; the last were not expected often enough";
}

TEST(LandmarkPruning, ChangesNothingWithoutSpuriousDetections) {
  Circling a, b;
  a.spurious = b.spurious = 0;
  const Estimate never = a.run(settings_with(0), 200), some = b.run(settings_with(0.1), 200);
  EXPECT_EQ(never.landmarks.size(), some.landmarks.size());
  EXPECT_EQ(Pose(never.bodies[0].state), Pose(some.bodies[0].state));
}

TEST(LandmarkPruning, NeverDeletesAnchors) {
  PlanarSlamSettings s = settings_with(0.5);
  const Eigen::Vector2d nowhere(0, 10);  // in view all the time, and never detected
  s.filter.anchors = {nowhere, {5, 10}};
  Circling drive;
  const Estimate e = drive.run(s, 300);
  int anchors = 0;
  for (const auto& [id, landmark] : e.landmarks) anchors += landmark.fixed;
  EXPECT_EQ(anchors, 2);
}

TEST(LandmarkPruning, DeletesWhatHasGoneAndKeepsWhatIsOutOfView) {
  Circling drive;
  const PlanarSlamSettings s = settings_with(0.1);
  SlamEstimator estimator(single_vehicle(s));
  Estimate e;
  drive.spurious = 0;
  for (int k = 0; k < 30; ++k) drive.step(estimator, e, s);
  ASSERT_GE(e.landmarks.size(), 4u);
  drive.posts.erase(drive.posts.begin() + 9, drive.posts.end());  // among them some that it has just seen
  for (int k = 0; k < 1200; ++k) drive.step(estimator, e, s);
  const auto [missing, gone] = drive.missing_and_spurious(e);
  EXPECT_EQ(missing, 0) << "each is out of range for half of the circle";
  EXPECT_EQ(gone, 0);
}

TEST(LandmarkPruning, DoesNotCountScansThatMatchNothing) {
  Circling drive;
  PlanarSlamSettings s = settings_with(0.9);
  SlamEstimator estimator(single_vehicle(s));
  Estimate e;
  drive.spurious = 0;
  for (int k = 0; k < 12; ++k) drive.step(estimator, e, s);
  std::map<std::int64_t, int> before;
  for (const auto& [id, landmark] : e.landmarks) before[id] = landmark.expected_scans;
  drive.truth.head<2>() += Eigen::Vector2d(300, 300);  // it was carried away
  for (Eigen::Vector2d& post : drive.posts) post += Eigen::Vector2d(302, 297);
  drive.posts.resize(1);
  const int matched_before = e.last.matched;
  drive.step(estimator, e, s);
  ASSERT_GT(matched_before, 0);
  if (e.last.matched == 0) {
    for (const auto& [id, expected] : before) EXPECT_EQ(e.landmarks.at(id).expected_scans, expected);
  }
}

TEST(LandmarkPruning, LeavesAloneWhatHasAnIdentity) {
  PlanarSlamSettings s = settings_with(1);
  s.association.method = Method::known;
  SlamEstimator estimator(single_vehicle(s));
  Estimate e;
  const auto scan = [&](std::int64_t frame, std::vector<PointDetection> detections) {
    Observation observation;
    observation.bodies.resize(1);
    observation.bodies[0].odometry = {{static_cast<double>(frame), {0, 0}}};
    observation.bodies[0].landmarks = std::move(detections);
    estimator.update(e, {}, observation, {frame, static_cast<double>(frame), frame > 0 ? 1.0 : 0.0});
  };
  const auto seen = [](std::int64_t id, double range_m, double bearing_rad) {
    return PointDetection{id, Eigen::Vector2d(range_m, bearing_rad)};
  };
  scan(0, {seen(1, 5, 0.1), seen(2, 5, 0.4), seen(3, 5, -0.4)});
  for (std::int64_t k = 1; k < 60; ++k) scan(k, {seen(2, 5, 0.4), seen(3, 5, -0.4)});
  EXPECT_EQ(e.landmarks.size(), 3u);
}

TEST(LandmarkPruning, LeavesTheEstimateConsistent) {
  const PlanarSlamSettings s = settings_with(0.1);
  constexpr int runs = 30;
  double nees = 0;
  for (int seed = 1; seed <= runs; ++seed) {
    Circling drive(seed);
    const Estimate e = drive.run(s, 160);
    Pose error = Pose(e.bodies[0].state) - drive.truth;
    error[2] = wrap_angle(error[2]);
    nees += error.dot(Eigen::Matrix3d(e.bodies[0].state_covariance).llt().solve(error));
  }
  // Chi-square of 90 degrees of freedom: 99.9 % between 52 and 138
  EXPECT_GT(nees, 45);
  EXPECT_LT(nees, 145);
}

}  // namespace
}  // namespace incognita
