// Smaller versions of the consistency table: fixed seeds, and an interval recorded for each filter. A filter
// that leaves its interval has changed. These means do not estimate those of the table: the NEES of single
// drives of the EKF has a standard deviation of 4.7, and the means of 50 groups of 20 drives are 1.8 to 5.9.
#include "experiments/planar_consistency.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <map>

namespace incognita {
namespace {

constexpr int seeds = 20;

struct Recorded {
  double least, most;
};

PlanarLoopSettings with_noise(double share) {
  PlanarLoopSettings drive;
  for (double* sigma :
       {&drive.sigma_speed_m_s, &drive.sigma_turn_rate_rad_s, &drive.sigma_range_m, &drive.sigma_bearing_rad})
    *sigma *= share;
  return drive;
}

// The plant is the filter's model: with noise so small that the motion is linear, the covariance is that of
// the errors. A plant that steps along the tangent would have a mean NEES of 11 here.
TEST(PlanarConsistency, PredictionAloneIsConsistent) {
  PlanarLoopSettings drive = with_noise(0.1);
  drive.max_range_m = 0;
  drive.duration_s = 1;
  constexpr int drives = 1000;  // the mean has a standard error of sqrt(2 / (3 drives)) = 0.026
  double nees = 0;
  for (int seed = 1; seed <= drives; ++seed)
    nees += planar_consistency(drive, static_cast<std::uint64_t>(seed), {}).nees / drives;
  EXPECT_NEAR(nees, 1, 0.08);
}

// Likewise with measurements of known landmarks; with the tangent the mean NEES would be 1.2.
TEST(PlanarConsistency, LocalizationWithAKnownMapIsConsistent) {
  const PlanarLoopSettings drive = with_noise(0.25);
  PlanarFilterSettings filter;
  for (const RangeRecording::Landmark& landmark : drive_planar_loop(drive, 1).landmarks)
    filter.anchors.push_back(landmark.position);
  double nees = 0;
  for (int seed = 1; seed <= seeds; ++seed)
    nees += planar_consistency(drive, static_cast<std::uint64_t>(seed), filter).nees / seeds;
  EXPECT_NEAR(nees, 1, 0.05);  // standard error 0.013
}

TEST(PlanarConsistency, EachFilterStaysInTheIntervalRecordedForIt) {
  const std::map<std::string, Recorded> recorded{{"EKF", {2.5, 3.0}},
                                                 {"iterated EKF", {2.6, 3.15}},
                                                 {"unscented vehicle", {2.55, 3.1}},
                                                 {"first-estimate Jacobians", {1.17, 1.4}},
                                                 {"map in the vehicle's frame", {1.5, 1.8}}};
  for (const PlanarFilterChoice& choice : planar_filter_choices()) {
    double nees = 0, nis = 0;
    for (int seed = 1; seed <= seeds; ++seed) {
      const PlanarConsistency one =
          planar_consistency({}, static_cast<std::uint64_t>(first_consistency_seed + seed), choice.filter);
      nees += one.nees / seeds;
      nis += one.nis / seeds;
    }
    std::printf("%s: NEES %.3f, NIS %.3f\n", choice.name.c_str(), nees, nis);
    const Recorded& interval = recorded.at(choice.name);
    EXPECT_GE(nees, interval.least) << choice.name;
    EXPECT_LE(nees, interval.most) << choice.name;
    EXPECT_NEAR(nis, 1, 0.08) << choice.name;
  }
}

TEST(PlanarConsistency, WithAPositionSensorTheFilterIsConsistent) {
  PlanarFilterSettings filter;
  filter.use_fixes = true;
  double nees = 0;
  for (int seed = 1; seed <= seeds; ++seed) nees += planar_consistency({}, seed, filter).nees / seeds;
  EXPECT_NEAR(nees, 1, 0.1);
}

TEST(PlanarConsistency, ABlockDiagonalMapIsConservative) {
  PlanarFilterSettings filter;
  filter.decorrelate = Decorrelation::map_linear;
  double nees = 0;
  for (int seed = 1; seed <= seeds; ++seed) nees += planar_consistency({}, seed, filter).nees / seeds;
  EXPECT_LT(nees, 1.2);
}

TEST(PlanarConsistency, AnUnsureHeadingTurnsPathAndMap) {
  const PlanarConsistency known = planar_consistency({.duration_s = 100}, 3, {}),
                          unsure = planar_consistency({.duration_s = 100}, 3, {}, 0.5);
  EXPECT_GT(unsure.position_rms_m, 3 * known.position_rms_m);
  EXPECT_GT(unsure.at_end.error_m, 3 * known.at_end.error_m);
  EXPECT_LT(unsure.fitted_position_rms_m, 2 * known.fitted_position_rms_m)
      << "a rigid fit leaves the turn out";
}

TEST(PlanarConsistency, AnchorsAreNotAmongTheLandmarks) {
  PlanarFilterSettings filter;
  for (const RangeRecording::Landmark& landmark : drive_planar_loop({}, 1).landmarks)
    filter.anchors.push_back(landmark.position);
  filter.anchors.pop_back();
  const PlanarConsistency one =
      planar_consistency({}, 1, filter);  // a single landmark, seen from a known map
  EXPECT_LT(one.at_end.error_m, 4 * one.at_end.sigma_m);
  EXPECT_LT(one.at_end.sigma_m, one.at_half.sigma_m);
}

TEST(PlanarConsistency, IsDeterministicForASeed) {
  for (const PlanarFilterChoice& choice : planar_filter_choices()) {
    const PlanarConsistency a = planar_consistency({.duration_s = 50}, 3, choice.filter),
                            b = planar_consistency({.duration_s = 50}, 3, choice.filter);
    EXPECT_EQ(a.nees, b.nees);
    EXPECT_EQ(a.position_rms_m, b.position_rms_m);
  }
}

TEST(StandingVehicle, OnlyFirstEstimatesKeepTheUnobservableDirections) {
  EXPECT_LT(standing_vehicle(1, Linearization::analytic).sigma_heading_deg, 10);
  EXPECT_NEAR(standing_vehicle(1, Linearization::first_estimate).sigma_heading_deg,
              standing_sigma_heading_deg, 1e-6);
}

}  // namespace
}  // namespace incognita
