// The estimator of one vehicle on a plane by hand-made observations: starts, matches, new landmarks, refusals, frames
// and linearizations.
#include "incognita/slam/estimator/single_vehicle.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "incognita/math/gaussian.hpp"
#include "incognita/math/random.hpp"
#include "incognita/models/motion/arc_motion.hpp"
#include "incognita/models/sensors/range_bearing.hpp"
#include "incognita/slam/estimator/check_observation.hpp"
#include "incognita/slam/estimator/slam_estimator.hpp"
#include "incognita/slam/mapper/entropy.hpp"
#include "incognita/slam/mapper/measurements.hpp"

namespace incognita {
namespace {

using Pose = planar::Pose<double>;

PointDetection detection(double range_m, double bearing_rad, std::int64_t identity = Detection::unknown) {
  return {identity, Eigen::Vector2d(range_m, bearing_rad)};
}

Observation of_one() {
  Observation one;
  one.bodies.resize(1);
  return one;
}

Pose pose(const Estimate& e) { return e.bodies.front().state; }

/// Turns an error in body axes to the world.
Eigen::Matrix3d rotated(double heading) {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  R.topLeftCorner<2, 2>() = planar::rotation(heading);
  return R;
}
Eigen::Matrix3d covariance(const Estimate& e) { return e.bodies.front().state_covariance; }
std::size_t map_size(const Estimate& e) { return e.landmarks.size(); }

/// The mapped landmark nearest to a point.
LandmarkPosition nearest(const Estimate& e, const Eigen::Vector2d& point) {
  LandmarkPosition best{Eigen::Vector2d::Constant(1e9), {}};
  for (const auto& [id, landmark] : e.landmarks) {
    const LandmarkPosition at = *position_of(landmark, e);
    if ((at.position - point).norm() < (best.position - point).norm()) best = at;
  }
  return best;
}

BlockId block(const Estimate& e, int which) {
  for (const auto& [id, landmark] : e.landmarks)
    if (!landmark.fixed && which-- == 0) return landmark.block;
  throw std::out_of_range("no such landmark");
}

PlanarSlamSettings drive_settings() {
  PlanarSlamSettings s;
  s.vehicle.model = "differential-drive";
  s.vehicle.sigma_speed_m_s = 0.05;
  s.vehicle.sigma_turn_rate_rad_s = 0.02;
  s.sensor.sigma_range_m = 0.05;
  s.association.method = DataAssociationSettings::Method::known;
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
    Observation observation = of_one();
    const double t = static_cast<double>(frame);
    if (frame > 0) {
      const Eigen::Vector2d off(s.vehicle.sigma_speed_m_s * random.normal() * noise,
                                s.vehicle.sigma_turn_rate_rad_s * random.normal() * noise);
      truth = ArcMotion<DifferentialDrive>{}.f<double>(truth, Eigen::Vector2d(0.5, 0.05) + off, 1);
    }
    observation.bodies[0].odometry = {{t, {0.5, 0.05}}};
    for (std::size_t i = 0; i < landmarks.size(); ++i) {
      const Eigen::Vector2d z = RangeBearing::h<double>(truth, landmarks[i]);
      const double range_m = z[0] + noise * s.sensor.sigma_range_m * random.normal();
      observation.bodies[0].landmarks.push_back(
          detection(range_m, wrap_angle(z[1] + noise * s.sensor.sigma_bearing_rad * random.normal()),
                    static_cast<std::int64_t>(i)));
    }
    return observation;
  }
  void step(SlamEstimator& estimator, Estimate& e, const PlanarSlamSettings& s) {
    const Observation observation = next(s);
    estimator.update(e, {}, observation, tick());
  }
  Tick tick() { return {frame, static_cast<double>(frame), frame++ > 0 ? 1.0 : 0.0}; }
};

Estimate run(const PlanarSlamSettings& s, int ticks, double noise = 1, bool anonymous = false,
             Drive* out = nullptr) {
  SlamEstimator estimator(single_vehicle(s));
  Estimate e;
  Drive drive;
  drive.noise = noise;
  for (int k = 0; k < ticks; ++k) {
    Observation observation = drive.next(s);
    if (anonymous)
      for (PointDetection& d : observation.bodies[0].landmarks) d.identity = Detection::unknown;
    estimator.update(e, {}, observation, drive.tick());
  }
  if (out) *out = drive;
  return e;
}

TEST(SingleVehicle, MapsWhatItSees) {
  for (const auto method : {DataAssociationSettings::Method::known, DataAssociationSettings::Method::nearest,
                            DataAssociationSettings::Method::joint}) {
    PlanarSlamSettings s = drive_settings();
    s.association.method = method;
    Drive drive;
    const Estimate e = run(s, 30, 1, s.association.method != DataAssociationSettings::Method::known, &drive);
    ASSERT_EQ(map_size(e), landmarks.size()) << static_cast<int>(method);
    for (std::size_t i = 0; i < landmarks.size(); ++i)
      EXPECT_LT((nearest(e, landmarks[i]).position - landmarks[i]).norm(), 0.2) << static_cast<int>(method);
    EXPECT_LT((pose(e) - drive.truth).norm(), 0.2);
    EXPECT_EQ(e.status.state, TrackingState::tracking);
    EXPECT_EQ(e.last.matched, 4);
  }
}

/// Two increments that also go sideways, the second of which is interrupted by a tick.
TEST(SingleVehicle, FollowsPoseIncrementsWithTheirOwnNoise) {
  for (const Linearization linearization :
       {Linearization::analytic, Linearization::unscented_vehicle, Linearization::first_estimate}) {
    PlanarSlamSettings s = drive_settings();
    s.filter.linearization = linearization;
    s.start.sigma_position_m = s.start.sigma_heading_rad = 1e-9;
    const Eigen::Vector3d first(0.5, 0.2, 0.1), second(0.3, -0.1, -0.4);
    const Eigen::Matrix3d cov = Eigen::Vector3d(4e-4, 1e-4, 9e-4).asDiagonal();
    SlamEstimator estimator(single_vehicle(s));
    Estimate e;
    Observation observation = of_one();
    observation.bodies[0].odometry = {{0, {0, 0}, twist_of_increment(first, cov, 1)},
                                      {1, {0, 0}, twist_of_increment(second, cov, 1)}};
    const double ticks[] = {1, 1.4, 2};
    for (int k = 0; k < 3; ++k) {
      estimator.update(e, {}, observation, {k, ticks[k], k ? ticks[k] - ticks[k - 1] : 0});
      observation = of_one();
    }
    const PlanarTwist motion;
    const auto after_first = motion.step(Pose(0, 0, 0), twist_of_increment(first, cov, 1)->twist, 1);
    const auto after = motion.step(after_first.x, twist_of_increment(second, cov, 1)->twist, 1);
    EXPECT_LT((pose(e) - after.x).norm(), linearization == Linearization::unscented_vehicle ? 1e-3 : 1e-12);
    // The noise of each increment, in the axes of the pose before it
    const Eigen::Matrix3d turn = rotated(after_first.x[2]);
    const Eigen::Matrix3d expected = after.F * cov * after.F.transpose() + turn * cov * turn.transpose();
    EXPECT_LT((Eigen::Matrix3d(e.body().state_covariance) - expected).norm(), 0.15 * expected.norm())
        << "parts of a reading share its variance";
    EXPECT_GT((Eigen::Matrix3d(e.body().state_covariance)).trace(), 0.9 * expected.trace());
  }
}

TEST(SingleVehicle, RefusesATwistOfABodyThatIsNotOnThePlane) {
  PlanarSlamSettings s = drive_settings();
  EstimatorSettings settings = single_vehicle(s);
  settings.bodies[0].motion = TerrainVehicle{};
  Observation observation = of_one();
  observation.bodies[0].odometry = {{0, {0, 0}, MeasuredTwist{}}};
  EXPECT_THROW(check_observation(observation, settings), std::invalid_argument);
}

TEST(SingleVehicle, EveryFilterIsTheSameWhereNothingIsToLinearize) {
  PlanarSlamSettings s = drive_settings();
  s.vehicle.sigma_speed_m_s = s.vehicle.sigma_turn_rate_rad_s = 1e-7;
  s.sensor.sigma_range_m = s.sensor.sigma_bearing_rad = 1e-7;
  const Estimate plain = run(s, 20);
  const Eigen::Matrix3d P = covariance(plain);
  for (const auto linearization :
       {Linearization::iterated, Linearization::unscented_vehicle, Linearization::first_estimate}) {
    s.filter.linearization = linearization;
    const Estimate other = run(s, 20);
    EXPECT_LT((pose(other) - pose(plain)).norm(), 1e-11) << static_cast<int>(linearization);
    EXPECT_LT((covariance(other) - P).norm(), 1e-3 * P.norm()) << static_cast<int>(linearization);
  }
  s.filter.linearization = Linearization::analytic;
  s.filter.map_frame = MapFrame::vehicle;
  const Estimate relative = run(s, 20);
  EXPECT_LT((pose(relative) - pose(plain)).norm(), 1e-11);
  EXPECT_LT((covariance(relative) - P).norm(), 1e-3 * P.norm());
  for (std::size_t i = 0; i < landmarks.size(); ++i) {
    const LandmarkPosition a = nearest(relative, landmarks[i]), b = nearest(plain, landmarks[i]);
    EXPECT_LT((a.position - b.position).norm(), 1e-11);
    EXPECT_LT((a.covariance - b.covariance).norm(), 1e-3 * b.covariance.norm());
  }
}

TEST(SingleVehicle, FirstEstimatesGainNoHeadingWithoutAnchors) {
  PlanarSlamSettings s = drive_settings();
  s.start.sigma_heading_rad = 0.2;
  const double analytic = covariance(run(s, 60))(2, 2);
  s.filter.linearization = Linearization::first_estimate;
  const double kept = covariance(run(s, 60))(2, 2);
  EXPECT_GE(kept, 0.04 * (1 - 1e-9));
  EXPECT_LT(analytic, 0.04);
}

TEST(SingleVehicle, AnchorsAndFixesFixTheFrame) {
  for (const MapFrame frame : {MapFrame::world, MapFrame::vehicle}) {
    PlanarSlamSettings s = drive_settings();
    s.filter.map_frame = frame;
    s.start = {{0.3, -0.2}, 0.1, false, 0.5, 0.2};
    s.filter.anchors = {landmarks[0], landmarks[1]};
    s.association.method = DataAssociationSettings::Method::joint;
    Drive drive;
    const Estimate anchored = run(s, 40, 1, true, &drive);
    EXPECT_LT((pose(anchored) - drive.truth).norm(), 0.15) << static_cast<int>(frame);
    EXPECT_EQ(map_size(anchored), 4u) << static_cast<int>(frame);
    EXPECT_EQ(anchored.mapped_count(), 2) << static_cast<int>(frame);
  }
}

TEST(SingleVehicle, FixesAreUsedInEitherFrame) {
  for (const MapFrame frame : {MapFrame::world, MapFrame::vehicle}) {
    PlanarSlamSettings s = drive_settings();
    s.filter.map_frame = frame;
    s.filter.use_fixes = true;
    s.filter.sigma_fix_m = 0.05;
    s.start = {{1, 1}, 0.2, false, 1, 0.4};
    SlamEstimator estimator(single_vehicle(s));
    Estimate e;
    Drive drive;
    for (int k = 0; k < 40; ++k) {
      Observation observation = drive.next(s);
      observation.bodies[0].fixes = {{static_cast<double>(drive.frame), drive.truth.head<2>()}};
      estimator.update(e, {}, observation, drive.tick());
    }
    EXPECT_LT((pose(e) - drive.truth).norm(), 0.1) << static_cast<int>(frame);
  }
}

TEST(SingleVehicle, WaitsForTheFirstFixWhenItIsToStartThere) {
  PlanarSlamSettings s = drive_settings();
  s.start.at_first_fix = true;
  SlamEstimator estimator(single_vehicle(s));
  Estimate e;
  Observation observation = of_one();
  estimator.update(e, {}, observation, {0, 0, 0});
  EXPECT_FALSE(e.started);
  EXPECT_EQ(e.status.state, TrackingState::starting);
  EXPECT_FALSE(e.status.reason.empty());
  observation.bodies[0].fixes = {{1, {3, 4}}};
  estimator.update(e, {}, observation, {1, 1, 1});
  EXPECT_TRUE(e.started);
  EXPECT_EQ(pose(e).head<2>(), Eigen::Vector2d(3, 4));
}

/// Its error is that of the start: used again as a measurement, it would be counted twice.
TEST(SingleVehicle, TheFixThatItStartsAtIsNoMeasurement) {
  PlanarSlamSettings s = drive_settings();
  s.start.at_first_fix = true;
  s.start.sigma_position_m = 0.3;
  s.filter.use_fixes = true;
  s.filter.sigma_fix_m = 0.3;
  SlamEstimator estimator(single_vehicle(s));
  Estimate e;
  Observation observation = of_one();
  observation.bodies[0].fixes = {{0, {3, 4}}};
  estimator.update(e, {}, observation, {0, 0, 0});
  EXPECT_NEAR(e.belief.covariance(e.body().block)(0, 0), 0.09, 1e-12);
  EXPECT_TRUE(e.last.fixes.empty());
  observation.bodies[0].fixes = {{1, {3, 4}}};
  estimator.update(e, {}, observation, {1, 1, 1});
  EXPECT_EQ(e.last.fixes.size(), 1u) << "the next one is";
  EXPECT_LT(e.belief.covariance(e.body().block)(0, 0), 0.06);
}

TEST(SingleVehicle, RefusesAKnownLandmarkFarFromWhereItIs) {
  const PlanarSlamSettings s = drive_settings();
  SlamEstimator estimator(single_vehicle(s));
  Estimate e;
  Drive drive;
  for (int k = 0; k < 10; ++k) drive.step(estimator, e, s);
  Observation observation = drive.next(s);
  observation.bodies[0].landmarks[2].z[0] += 3;
  estimator.update(e, {}, observation, drive.tick());
  EXPECT_EQ(e.last.matched, 3);
  EXPECT_EQ(e.last.matches[2].outcome, MatchOutcome::outlier);
  EXPECT_EQ(map_size(e), 4u);
}

TEST(SingleVehicle, LeavesAloneWhatHasNoIdentityWhereIdentitiesAreWanted) {
  const PlanarSlamSettings s = drive_settings();
  EXPECT_EQ(map_size(run(s, 5, 1, true)), 0u);
}

TEST(SingleVehicle, TwoDetectionsOfOnePlaceAreOneLandmark) {
  PlanarSlamSettings s = drive_settings();
  s.association.method = DataAssociationSettings::Method::joint;
  SlamEstimator estimator(single_vehicle(s));
  Estimate e;
  Observation observation = of_one();
  observation.bodies[0].landmarks = {detection(5, 0.1), detection(5.02, 0.1), detection(9, -1)};
  estimator.update(e, {}, observation, {0, 0, 0});
  EXPECT_EQ(map_size(e), 2u);
  EXPECT_EQ(e.last.matches[0].outcome, MatchOutcome::initialized);
  EXPECT_NE(e.last.matches[1].outcome, MatchOutcome::initialized);
}

TEST(SingleVehicle, SaysThatItIsLost) {
  PlanarSlamSettings s = drive_settings();
  s.health.max_sigma_position_m = 0.3;
  SlamEstimator estimator(single_vehicle(s));
  Estimate e;
  for (int k = 0; k < 200; ++k) {
    Observation blind = of_one();
    blind.bodies[0].odometry = {{static_cast<double>(k), {1, 0.1}}};
    estimator.update(e, {}, blind, {k, static_cast<double>(k), k > 0 ? 1.0 : 0.0});
  }
  EXPECT_EQ(e.status.state, TrackingState::lost);
  EXPECT_NE(e.status.reason.find("limit 0.3 m"), std::string::npos) << e.status.reason;
}

TEST(SingleVehicle, IsLostWhenNothingIsWhereItShouldBe) {
  PlanarSlamSettings s = drive_settings();
  SlamEstimator estimator(single_vehicle(s));
  Estimate e;
  Drive drive;
  for (int k = 0; k < 5; ++k) drive.step(estimator, e, s);
  for (int k = 0; k < s.health.max_ticks; ++k) {
    Observation observation = drive.next(s);
    for (PointDetection& d : observation.bodies[0].landmarks) d.z[0] += 20;
    estimator.update(e, {}, observation, drive.tick());
  }
  EXPECT_EQ(e.status.state, TrackingState::lost);
}

/// An input is held until the next reading, whatever the ticks are.
TEST(SingleVehicle, HoldsEachInputUntilTheNext) {
  PlanarSlamSettings s = drive_settings();
  SlamEstimator estimator(single_vehicle(s));
  Estimate e;
  Observation first = of_one(), second = of_one();
  first.bodies[0].odometry = {{0, {1, 0}}};
  second.bodies[0].odometry = {{0.5, {3, 0}}, {0.75, {0, 0}}};
  estimator.update(e, {}, first, {0, 0.25, 0});
  EXPECT_NEAR(pose(e)[0], 0.25, 1e-12);  // it starts at the first reading
  estimator.update(e, {}, second, {1, 2, 1.75});
  EXPECT_NEAR(pose(e)[0], 0.5 * 1 + 0.25 * 3, 1e-12);
}

TEST(SingleVehicle, UsesAFixAtItsOwnTime) {
  for (const MapFrame frame : {MapFrame::world, MapFrame::vehicle}) {
    PlanarSlamSettings s = drive_settings();
    s.filter.map_frame = frame;
    s.filter.use_fixes = true;
    s.filter.sigma_fix_m = 1e-3;
    s.start.sigma_position_m = 1;
    SlamEstimator estimator(single_vehicle(s));
    Estimate e;
    Observation observation = of_one();
    observation.bodies[0].odometry = {{0, {10, 0}}};
    observation.bodies[0].fixes = {{0.1, {1, 0.5}},
                                   {0.2, {2, 0.5}}};  // half a metre beside where it thinks it is
    estimator.update(e, {}, observation, {0, 1, 0});
    EXPECT_NEAR(pose(e)[0], 10, 0.1) << static_cast<int>(frame);
    EXPECT_NEAR(pose(e)[1], 0.5, 0.1) << static_cast<int>(frame);
  }
}

TEST(SingleVehicle, AnchorsAreKnownByTheirIdentity) {
  PlanarSlamSettings s = drive_settings();
  s.filter.anchors = {landmarks[2], landmarks[0]};
  EXPECT_THROW(SlamEstimator(single_vehicle(s)), std::invalid_argument);
  SlamEstimator estimator(single_vehicle(s, {2, 0}));
  Estimate e;
  Drive drive;
  for (int k = 0; k < 5; ++k) drive.step(estimator, e, s);
  EXPECT_EQ(map_size(e), 4u);
  EXPECT_EQ(e.last.matched, 4);
}

TEST(SingleVehicle, SaysThatAnUpdateWasRefused) {
  for (const auto decorrelate : {Decorrelation::nothing, Decorrelation::map_linear}) {
    PlanarSlamSettings s = drive_settings();
    s.filter.decorrelate = decorrelate;
    s.filter.anchors = {landmarks[0], landmarks[1]};
    s.start.sigma_position_m = 1e9;
    s.sensor.sigma_range_m = s.sensor.sigma_bearing_rad = 1e-5;
    s.health.max_sigma_position_m = 1e12;
    s.association.gate_probability = 1 - 1e-9;
    SlamEstimator estimator(single_vehicle(s, {0, 1}));
    Estimate e;
    Drive drive;
    drive.step(estimator, e, s);
    EXPECT_EQ(e.last.update.outcome, UpdateReport::Outcome::singular) << static_cast<int>(decorrelate);
    EXPECT_EQ(e.status.state, TrackingState::degraded) << static_cast<int>(decorrelate);
    EXPECT_EQ(e.last.matched, 0) << static_cast<int>(decorrelate);
  }
}

TEST(SingleVehicle, LeavesAloneWhatIsNoDetection) {
  for (const auto method : {DataAssociationSettings::Method::known, DataAssociationSettings::Method::nearest,
                            DataAssociationSettings::Method::joint}) {
    PlanarSlamSettings s = drive_settings();
    s.association.method = method;
    SlamEstimator estimator(single_vehicle(s));
    Estimate e;
    Observation observation = of_one();
    observation.bodies[0].landmarks = {detection(std::nan(""), 0.1, 1), detection(-3, 0.1, 2),
                                       detection(5, std::nan(""), 3), detection(5, 0.1, 4)};
    estimator.update(e, {}, observation, {0, 0, 0});
    EXPECT_EQ(map_size(e), 1u) << static_cast<int>(method);
    EXPECT_TRUE(pose(e).allFinite());
  }
}

TEST(SingleVehicle, NewLandmarksAloneDoNotKeepItFromBeingLost) {
  PlanarSlamSettings s = drive_settings();
  s.association.method = DataAssociationSettings::Method::joint;
  SlamEstimator estimator(single_vehicle(s));
  Estimate e;
  for (int k = 0; k < s.health.max_ticks + 3; ++k) {
    Observation observation = of_one();
    observation.bodies[0].landmarks = {detection(5.0 + 10 * k, 0.1)};
    estimator.update(e, {}, observation, {k, static_cast<double>(k), 1.0});
  }
  EXPECT_EQ(e.status.state, TrackingState::lost);
}

TEST(SingleVehicle, EntropiesOfABlockDiagonalMapAreThoseOfItsMatrix) {
  PlanarSlamSettings s = drive_settings();
  s.filter.decorrelate = Decorrelation::map_linear;
  s.start.sigma_position_m = s.start.sigma_heading_rad = 0.1;
  const Estimate e = run(s, 5);
  const Eigen::MatrixXd P = e.belief.dense_covariance();
  const Entropy entropy = entropies(e);
  EXPECT_NEAR(entropy.total, gaussian_entropy(log_det(P), static_cast<int>(P.rows())), 1e-8);
  EXPECT_NEAR(entropy.map, gaussian_entropy(log_det(P.bottomRightCorner(8, 8)), 8), 1e-8);
}

TEST(SingleVehicle, KeepsTheMapBlockDiagonalWhenAsked) {
  for (const auto decorrelate : {Decorrelation::map, Decorrelation::map_linear}) {
    PlanarSlamSettings s = drive_settings();
    s.filter.decorrelate = decorrelate;
    const Estimate e = run(s, 20);
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < i; ++j)
        EXPECT_TRUE(e.belief.covariance(block(e, i), block(e, j)).isZero(0)) << static_cast<int>(decorrelate);
    EXPECT_FALSE(e.belief.covariance(e.bodies[0].block, block(e, 0)).isZero(0))
        << static_cast<int>(decorrelate);
  }
  PlanarSlamSettings s = drive_settings();
  s.filter.decorrelate = Decorrelation::everything;
  const Estimate e = run(s, 20);
  EXPECT_TRUE(e.belief.covariance(e.bodies[0].block, block(e, 0)).isZero(0));
}

