// Delayed initialization of points that a camera detects: thesis Section 6.3.1 and C.3.
#include "incognita/slam/points/depth_lines.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "incognita/math/random.hpp"
#include "incognita/math/saved_state/matrices.hpp"
#include "incognita/models/sensors/camera_sensors.hpp"
#include "incognita/slam/estimator/slam_estimator.hpp"
#include "incognita/slam/mapper/saved_estimate.hpp"

namespace incognita {
namespace {

using Points = std::map<std::int64_t, Eigen::Vector3d>;
using Method = DataAssociationSettings::Method;
constexpr double line_sigma_px = 2, speed_m_s = 0.3, dt = 0.05;

/// A camera that moves to the right, along x, and looks along z.
CameraState camera_at_start() {
  CameraState x = CameraState::Zero();
  x[3] = 1;
  x[7] = speed_m_s;
  return x;
}

EstimatorSettings settings_with_lines(Method method = Method::known) {
  EstimatorSettings s;
  s.bodies.push_back(body_with_sensor(FreeCameraMotion{}, CameraSensor{}, camera_at_start(),
                                      SmallVector::Constant(12, 1e-4), SmallVector::Constant(6, 1e-3),
                                      Eigen::Vector2d::Constant(line_sigma_px)));
  s.depth_lines = DepthLineSettings{};
  s.association = {.method = method,
                   .gate_probability = 0.9999,
                   .initialization_probability = 0.99999999,
                   .initialization_distance_m = 0};
  return s;
}

/// What the camera detects of the points, tick by tick.
class Sliding {
 public:
  Sliding(EstimatorSettings settings, Points points, int seed = 1)
      : estimator(std::move(settings)),
        points_(std::move(points)),
        random_(static_cast<std::uint64_t>(seed), "sliding") {}

  void step() {
    const FreeCameraMotion motion;
    if (frame_ > 0) truth_ = motion.f<double>(truth_, Eigen::Matrix<double, 6, 1>::Zero(), dt);
    Observation observation;
    BodyObservation& body = observation.bodies.emplace_back();
    body.input = SmallVector::Zero(6);
    const bool by_identity = estimator.settings().association.method == Method::known;
    for (const auto& [id, point] : points_) {
      const auto at = camera_.project(PointLandmark::in_camera<double>(truth_, point));
      const Eigen::Vector2d noise(line_sigma_px * random_.normal(), line_sigma_px * random_.normal());
      if (!at || !camera_.contains(at->pixel) || hidden.count(id) > 0) continue;
      const bool identified = by_identity || estimator.settings().anchors.contains(id);
      body.landmarks.push_back({identified ? id : Detection::unknown, at->pixel + noise});
    }
    estimator.update(e, {}, observation, {frame_, dt * static_cast<double>(frame_), frame_ > 0 ? dt : 0});
    ++frame_;
  }
  void steps(int count) {
    for (int i = 0; i < count; ++i) step();
  }
  void state(StateArchive& archive) {
    estimate_state(archive, e);
    archive(estimator, random_, truth_, frame_);
  }

  const Landmark& landmark(std::int64_t id) const { return e.landmarks.at(id); }
  bool has_point(std::int64_t id) const { return e.landmarks.count(id) > 0 && landmark(id).mapped(); }

  SlamEstimator estimator;
  Estimate e;
  std::map<std::int64_t, bool> hidden;

