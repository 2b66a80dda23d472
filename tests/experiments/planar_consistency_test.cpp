// Smaller versions of the consistency table: fixed seeds, and a recorded interval for each filter. A filter
// outside its interval has changed.
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

TEST(PlanarConsistency, EachFilterStaysInItsRecordedInterval) {
  const std::map<std::string, Recorded> recorded{{"EKF", {2.3, 2.8}},
                                                 {"iterated EKF", {1.7, 2.05}},
                                                 {"unscented vehicle", {2.3, 2.8}},
                                                 {"first-estimate Jacobians", {1.07, 1.27}},
                                                 {"map in the vehicle's frame", {1.37, 1.65}}};
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
  filter.decorrelate = "map-linear";
  double nees = 0;
  for (int seed = 1; seed <= seeds; ++seed) nees += planar_consistency({}, seed, filter).nees / seeds;
  EXPECT_LT(nees, 1.2);
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
  EXPECT_LT(standing_vehicle(1, "analytic").sigma_heading_deg, 10);
  EXPECT_NEAR(standing_vehicle(1, "first-estimate").sigma_heading_deg, standing_sigma_heading_deg, 1e-6);
}

}  // namespace
}  // namespace incognita