TEST(SingleVehicle, RefusesWhatMakesNoSense) {
  PlanarSlamSettings s = drive_settings();
  s.filter.linearization = Linearization::iterated;
  s.filter.decorrelate = Decorrelation::map_linear;
  EXPECT_THROW(SlamEstimator(single_vehicle(s)), std::invalid_argument);
  s.filter.decorrelate = Decorrelation::nothing;
  s.filter.linearization = Linearization::first_estimate;
  s.filter.map_frame = MapFrame::vehicle;
  EXPECT_THROW(SlamEstimator(single_vehicle(s)), std::invalid_argument);
  s.filter.linearization = Linearization::analytic;
  s.filter.decorrelate = Decorrelation::map;
  EXPECT_THROW(SlamEstimator(single_vehicle(s)), std::invalid_argument);
}

TEST(SingleVehicle, FirstEstimatesLinearizeWhereTheyWereFirst) {
  PlanarSlamSettings s = drive_settings();
  s.filter.linearization = Linearization::first_estimate;
  Drive drive;
  const Estimate e = run(s, 10, 1, false, &drive);
  const Landmark& landmark = e.landmarks.at(1);
  const auto measurement = linearize_detection(e, 0, false, detection(8, 0, 1), single_vehicle(s));
  const auto first =
      RangeBearing::predict_measurement(Pose(e.bodies[0].prediction), Eigen::Vector2d(landmark.first));
  ASSERT_TRUE(measurement && first);
  EXPECT_LT((measurement->linearized.parts[0].H - first->Hv).norm(), 1e-15);
  EXPECT_LT((measurement->linearized.parts[1].H - first->Hl).norm(), 1e-15);
  EXPECT_LT((measurement->predicted - RangeBearing::h<double>(Pose(e.belief.mean(e.bodies[0].block)),
                                                              Eigen::Vector2d(e.belief.mean(landmark.block))))
                .norm(),
            1e-15);
}

}  // namespace
}  // namespace incognita
