// The planar estimator by hand-made observations: starts, matches, births, refusals, frames and filters.
#include "incognita/slam/points/planar_estimator.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "incognita/math/gaussian.hpp"
#include "incognita/math/random.hpp"
#include "incognita/models/range_bearing.hpp"
#include "incognita/slam/points/planar_looks.hpp"
#include "incognita/slam/points/planar_motion.hpp"

namespace incognita {
namespace {

using Pose = planar::Pose<double>;

PlanarSlamSettings drive_settings() {
  PlanarSlamSettings s;
  s.vehicle.model = "differential-drive";
  s.vehicle.sensor_forward_m = s.vehicle.sensor_left_m = 0;
  s.vehicle.sigma_speed_m_s = 0.05;
  s.vehicle.sigma_turn_rate_rad_s = 0.02;
  s.sensor.sigma_range_m = 0.05;
  s.association.method = "known";
  return s;
}

const std::vector<Eigen::Vector2d> landmarks{{5, 3}, {8, -2}, {2, 6}, {12, 4}};

/// A drive along a gentle curve, a tick a second, exact but for the given noise.
struct Drive {
  Pose truth{0, 0, 0};
  RandomStream random{1, "test drive"};
  double noise = 1;
  std::int64_t frame = 0;

  Observation next(const PlanarSlamSettings& s) {
    Observation seen;
    const double t = static_cast<double>(frame);
    if (frame > 0) {
      const Eigen::Vector2d off(s.vehicle.sigma_speed_m_s * random.normal() * noise,
                                s.vehicle.sigma_turn_rate_rad_s * random.normal() * noise);
      truth = DifferentialDrive{}.f<double>(truth, Eigen::Vector2d(0.5, 0.05) + off, 1);
    }
    seen.odometry = {{t, {0.5, 0.05}}};
    for (std::size_t i = 0; i < landmarks.size(); ++i) {
      const Eigen::Vector2d z = RangeBearing::h<double>(truth, landmarks[i]);
      seen.detections.push_back({z[0] + noise * s.sensor.sigma_range_m * random.normal(),
                                 wrap_angle(z[1] + noise * s.sensor.sigma_bearing_rad * random.normal()),
                                 static_cast<std::int64_t>(i)});
    }
    return seen;
  }
  void step(const PlanarEstimator& estimator, PlanarEstimate& e, const PlanarSlamSettings& s) {
    const Observation seen = next(s);
    estimator.update(e, {}, seen, tick());
  }
  Tick tick() { return {frame, static_cast<double>(frame), frame++ > 0 ? 1.0 : 0.0}; }
};

PlanarEstimate run(const PlanarSlamSettings& s, int ticks, double noise = 1, bool anonymous = false,
                   Drive* out = nullptr) {
  const PlanarEstimator estimator(s);
  PlanarEstimate e;
  Drive drive;
  drive.noise = noise;
  for (int k = 0; k < ticks; ++k) {
    Observation seen = drive.next(s);
    if (anonymous)
      for (Detection& d : seen.detections) d.identity = Detection::unknown;
    estimator.update(e, {}, seen, drive.tick());
  }
  if (out) *out = drive;
  return e;
}

TEST(PlanarEstimator, MapsWhatItSees) {
  for (const char* method : {"known", "nearest", "joint"}) {
    PlanarSlamSettings s = drive_settings();
    s.association.method = method;
    Drive drive;
    const PlanarEstimate e = run(s, 30, 1, s.association.method != "known", &drive);
    ASSERT_EQ(e.catalogue.size(), landmarks.size()) << method;
    for (std::size_t i = 0; i < landmarks.size(); ++i)
      EXPECT_LT((position_of(e.catalogue[i], e).position - landmarks[i]).norm(), 0.2) << method;
    EXPECT_LT((vehicle_pose(e).pose - drive.truth).norm(), 0.2);
    EXPECT_EQ(e.status.state, TrackingState::tracking);
    EXPECT_EQ(e.matched, 4);
  }
}

TEST(PlanarEstimator, EveryFilterIsTheSameWhereNothingIsToLinearise) {
  PlanarSlamSettings s = drive_settings();
  s.vehicle.sigma_speed_m_s = s.vehicle.sigma_turn_rate_rad_s = 1e-7;
  s.sensor.sigma_range_m = s.sensor.sigma_bearing_rad = 1e-7;
  const PlanarEstimate plain = run(s, 20);
  const Eigen::Matrix3d P = vehicle_pose(plain).covariance;
  for (const char* lineariser : {"iterated", "unscented-vehicle", "first-estimate"}) {
    s.filter.lineariser = lineariser;
    const PlanarEstimate other = run(s, 20);
    EXPECT_LT((vehicle_pose(other).pose - vehicle_pose(plain).pose).norm(), 1e-11) << lineariser;
    EXPECT_LT((vehicle_pose(other).covariance - P).norm(), 1e-3 * P.norm()) << lineariser;
  }
  s.filter.lineariser = "analytic";
  s.filter.map_frame = "vehicle";
  const PlanarEstimate relative = run(s, 20);
  EXPECT_LT((vehicle_pose(relative).pose - vehicle_pose(plain).pose).norm(), 1e-11);
  EXPECT_LT((vehicle_pose(relative).covariance - P).norm(), 1e-3 * P.norm());
  for (std::size_t i = 0; i < landmarks.size(); ++i) {
    const PlanarPosition a = position_of(relative.catalogue[i], relative),
                         b = position_of(plain.catalogue[i], plain);
    EXPECT_LT((a.position - b.position).norm(), 1e-11);
    EXPECT_LT((a.covariance - b.covariance).norm(), 1e-3 * b.covariance.norm());
  }
}

TEST(PlanarEstimator, FirstEstimatesGainNoHeadingWithoutAnchors) {
  PlanarSlamSettings s = drive_settings();
  s.start.sigma_heading_rad = 0.2;
  const double analytic = vehicle_pose(run(s, 60)).covariance(2, 2);
  s.filter.lineariser = "first-estimate";
  const double kept = vehicle_pose(run(s, 60)).covariance(2, 2);
  EXPECT_GE(kept, 0.04 * (1 - 1e-9));
  EXPECT_LT(analytic, 0.04);
}

TEST(PlanarEstimator, AnchorsAndFixesFixTheFrame) {
  for (const char* frame : {"world", "vehicle"}) {
    PlanarSlamSettings s = drive_settings();
    s.filter.map_frame = frame;
    s.start = {{0.3, -0.2}, 0.1, false, 0.5, 0.2};
    s.filter.anchors = {landmarks[0], landmarks[1]};
    s.association.method = "joint";
    Drive drive;
    const PlanarEstimate anchored = run(s, 40, 1, true, &drive);
    EXPECT_LT((vehicle_pose(anchored).pose - drive.truth).norm(), 0.15) << frame;
    EXPECT_EQ(anchored.catalogue.size(), 4u) << frame;
    EXPECT_EQ(position_of(anchored.catalogue[0], anchored).covariance.norm(), 0) << frame;
  }
}

TEST(PlanarEstimator, FixesAreUsedInEitherFrame) {
  for (const char* frame : {"world", "vehicle"}) {
    PlanarSlamSettings s = drive_settings();
    s.filter.map_frame = frame;
    s.filter.use_fixes = true;
    s.filter.sigma_fix_m = 0.05;
    s.start = {{1, 1}, 0.2, false, 1, 0.4};
    const PlanarEstimator estimator(s);
    PlanarEstimate e;
    Drive drive;
    for (int k = 0; k < 40; ++k) {
      Observation seen = drive.next(s);
      seen.fixes = {{static_cast<double>(drive.frame), drive.truth.head<2>()}};
      estimator.update(e, {}, seen, drive.tick());
    }
    EXPECT_LT((vehicle_pose(e).pose - drive.truth).norm(), 0.1) << frame;
  }
}

TEST(PlanarEstimator, WaitsForTheFirstFixWhenItIsToStartThere) {
  PlanarSlamSettings s = drive_settings();
  s.start.at_first_fix = true;
  const PlanarEstimator estimator(s);
  PlanarEstimate e;
  Observation seen;
  estimator.update(e, {}, seen, {0, 0, 0});
  EXPECT_FALSE(e.started);
  EXPECT_EQ(e.status.state, TrackingState::starting);
  EXPECT_FALSE(e.status.reason.empty());
  seen.fixes = {{1, {3, 4}}};
  estimator.update(e, {}, seen, {1, 1, 1});
  EXPECT_TRUE(e.started);
  EXPECT_EQ(vehicle_pose(e).pose.head<2>(), Eigen::Vector2d(3, 4));
}

TEST(PlanarEstimator, RefusesAKnownLandmarkFarFromWhereItIs) {
  const PlanarSlamSettings s = drive_settings();
  const PlanarEstimator estimator(s);
  PlanarEstimate e;
  Drive drive;
  for (int k = 0; k < 10; ++k) drive.step(estimator, e, s);
  Observation seen = drive.next(s);
  seen.detections[2].range_m += 3;
  estimator.update(e, {}, seen, drive.tick());
  EXPECT_EQ(e.matched, 3);
  EXPECT_EQ(e.looks[2].outcome, LookOutcome::inconsistent);
  EXPECT_EQ(e.catalogue.size(), 4u);
}

TEST(PlanarEstimator, LeavesAloneWhatHasNoIdentityWhereIdentitiesAreWanted) {
  const PlanarSlamSettings s = drive_settings();
  EXPECT_TRUE(run(s, 5, 1, true).catalogue.empty());
}

TEST(PlanarEstimator, TwoDetectionsOfOnePlaceAreOneLandmark) {
  PlanarSlamSettings s = drive_settings();
  s.association.method = "joint";
  const PlanarEstimator estimator(s);
  PlanarEstimate e;
  Observation seen;
  seen.detections = {{5, 0.1}, {5.02, 0.1}, {9, -1}};
  estimator.update(e, {}, seen, {0, 0, 0});
  EXPECT_EQ(e.catalogue.size(), 2u);
  EXPECT_EQ(e.looks[0].outcome, LookOutcome::born);
  EXPECT_NE(e.looks[1].outcome, LookOutcome::born);
}

TEST(PlanarEstimator, SaysThatItIsLost) {
  PlanarSlamSettings s = drive_settings();
  s.lost.max_sigma_position_m = 0.3;
  const PlanarEstimator estimator(s);
  PlanarEstimate e;
  for (int k = 0; k < 200; ++k) {
    Observation blind;
    blind.odometry = {{static_cast<double>(k), {1, 0.1}}};
    estimator.update(e, {}, blind, {k, static_cast<double>(k), k > 0 ? 1.0 : 0.0});
  }
  EXPECT_EQ(e.status.state, TrackingState::lost);
  EXPECT_NE(e.status.reason.find("the limit is 0.3"), std::string::npos) << e.status.reason;
}

TEST(PlanarEstimator, IsLostWhenNothingIsWhereItShouldBe) {
  PlanarSlamSettings s = drive_settings();
  const PlanarEstimator estimator(s);
  PlanarEstimate e;
  Drive drive;
  for (int k = 0; k < 5; ++k) drive.step(estimator, e, s);
  for (int k = 0; k < s.lost.max_unmatched_scans; ++k) {
    Observation seen = drive.next(s);
    for (Detection& d : seen.detections) d.range_m += 20;
    estimator.update(e, {}, seen, drive.tick());
  }
  EXPECT_EQ(e.status.state, TrackingState::lost);
}

/// An input is held until the next reading, whatever the ticks are.
TEST(PlanarMotion, HoldsEachInputUntilTheNext) {
  PlanarSlamSettings s = drive_settings();
  const PlanarEstimator estimator(s);
  PlanarEstimate e;
  Observation first, second;
  first.odometry = {{0, {1, 0}}};
  second.odometry = {{0.5, {3, 0}}, {0.75, {0, 0}}};
  estimator.update(e, {}, first, {0, 0.25, 0});
  EXPECT_NEAR(vehicle_pose(e).pose[0], 0.25, 1e-12);  // it starts at the first reading
  estimator.update(e, {}, second, {1, 2, 1.75});
  EXPECT_NEAR(vehicle_pose(e).pose[0], 0.5 * 1 + 0.25 * 3, 1e-12);
}

TEST(PlanarMotion, UsesAFixAtItsOwnTime) {
  for (const char* frame : {"world", "vehicle"}) {
    PlanarSlamSettings s = drive_settings();
    s.filter.map_frame = frame;
    s.filter.use_fixes = true;
    s.filter.sigma_fix_m = 1e-3;
    s.start.sigma_position_m = 1;
    const PlanarEstimator estimator(s);
    PlanarEstimate e;
    Observation seen;
    seen.odometry = {{0, {10, 0}}};
    seen.fixes = {{0.1, {1, 0.5}}, {0.2, {2, 0.5}}};  // half a metre beside where it thinks it is
    estimator.update(e, {}, seen, {0, 1, 0});
    EXPECT_NEAR(vehicle_pose(e).pose[0], 10, 0.1) << frame;
    EXPECT_NEAR(vehicle_pose(e).pose[1], 0.5, 0.1) << frame;
  }
}

TEST(PlanarEstimator, AnchorsAreKnownByTheirIdentity) {
  PlanarSlamSettings s = drive_settings();
  s.filter.anchors = {landmarks[2], landmarks[0]};
  EXPECT_THROW(PlanarEstimator{s}, std::invalid_argument);
  const PlanarEstimator estimator(s, {2, 0});
  PlanarEstimate e;
  Drive drive;
  for (int k = 0; k < 5; ++k) drive.step(estimator, e, s);
  EXPECT_EQ(e.catalogue.size(), 4u);
  EXPECT_EQ(e.matched, 4);
}

TEST(PlanarEstimator, SaysThatAnUpdateWasRefused) {
  for (const char* decorrelate : {"nothing", "map-linear"}) {
    PlanarSlamSettings s = drive_settings();
    s.filter.decorrelate = decorrelate;
    s.filter.anchors = {landmarks[0], landmarks[1]};
    s.start.sigma_position_m = 1e9;
    s.sensor.sigma_range_m = s.sensor.sigma_bearing_rad = 1e-5;
    s.lost.max_sigma_position_m = 1e12;
    s.association.gate_probability = 1 - 1e-9;
    const PlanarEstimator estimator(s, {0, 1});
    PlanarEstimate e;
    Drive drive;
    drive.step(estimator, e, s);
    EXPECT_EQ(e.update.outcome, UpdateReport::Outcome::singular) << decorrelate;
    EXPECT_EQ(e.status.state, TrackingState::degraded) << decorrelate;
    EXPECT_EQ(e.matched, 0) << decorrelate;
  }
}

TEST(PlanarEstimator, LeavesAloneWhatIsNoDetection) {
  for (const char* method : {"known", "nearest", "joint"}) {
    PlanarSlamSettings s = drive_settings();
    s.association.method = method;
    const PlanarEstimator estimator(s);
    PlanarEstimate e;
    Observation seen;
    seen.detections = {{std::nan(""), 0.1, 1}, {-3, 0.1, 2}, {5, std::nan(""), 3}, {5, 0.1, 4}};
    estimator.update(e, {}, seen, {0, 0, 0});
    EXPECT_EQ(e.catalogue.size(), 1u) << method;
    EXPECT_TRUE(vehicle_pose(e).pose.allFinite());
  }
}

TEST(PlanarEstimator, NewLandmarksAloneDoNotKeepItFromBeingLost) {
  PlanarSlamSettings s = drive_settings();
  s.association.method = "joint";
  const PlanarEstimator estimator(s);
  PlanarEstimate e;
  for (int k = 0; k <= s.lost.max_unmatched_scans; ++k) {
    Observation seen;
    seen.detections = {{5.0 + 10 * k, 0.1}};
    estimator.update(e, {}, seen, {k, static_cast<double>(k), 1.0});
  }
  EXPECT_EQ(e.status.state, TrackingState::lost);
}

TEST(PlanarEstimator, EntropiesOfABlockDiagonalMapAreThoseOfItsMatrix) {
  PlanarSlamSettings s = drive_settings();
  s.filter.decorrelate = "map-linear";
  s.start.sigma_position_m = s.start.sigma_heading_rad = 0.1;
  const PlanarEstimate e = run(s, 5);
  const Eigen::MatrixXd P = e.belief.dense_covariance();
  const Entropy entropy = entropies(e);
  EXPECT_NEAR(entropy.total, gaussian_entropy(log_det(P), static_cast<int>(P.rows())), 1e-8);
  EXPECT_NEAR(entropy.map, gaussian_entropy(log_det(P.bottomRightCorner(8, 8)), 8), 1e-8);
}

TEST(PlanarEstimator, KeepsTheMapBlockDiagonalWhenAsked) {
  for (const char* decorrelate : {"map", "map-linear"}) {
    PlanarSlamSettings s = drive_settings();
    s.filter.decorrelate = decorrelate;
    const PlanarEstimate e = run(s, 20);
    for (std::size_t i = 0; i < e.catalogue.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        EXPECT_TRUE(e.belief.covariance(e.catalogue[i].block, e.catalogue[j].block).isZero(0)) << decorrelate;
    EXPECT_FALSE(e.belief.covariance(e.vehicle, e.catalogue[0].block).isZero(0)) << decorrelate;
  }
  PlanarSlamSettings s = drive_settings();
  s.filter.decorrelate = "everything";
  const PlanarEstimate e = run(s, 20);
  EXPECT_TRUE(e.belief.covariance(e.vehicle, e.catalogue[0].block).isZero(0));
}

TEST(PlanarEstimator, RefusesWhatMakesNoSense) {
  PlanarSlamSettings s = drive_settings();
  s.filter.lineariser = "magic";
  EXPECT_THROW(PlanarEstimator{s}, std::invalid_argument);
  s.filter.lineariser = "iterated";
  s.filter.decorrelate = "map-linear";
  EXPECT_THROW(PlanarEstimator{s}, std::invalid_argument);
  s.filter.decorrelate = "nothing";
  s.filter.lineariser = "first-estimate";
  s.filter.map_frame = "vehicle";
  EXPECT_THROW(PlanarEstimator{s}, std::invalid_argument);
  s.filter.lineariser = "analytic";
  s.filter.decorrelate = "map";
  EXPECT_THROW(PlanarEstimator{s}, std::invalid_argument);
}

TEST(PlanarLooks, FirstEstimatesLineariseWhereTheyWereFirst) {
  PlanarSlamSettings s = drive_settings();
  s.filter.lineariser = "first-estimate";
  Drive drive;
  PlanarEstimate e = run(s, 10, 1, false, &drive);
  const auto look = look_at(e, e.catalogue[1], {8, 0, 1}, s);
  const auto first = RangeBearing::look(e.first_prediction, e.catalogue[1].position);
  ASSERT_TRUE(look && first);
  EXPECT_LT((look->look.parts[0].H - first->Hv).norm(), 1e-15);
  EXPECT_LT((look->look.parts[1].H - first->Hl).norm(), 1e-15);
  EXPECT_LT((look->predicted - RangeBearing::h<double>(Pose(e.belief.mean(e.vehicle)),
                                                       Eigen::Vector2d(e.belief.mean(e.catalogue[1].block))))
                .norm(),
            1e-15);
}

}  // namespace
}  // namespace incognita
