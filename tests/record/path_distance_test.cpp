// The true distance of a body from its path: which point counts, and what is unknown.
#include "incognita/record/summary/path_distance.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "incognita/math/quaternion.hpp"

namespace incognita {
namespace {

/// At (1, 2, 3), heading along +y, with the reference 0.5 m ahead of it and 0.1 m above.
SnapshotBody heading_north() {
  SnapshotBody body;
  body.truth.emplace();
  body.truth->position = {1, 2, 3};
  body.truth->orientation = quaternion_exp<double>(Eigen::Vector3d(0, 0, std::numbers::pi / 2));
  body.reference = Eigen::Vector4d(1, 2.5, 3.1, 0);
  return body;
}

TEST(PathDistance, IsThatOfTheSteeredPoint) {
  const SnapshotBody body = heading_north();
  EXPECT_NEAR(from_path_m(body, false, {0, 0}), 0.5, 1e-12);
  EXPECT_NEAR(from_path_m(body, false, {0.5, 0}), 0, 1e-12) << "ahead of its origin";
  EXPECT_NEAR(from_path_m(body, false, {0.5, 0.2}), 0.2, 1e-12) << "and to the left of it";
}

TEST(PathDistance, CountsTheHeightOfABodyThatFlies) {
  EXPECT_NEAR(from_path_m(heading_north(), true, {0.5, 0}), 0.1, 1e-12);
}

TEST(PathDistance, IsUnknownWithoutTruthOrReference) {
  SnapshotBody body = heading_north();
  body.reference.reset();
  EXPECT_TRUE(std::isnan(from_path_m(body, false, {0, 0})));
  body = heading_north();
  body.truth.reset();
  EXPECT_TRUE(std::isnan(from_path_m(body, false, {0, 0})));
}

/// GPS measures no heading, so that the position of a point beside it is unknown.
TEST(PathDistance, OfAPointBesideTheBodyNeedsItsHeading) {
  SnapshotBody body = heading_north();
  body.truth->oriented = false;
  EXPECT_TRUE(std::isnan(from_path_m(body, false, {0.5, 0})));
  EXPECT_NEAR(from_path_m(body, false, {0, 0}), 0.5, 1e-12);
}

TEST(PathDistance, SummaryIsOfTheLastThird) {
  PathDistanceSummary summary(false, {0, 0});
  for (int k = 0; k < 9; ++k) {
    Snapshot s;
    s.bodies = {heading_north()};
    s.bodies[0].state = k == 8 ? TrackingState::lost : TrackingState::tracking;
    (*s.bodies[0].reference)[1] = k < 5 ? 9 : k < 8 ? 2.3 : 40;
    summary.add(s);
  }
  EXPECT_NEAR(summary.bodies(1)[0].median_m, 0.3, 1e-12);
  EXPECT_NEAR(summary.bodies(1)[0].p95_m, 0.3, 1e-12);
  EXPECT_TRUE(std::isnan(summary.bodies(2)[1].median_m)) << "a body that was never recorded";
}

}  // namespace
}  // namespace incognita