 private:
  Camera camera_ = CameraSensor{}.camera;
  Points points_;
  RandomStream random_;
  CameraState truth_ = camera_at_start();
  std::int64_t frame_ = 0;
};

std::string saved(Sliding& sliding) {
  StateWriter writer;
  StateArchive{writer}(sliding);
  return writer.take();
}

TEST(DepthLines, ADetectionStartsARayThatCorrectsNothing) {
  Sliding sliding(settings_with_lines(), {{7, {0.3, 0.2, 3}}});
  sliding.step();
  ASSERT_EQ(sliding.e.landmarks.count(7), 1u);
  EXPECT_FALSE(sliding.has_point(7));
  EXPECT_EQ(sliding.e.mapped_count(), 0);
  EXPECT_EQ(sliding.e.belief.errors(), 12 + 5);
  EXPECT_EQ(sliding.e.last.matches.at(0).outcome, MatchOutcome::initialized);
  const std::vector<DepthHypothesis>& depths = sliding.estimator.depth_lines().lines().at(7).depths;
  ASSERT_EQ(depths.size(), 100u);
  const Eigen::VectorXd ray = sliding.e.belief.mean(sliding.landmark(7).block);
  const double length = Eigen::Vector3d(ray[3], ray[4], 1).norm();
  EXPECT_NEAR(length / depths.front().inverse_depth, 0.5, 1e-12) << "along the ray";
  EXPECT_NEAR(length / depths.back().inverse_depth, 5, 1e-12);
  sliding.step();
  const Match& match = sliding.e.last.matches.at(0);
  EXPECT_EQ(match.id, 7);
  EXPECT_TRUE(match.ray);
  EXPECT_EQ(match.outcome, MatchOutcome::matched);
  EXPECT_EQ(match.particle_count, 100);
  EXPECT_LT((match.measured - match.predicted).norm(), 20);
  EXPECT_EQ(sliding.e.last.matched, 0) << "it corrects no pose";
}

/// The depth along the ray with its sigma when the landmark enters the map; of a camera that moves across the ray.
struct Entry {
  int ticks = 0;
  double error_m = 0, sigma_m = 0, depth_m = 0;
  double nees = 0;  ///< of the three numbers, per number
};

std::optional<Entry> entry_of(Sliding& sliding, std::int64_t id, const Eigen::Vector3d& truth,
                              int most_ticks) {
  for (int ticks = 1; ticks <= most_ticks; ++ticks) {
    sliding.step();
    if (!sliding.has_point(id)) continue;
    const BlockId block = sliding.landmark(id).block;
    const Eigen::Vector3d mean = sliding.e.belief.mean(block), error = truth - mean;
    const Eigen::Matrix3d P = sliding.e.belief.covariance(block);
    const Eigen::Vector3d along = mean.normalized();
    return Entry{ticks, error.dot(along), std::sqrt(along.dot(P * along)), mean.norm(),
                 error.dot(P.inverse() * error) / 3};
  }
  return std::nullopt;
}

TEST(DepthLines, EntersTheMapWhenSigmaOverDepthIsSmall) {
  const Eigen::Vector3d truth(0.3, 0.2, 3);
  Sliding sliding(settings_with_lines(), {{7, truth}});
  const auto entry = entry_of(sliding, 7, truth, 100);
  ASSERT_TRUE(entry);
  EXPECT_GT(entry->ticks, 2);
  EXPECT_LT(entry->sigma_m, 0.31 * entry->depth_m);
  EXPECT_GT(entry->sigma_m, 0.15 * entry->depth_m) << "at once when it is small";
  EXPECT_LT(std::abs(entry->error_m), 3 * entry->sigma_m);
  EXPECT_EQ(sliding.e.belief.errors(), 12 + 3);
  EXPECT_TRUE(sliding.estimator.depth_lines().lines().empty());
  sliding.step();
  EXPECT_EQ(sliding.e.last.matched, 1) << "it corrects the filter from now on";
}

TEST(DepthLines, TheRatioOfTheSettingsDecides) {
  const Eigen::Vector3d truth(0.3, 0.2, 3);
  int before = 0;
  for (const double ratio : {0.3, 0.2, 0.1}) {
    EstimatorSettings settings = settings_with_lines();
    settings.depth_lines->depth_ratio = ratio;
    Sliding sliding(settings, {{7, truth}});
    const auto entry = entry_of(sliding, 7, truth, 300);
    ASSERT_TRUE(entry) << ratio;
    EXPECT_GT(entry->ticks, before) << ratio;
    EXPECT_LT(entry->sigma_m, 1.05 * ratio * entry->depth_m);
    before = entry->ticks;
  }
}

/// Errors of the points that entered the map, over noise.
struct Errors {
  int entered = 0;
  double squares = 0;  ///< of the depth error over its sigma, mean
  double nees = 0;     ///< mean
};

Errors errors_at(double depth_m, int seeds) {
  Errors errors;
  for (int seed = 1; seed <= seeds; ++seed) {
    const Eigen::Vector3d truth(0.3, 0.2, depth_m);
    Sliding sliding(settings_with_lines(), {{7, truth}}, seed);
    const auto entry = entry_of(sliding, 7, truth, 200);
    if (!entry) continue;
    ++errors.entered;
    errors.squares += std::pow(entry->error_m / entry->sigma_m, 2);
    errors.nees += entry->nees;
  }
  errors.squares /= errors.entered;
  errors.nees /= errors.entered;
  return errors;
}

/// The method of the thesis is overconfident: every match counts the noise of the first detection as if it were drawn anew.
TEST(DepthLines, InitialCovarianceIsOverconfidentWithinLimits) {
  for (const double depth_m : {1.5, 2.5, 3.5, 4.5}) {
    const Errors errors = errors_at(depth_m, 100);
    EXPECT_EQ(errors.entered, 100) << depth_m;
    EXPECT_GT(errors.squares, 0.5) << depth_m;
    EXPECT_LT(errors.squares, 5) << depth_m;
    EXPECT_LT(errors.nees, 4) << depth_m;
  }
}

/// The hypotheses of the thesis end at 5 m: a point at infinity enters as soon as those below 1.6 m are refuted.
TEST(DepthLines, APointBeyondTheHypothesesEntersTooNear) {
  Sliding sliding(settings_with_lines(), {{7, {3e6, 1e6, 1e7}}});
  int tick = 0;
  while (!sliding.has_point(7) && tick < 400) sliding.step(), ++tick;
  ASSERT_LT(tick, 400);
  EXPECT_LT(sliding.e.belief.mean(sliding.landmark(7).block).norm(), 5);
}

/// The estimate turns by 3 rad in a tick, which the gateless association by identity does not refute.
TEST(DepthLines, ALineBehindTheCameraIsNotMatched) {
  EstimatorSettings settings = settings_with_lines();
  settings.bodies[0].start[11] = 60;
  Sliding sliding(settings, {{7, {0.3, 0.2, 3}}});
  sliding.steps(2);
  const Match& match = sliding.e.last.matches.at(0);
  EXPECT_FALSE(match.ray);
  EXPECT_NE(match.outcome, MatchOutcome::matched);
}

TEST(DepthLines, ALineIsDroppedAfterTicksWithoutAMatch) {
  EstimatorSettings settings = settings_with_lines();
  settings.depth_lines->depth_ratio = 1e-9;  // it stays a line
  Sliding sliding(settings, {{7, {0.3, 0.2, 3}}});
  sliding.steps(10);
  sliding.hidden[7] = true;
  sliding.steps(9);
  EXPECT_EQ(sliding.e.landmarks.count(7), 1u);
  sliding.hidden.clear();
  sliding.step();  // the count starts again
  sliding.hidden[7] = true;
  sliding.steps(9);
  EXPECT_EQ(sliding.e.landmarks.count(7), 1u);
  sliding.step();
  EXPECT_EQ(sliding.e.landmarks.count(7), 0u);
  EXPECT_TRUE(sliding.estimator.depth_lines().lines().empty());
  EXPECT_EQ(sliding.e.belief.errors(), 12);
}

/// Points that are far apart in the image.
Points scattered() {
  return {{10, {-0.6, -0.5, 2}}, {11, {0.2, 0.4, 1.5}}, {12, {1.2, -0.8, 3}}, {13, {0.9, 1, 3.5}}};
}

/// By position each point has one line, and one landmark.
TEST(DepthLines, NearestNeighborsContinueALine) {
  for (int seed = 1; seed <= 20; ++seed) {
    Sliding sliding(settings_with_lines(Method::nearest), scattered(), seed);
    sliding.step();
    EXPECT_EQ(sliding.estimator.depth_lines().lines().size(), 4u);
    for (int tick = 0; tick < 60; ++tick) {
      sliding.step();
      ASSERT_EQ(sliding.e.landmarks.size(), 4u) << "seed " << seed << ", tick " << tick;
    }
    EXPECT_EQ(sliding.e.mapped_count(), 4);
    for (const auto& [id, point] : scattered()) {
      double nearest_m = 1e9;
      for (const auto& [number, landmark] : sliding.e.landmarks)
        nearest_m =
            std::min(nearest_m, (Eigen::Vector3d(sliding.e.belief.mean(landmark.block)) - point).norm());
      EXPECT_LT(nearest_m, 0.5) << "seed " << seed << ", point " << id;
    }
  }
}

/// What is given as identities does not matter then.
TEST(DepthLines, IdentitiesMatterToNoNearestNeighbor) {
  Sliding a(settings_with_lines(Method::nearest), scattered());
  Points renamed;
  for (const auto& [id, point] : scattered()) renamed[id + 100] = point;
  Sliding b(settings_with_lines(Method::nearest), renamed);
  a.steps(40);
  b.steps(40);
  EXPECT_EQ(saved(a), saved(b));
}

TEST(DepthLines, AsManyAsAreWantedInView) {
  for (const Method method : {Method::known, Method::nearest}) {
    EstimatorSettings settings = settings_with_lines(method);
    settings.anchors[1] = Eigen::Vector3d(0, 0, 4);
    settings.wanted_visible = 3;
    Points points = scattered();
    points[1] = settings.anchors[1];
    Sliding sliding(settings, points);
    sliding.step();
    EXPECT_EQ(sliding.estimator.depth_lines().lines().size(), 2u) << "one in view is an anchor";
    int full = 0;
    for (int tick = 0; tick < 200; ++tick) {
      sliding.step();
      const auto in_view = std::ranges::count(sliding.e.last.matches, MatchOutcome::matched, &Match::outcome);
      ASSERT_LE(in_view, 3) << tick;
      full += in_view == 3;
    }
    EXPECT_GT(full, 150) << "others take the place of those out of view";
  }
}

/// Those farthest from what is in the image already: "widely distributed".
TEST(DepthLines, NewLinesAreWidelyDistributed) {
  EstimatorSettings settings = settings_with_lines();
  settings.anchors[1] = Eigen::Vector3d(-1, 0, 4);
  settings.wanted_visible = 2;
  const Points points{{1, {-1, 0, 4}}, {2, {-0.9, 0, 4}}, {3, {1, 0, 4}}, {4, {0, 0, 4}}};
  Sliding sliding(settings, points);
  sliding.step();
  ASSERT_EQ(sliding.estimator.depth_lines().lines().size(), 1u);
  EXPECT_EQ(sliding.estimator.depth_lines().lines().begin()->first, 3);
}

TEST(DepthLines, TheSameSeedGivesTheSameBytes) {
  Sliding a(settings_with_lines(Method::nearest), scattered(), 5),
      b(settings_with_lines(Method::nearest), scattered(), 5),
      other(settings_with_lines(Method::nearest), scattered(), 6);
  a.steps(30);
  b.steps(30);
  other.steps(30);
  EXPECT_EQ(saved(a), saved(b));
  EXPECT_NE(saved(a), saved(other));
}

TEST(DepthLines, ASavedRunGoesOnWithTheSameBytes) {
  EstimatorSettings settings = settings_with_lines(Method::nearest);
  Sliding whole(settings, scattered());
  whole.steps(2);
  ASSERT_EQ(whole.estimator.depth_lines().lines().size(), 4u) << "or no line is saved";
  const std::string bytes = saved(whole);
  Sliding resumed(settings, scattered(), 99);
  StateReader reader(bytes);
  StateArchive{reader}(resumed);
  EXPECT_EQ(reader.left(), 0u);
  for (int tick = 0; tick < 60; ++tick) {
    whole.step();
    resumed.step();
    ASSERT_EQ(saved(whole), saved(resumed)) << tick;
  }
  EXPECT_EQ(whole.e.mapped_count(), 4);
}

TEST(DepthLines, AreRefusedForSensorsWithDistances) {
  EstimatorSettings settings = settings_with_lines();
  settings.bodies[0].sensors[0].sensor = StereoSensor{};
  settings.bodies[0].sensors[0].sigmas = Eigen::Vector3d::Ones();
  EXPECT_NE(validate(settings).find("monocular"), std::string::npos) << validate(settings);
  EXPECT_EQ(validate(settings_with_lines()), "");
}

}  // namespace
}  // namespace incognita
