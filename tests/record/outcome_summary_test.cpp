#include "incognita/record/summary/outcome_summary.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace incognita {
namespace {

/// A landmark at (1, 2, 0.5) with an error along x, and the standard deviations of its coordinates.
SnapshotLandmark landmark(std::int64_t id, double error_m, const Eigen::Vector3d& sigma_m) {
  SnapshotLandmark out;
  out.id = id;
  out.truth = Eigen::Vector3d(1, 2, 0.5);
  out.position = *out.truth + Eigen::Vector3d(error_m, 0, 0);
  out.covariance = sigma_m.cwiseAbs2().asDiagonal();
  return out;
}

Snapshot frame(int k, double rate_hz, double position_error_m = 0) {
  Snapshot s;
  s.tick = {k, k / rate_hz, k == 0 ? 0 : 1 / rate_hz};
  s.status.state = TrackingState::tracking;
  SnapshotBody body;
  body.state = TrackingState::tracking;
  body.truth = StampedPose{s.tick.t, Eigen::Vector3d::Zero(), Eigen::Vector4d(1, 0, 0, 0)};
  body.estimate = *body.truth;
  body.estimate.position.y() += position_error_m;
  s.bodies.push_back(body);
  return s;
}

/// The measures of a run in which so much is mapped at each frame.
OutcomeMeasures of_shares(int first, int frames, double rate_hz, double per_frame) {
  OutcomeSummary summary(true);
  for (int k = first; k < frames; ++k) {
    Snapshot s = frame(k, rate_hz);
    s.mapped = per_frame * k;
    summary.add(s);
  }
  return summary.measures();
}

TEST(OutcomeSummary, SharesAreThoseOfTheEndAndAfter60s) {
  const OutcomeMeasures m = of_shares(0, 150, 2, 1.0 / 150);
  EXPECT_EQ(m.mapped, 149 * (1.0 / 150));
  EXPECT_EQ(m.mapped_60_s, 119 * (1.0 / 150)) << "the last frame of a run of 60 s";
  EXPECT_EQ(m.t_90_mapped_s, 135 / 2.0);
}

TEST(OutcomeSummary, ARunOf60sHasItsEndAfter60s) {
  const OutcomeMeasures m = of_shares(0, 900, 15, 1e-3);
  EXPECT_EQ(m.mapped_60_s, m.mapped);
  EXPECT_EQ(m.mapped_60_s, 899 * 1e-3);
  EXPECT_EQ(of_shares(0, 899, 15, 1e-3).mapped_60_s, std::nullopt) << "shorter";
  EXPECT_EQ(of_shares(0, 899, 15, 1e-3).t_90_mapped_s, std::nullopt);
}

TEST(OutcomeSummary, TheFirstTimeAt90PercentCounts) {
  OutcomeSummary summary(true);
  for (const auto& [k, share] : {std::pair(0, 0.0), {1, 0.5}, {2, 0.95}, {3, 0.4}, {4, 0.97}}) {
    Snapshot s = frame(k, 1);
    s.mapped = share;
    summary.add(s);
  }
  EXPECT_EQ(summary.measures().t_90_mapped_s, 2.0);
  EXPECT_EQ(summary.measures().mapped, 0.97);
}

TEST(OutcomeSummary, WhatHappenedBeforeAResumedRunIsUnknown) {
  const OutcomeMeasures m = of_shares(140, 150, 2, 1.0 / 150);
  EXPECT_EQ(m.mapped, 149 * (1.0 / 150));
  EXPECT_EQ(m.mapped_60_s, std::nullopt);
  EXPECT_EQ(m.t_90_mapped_s, std::nullopt);
}

TEST(OutcomeSummary, ComparesTheMapAtTheEndWithTheTruth) {
  const Eigen::Vector3d sigma_m(0.01, 0.01, 0.01);
  OutcomeSummary summary(true);
  Snapshot s = frame(0, 1);
  s.landmarks = {landmark(1, 100, sigma_m)};
  summary.add(s);
  SnapshotLandmark anchor = landmark(0, 9, sigma_m), unknown = landmark(5, 9, sigma_m);
  anchor.anchor = true;
  unknown.truth.reset();
  s.landmarks = {anchor, landmark(1, 0.03, sigma_m), landmark(2, 0.04, sigma_m), landmark(3, 0.06, sigma_m),
                 unknown};
  summary.add(s);
  const OutcomeMeasures m = summary.measures();
  EXPECT_EQ(m.landmarks, 3);
  EXPECT_NEAR(m.map_rms_m.value(), std::sqrt((0.03 * 0.03 + 0.04 * 0.04 + 0.06 * 0.06) / 3), 1e-15);
  EXPECT_EQ(m.within_5_cm, 2 / 3.0);
  EXPECT_EQ(m.within_3_sigma, 1 / 3.0);
}

/// sqrt(14.156) = 3.7625 sigma in space, sqrt(11.829) = 3.4393 on a plane.
TEST(OutcomeSummary, ThreeSigmaHaveTheProbabilityOfOneDimension) {
  const auto within = [](double error_m, const Eigen::Vector3d& sigma_m) {
    OutcomeSummary summary(true);
    Snapshot s = frame(0, 1);
    s.landmarks = {landmark(1, error_m, sigma_m)};
    summary.add(s);
    return summary.measures().within_3_sigma;
  };
  EXPECT_EQ(within(0.0376, {0.01, 1, 1}), 1.0);
  EXPECT_EQ(within(0.0377, {0.01, 1, 1}), 0.0);
  EXPECT_EQ(within(0.0343, {0.01, 1, 0}), 1.0);
  EXPECT_EQ(within(0.0345, {0.01, 1, 0}), 0.0);
}

TEST(OutcomeSummary, DivergedMeansMoreThanHalfAMeterRmsOrLostAtTheEnd) {
  const auto measures = [](double error_m, TrackingState end) {
    OutcomeSummary summary(true);
    summary.add(frame(0, 1, 0.1));
    Snapshot s = frame(1, 1, error_m);
    s.mapped = 0;
    s.status.state = s.bodies[0].state = end;
    summary.add(s);
    return summary.measures();
  };
  const OutcomeMeasures near = measures(0.69, TrackingState::tracking);  // sqrt((0.01 + 0.4761) / 2) = 0.493
  EXPECT_NEAR(near.position_rms_m.value(), 0.493, 1e-3);
  EXPECT_EQ(near.diverged, false);
  EXPECT_EQ(measures(0.71, TrackingState::tracking).diverged, true);
  const OutcomeMeasures lost = measures(9, TrackingState::lost);
  EXPECT_TRUE(lost.lost);
  EXPECT_EQ(lost.diverged, true);
  EXPECT_EQ(lost.position_rms_m, 0.1) << "a lost camera has no pose";
}

TEST(OutcomeSummary, DivergenceIsKnownWhereNothingIsToBeMapped) {
  OutcomeSummary summary(true);
  summary.add(frame(0, 1, 0.1));
  EXPECT_EQ(summary.measures().mapped, std::nullopt);
  EXPECT_EQ(summary.measures().diverged, false);
}

TEST(OutcomeSummary, InAnotherFrameThanTheTruthThereIsNothingToCompare) {
  OutcomeSummary summary(false);
  Snapshot s = frame(0, 1, 3);
  s.mapped = 1;
  s.landmarks = {landmark(1, 0, {1, 1, 1})};
  summary.add(s);
  const OutcomeMeasures m = summary.measures();
  EXPECT_EQ(m.mapped, std::nullopt);
  EXPECT_EQ(m.map_rms_m, std::nullopt);
  EXPECT_EQ(m.position_rms_m, std::nullopt);
  EXPECT_EQ(m.diverged, std::nullopt);
  EXPECT_FALSE(m.lost);
}

}  // namespace
}  // namespace incognita
