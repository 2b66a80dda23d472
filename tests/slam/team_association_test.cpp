// Sightings without names: nearest neighbours find out what they are of, from nothing but where they are
// seen.
#include "incognita/slam/points/view_association.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "incognita/math/gaussian.hpp"
#include "incognita/math/random.hpp"
#include "incognita/models/sensors/range_bearing.hpp"
#include "incognita/slam/estimator/slam_estimator.hpp"

namespace incognita::testing {
namespace {

constexpr double sigma_range_m = 0.05, sigma_bearing_rad = 0.01;

/// Vehicles that drive among points. The first two points are anchors.
struct Drive {
  EstimatorSettings settings;
  std::vector<planar::Pose<double>> truth;
  std::vector<Eigen::Vector2d> points;
  RandomStream random{11, "sightings"};
  std::int64_t frame = 0;

  explicit Drive(int vehicles = 1,
                 DataAssociationSettings::Method method = DataAssociationSettings::Method::nearest) {
    for (int i = 0; i < vehicles; ++i) {
      truth.emplace_back(0, 2.0 * i, 0);
      settings.bodies.push_back(body_with_sensor(
          DifferentialDrive{}, RangeBearingSensor{}, truth.back(), Eigen::Vector3d::Constant(0.01),
          Eigen::Vector2d::Constant(0.05), Eigen::Vector2d(sigma_range_m, sigma_bearing_rad)));
    }
    for (int i = 0; i < 12; ++i) points.emplace_back(4 + 2.0 * (i / 2), i % 2 ? -3 : 5);
    for (int i : {0, 1}) settings.anchors[i] = points[static_cast<std::size_t>(i)];
    settings.association.method = method;
  }

  /// Views with the true names.
  Observation next() {
    Observation observation;
    for (planar::Pose<double>& x : truth) {
      BodyObservation view;
      view.input = Eigen::Vector2d(0.5, 0.02);
      const Eigen::Vector2d carried(0.5 + 0.05 * random.normal(), 0.02 + 0.05 * random.normal());
      if (frame > 0) x = DifferentialDrive{}.f<double>(x, carried, 0.1);
      for (std::size_t i = 0; i < points.size(); ++i) {
        Eigen::Vector2d z = RangeBearing::h<double>(x, points[i]);
        z += Eigen::Vector2d(sigma_range_m * random.normal(), sigma_bearing_rad * random.normal());
        view.landmarks.push_back({static_cast<std::int64_t>(i), z});
      }
      observation.bodies.push_back(view);
    }
    return observation;
  }
  Tick tick() {
    const double t = 0.1 * static_cast<double>(frame);
    return {frame, t, frame++ > 0 ? 0.1 : 0.0};
  }
};

/// Runs 60 ticks; `disguise` may change what the estimator is given.
template <class Disguise>
Estimate estimate_of(Drive drive, const Disguise& disguise) {
  SlamEstimator estimator(drive.settings);
  Estimate e;
  for (int i = 0; i < 60; ++i) {
    Observation observation = drive.next();
    disguise(observation);
    estimator.update(e, {}, observation, drive.tick());
  }
  return e;
}

void expect_same(const Estimate& a, const Estimate& b) {
  ASSERT_EQ(a.belief.errors(), b.belief.errors());
  ASSERT_EQ(a.landmarks.size(), b.landmarks.size());
  EXPECT_EQ(a.belief.dense_covariance(), b.belief.dense_covariance());
  for (const auto& [number, landmark] : a.landmarks) {
    ASSERT_EQ(b.landmarks.count(number), 1u);
    if (landmark.fixed) continue;
    EXPECT_EQ(Eigen::VectorXd(a.belief.mean(landmark.block)),
              Eigen::VectorXd(b.belief.mean(b.landmarks.at(number).block)));
  }
  for (std::size_t i = 0; i < a.bodies.size(); ++i) {
    EXPECT_EQ(a.bodies[i].pose.position, b.bodies[i].pose.position);
  }
}

void nothing(Observation&) {}

TEST(TeamAssociation, FindsTheLandmarksThatIdentitiesGive) {
  const Estimate identified = estimate_of(Drive(1, DataAssociationSettings::Method::known), nothing);
  const Estimate found = estimate_of(Drive(), nothing);
  ASSERT_EQ(found.mapped_count(), 10);
  ASSERT_EQ(identified.mapped_count(), 10);
  std::size_t used = 0;
  for (const auto& [number, landmark] : found.landmarks) {
    if (landmark.fixed) continue;
    double nearest_m = 1e9;
    for (const auto& [identity, other] : identified.landmarks)
      if (!other.fixed)
        nearest_m = std::min(
            nearest_m, (found.belief.mean(landmark.block) - identified.belief.mean(other.block)).norm());
    EXPECT_LT(nearest_m, 0.05);
    used += static_cast<std::size_t>(landmark.detection_count);
  }
  // Of 590 sightings that are no births a gate of 0.95 leaves out one in twenty
  EXPECT_GT(used, 10 * 60 * 0.91);
  EXPECT_LT(used, 10 * 60 * 0.99);
}

TEST(TeamAssociation, UsesNoIdentityButThatOfAnchors) {
  std::mt19937 random(3);
  const Estimate plain = estimate_of(Drive(2), nothing);
  EXPECT_EQ(plain.mapped_count(), 10);
  expect_same(plain, estimate_of(Drive(2), [&](Observation& observation) {  // other names in every tick
                for (BodyObservation& view : observation.bodies) {
                  std::vector<std::int64_t> names = {2, 3, 4, 5, 6, 7, 8, 9, 10, 11};
                  std::shuffle(names.begin(), names.end(), random);
                  for (std::size_t i = 2; i < view.landmarks.size(); ++i)
                    view.landmarks[i].identity = names[i - 2];
                }
              }));
  expect_same(plain, estimate_of(Drive(2), [](Observation& observation) {
                for (BodyObservation& view : observation.bodies)
                  for (std::size_t i = 2; i < view.landmarks.size(); ++i)
                    view.landmarks[i].identity = Detection::unknown;
              }));
}

TEST(TeamAssociation, DoesNotDependOnTheOrderOfDetections) {
  std::mt19937 random(5);
  expect_same(estimate_of(Drive(2), nothing), estimate_of(Drive(2), [&](Observation& observation) {
                for (BodyObservation& view : observation.bodies)
                  std::shuffle(view.landmarks.begin(), view.landmarks.end(), random);
              }));
}

TEST(TeamAssociation, ByIdentityLeavesOutDetectionsWithoutOne) {
  const Estimate e =
      estimate_of(Drive(1, DataAssociationSettings::Method::known), [](Observation& observation) {
        for (PointDetection& s : observation.bodies[0].landmarks)
          if (s.identity > 5) s.identity = Detection::unknown;
      });
  EXPECT_EQ(e.mapped_count(), 4);
}

/// A vehicle and one landmark that it has seen once, straight ahead.
struct OneLandmark {
  Drive drive;
  Estimate e;

  OneLandmark() {
    drive.settings.anchors.clear();
    BodyObservation view;
    view.input = Eigen::Vector2d(0, 0);
    view.landmarks.push_back({Detection::unknown, Eigen::Vector2d(5, 0)});
    Observation observation;
    observation.bodies.push_back(view);
    SlamEstimator(drive.settings).update(e, {}, observation, drive.tick());
  }
  std::int64_t number() const { return e.landmarks.begin()->first; }

  /// So many sigmas of its innovation farther than expected: of the range, whose variance is the landmark's
  /// own, as it was born, and that of the new look; where the vehicle is drops out.
  PointDetection farther(double sigmas) const {
    return {Detection::unknown, Eigen::Vector2d(5 + sigmas * std::sqrt(2.0) * sigma_range_m, 0)};
  }
  ViewAssociation associated(const std::vector<PointDetection>& detections) const {
    return associate_view(e, 0, detections, drive.settings);
  }
};

TEST(TeamAssociation, HasAGateForMatchesAndAWiderOneForNewLandmarks) {
  const OneLandmark one;
  ASSERT_EQ(one.e.landmarks.size(), 1u);
  const double gate = std::sqrt(chi_square_quantile(0.95, 2)),
               wide = std::sqrt(chi_square_quantile(0.9999, 2));
  const auto taken = [&](double sigmas) {
    const ViewAssociation a = one.associated({one.farther(sigmas)});
    return a.landmarks[0] == one.number() ? "match" : a.candidates.empty() ? "alone" : "birth";
  };
  EXPECT_STREQ(taken(0), "match");
  EXPECT_STREQ(taken(0.99 * gate), "match");
  EXPECT_STREQ(taken(1.01 * gate), "alone");
  EXPECT_STREQ(taken(-0.99 * wide), "alone");
  EXPECT_STREQ(taken(-1.01 * wide), "birth");
}

TEST(TeamAssociation, GivesEachLandmarkToTheNearestAndToNoOther) {
  const OneLandmark one;
  const ViewAssociation a = one.associated({one.farther(1.5), one.farther(-0.5), one.farther(9)});
  EXPECT_EQ(a.landmarks, (std::vector<std::int64_t>{Detection::unknown, one.number(), Detection::unknown}));
  EXPECT_EQ(a.candidates, std::vector<std::size_t>{2});
}

TEST(TeamAssociation, NumbersAreNeverAnAnchorsNorGivenTwice) {
  const Estimate e = estimate_of(Drive(), nothing);
  std::int64_t least = 1000;
  for (const auto& [number, landmark] : e.landmarks)
    if (!landmark.fixed) least = std::min(least, number);
  EXPECT_EQ(least, 2) << "anchors are 0 and 1";
  EXPECT_EQ(e.next_id, 12);
}

TEST(TeamAssociation, GatesMustFitEachOther) {
  Drive drive;
  drive.settings.association.method = DataAssociationSettings::Method::nearest;
  drive.settings.association.initialization_probability = 0.9;
  EXPECT_NE(validate(drive.settings), "");
  drive.settings.association.initialization_probability = 0.9999;
  for (const auto method : {DataAssociationSettings::Method::known, DataAssociationSettings::Method::nearest,
                            DataAssociationSettings::Method::joint}) {
    drive.settings.association.method = method;
    EXPECT_EQ(validate(drive.settings), "") << static_cast<int>(method);
  }
}

}  // namespace
}  // namespace incognita::testing
