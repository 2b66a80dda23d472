// Landmarks that are expected on the sides of a room and on the objects in it.
#include "incognita/decision/plan/side_cells.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "incognita/decision/plan/expected_surface.hpp"
#include "tests/saved_state.hpp"

namespace incognita {
namespace {

/// A box of 4 x 4 x 2 m.
ExplorationSettings small_room() {
  ExplorationSettings settings;
  settings.min_m = {-2, -2, 0};
  settings.max_m = {2, 2, 2};
  return settings;
}

void add_landmark(Estimate& estimate, const Eigen::Vector3d& at) {
  Landmark landmark{};
  landmark.id = new_id(estimate);
  landmark.block = estimate.belief.augment(PointLandmark::chart, at, {}, 1e-4 * Eigen::Matrix3d::Identity());
  estimate.landmarks.emplace(landmark.id, landmark);
}

/// Near an edge of the room, landmarks of one side must not pass for those of the other.
TEST(SideCells, AreCoveredByLandmarksOfTheirOwnSide) {
  SideCells sides(small_room());
  Estimate estimate;
  add_landmark(estimate, {2.01, 0.5, 0.2});  // on the wall, low
  sides.compare(estimate);
  EXPECT_EQ(sides.expected().size(), 63u) << "the cell of the floor in front of it is not covered";
}

TEST(SideCells, ExpectOneLandmarkPerCellUntilOneIsMappedThere) {
  SideCells sides(small_room());
  Estimate estimate;
  sides.compare(estimate);
  EXPECT_EQ(sides.expected().size(), 2u * 16 + 4 * 8);
  add_landmark(estimate, {2.1, 0.4, 0.6});
  sides.compare(estimate);
  EXPECT_EQ(sides.expected().size(), 63u);
  for (const ExpectedLandmark& expected : sides.expected())
    EXPECT_FALSE(expected.position.isApprox(Eigen::Vector3d(2, 0.5, 0.5)));
}

TEST(SideCells, ArePatientAgainWhereALandmarkWasLost) {
  SideCells sides(small_room());
  Estimate estimate;
  add_landmark(estimate, {2.0, 0.4, 0.6});
  sides.compare(estimate);
  sides.see([](const Eigen::Vector3d&) { return true; }, {0, 0, 1}, 100);
  estimate.landmarks.clear();
  sides.compare(estimate);
  const auto expects = [&](const Eigen::Vector3d& at) {
    return std::ranges::any_of(sides.expected(), [&](const ExpectedLandmark& e) {
      return e.position.isApprox(at) && e.probability == 1;
    });
  };
  EXPECT_TRUE(expects({2, 0.5, 0.5}));
  EXPECT_FALSE(expects({2, -0.5, 0.5})) << "this one was in view for long without a landmark";
}

TEST(SideCells, GiveUpWhatWasInViewForLongWithoutALandmark) {
  SideCells sides(small_room());  // patience 3 s
  const Estimate estimate;
  const auto look = [&](double s) {
    sides.see([](const Eigen::Vector3d& at) { return at.x() > 1.9; }, {0, 0, 1}, s);
    sides.compare(estimate);
  };
  look(3);
  ASSERT_EQ(sides.expected().size(), 64u);
  for (const ExpectedLandmark& expected : sides.expected())  // other sides there are seen along them
    EXPECT_NEAR(expected.probability, expected.normal.x() == -1 ? std::exp(-1) : 1, 1e-9);
  look(10);
  EXPECT_EQ(sides.expected().size(), 64u - 8);
}

TEST(SideCells, ExpectTheOtherFacesOfAnObject) {
  SideCells sides(small_room());
  Estimate estimate;
  const auto faces_in_the_room = [&](const Eigen::Vector3d& normal) {
    return std::ranges::count_if(sides.expected(), [&](const ExpectedLandmark& e) {
      return (e.position.head<2>().cwiseAbs().array() < 1.9).all() && e.position.z() > 0.1 &&
             e.position.z() < 1.9 && e.normal == normal;
    });
  };
  const Eigen::Vector3d back(1, 0, 0), front(-1, 0, 0);
  add_landmark(estimate, {0.1, 0.3, 0.5});  // in the cell from (0, 0, 0) to (1, 1, 1), near its face at -x
  sides.compare(estimate);
  EXPECT_EQ(faces_in_the_room(back), 0) << "one landmark alone may be wrong";
  add_landmark(estimate, {0.1, 0.6, 0.4});
  sides.compare(estimate);
  EXPECT_EQ(faces_in_the_room(back), 1);
  EXPECT_EQ(faces_in_the_room(front), 0) << "this one is mapped";
}

TEST(SideCells, AreSeenUnderThirtyDegreesOrMore) {
  EXPECT_TRUE(sees_surface({0, 0, 1}, {1.7, 0, 0}, {0, 0, 1}));
  EXPECT_FALSE(sees_surface({0, 0, 1}, {1.8, 0, 0}, {0, 0, 1}));
  EXPECT_FALSE(sees_surface({0, 0, -1}, {0, 0, 0}, {0, 0, 1})) << "from behind";
  EXPECT_TRUE(sees_surface({0, 0, 1}, {9, 0, 0}, {0, 0, 0})) << "on no surface";
}

TEST(SideCells, AreRestoredWithWhatWasSeen) {
  SideCells sides(small_room()), restored(small_room());
  Estimate estimate;
  add_landmark(estimate, {0.1, 0.3, 0.5});
  add_landmark(estimate, {0.1, 0.6, 0.4});
  sides.compare(estimate);
  sides.see([](const Eigen::Vector3d&) { return true; }, {1.9, 0.5, 0.5}, 1);
  sides.compare(estimate);
  testing::restore(restored, sides);
  restored.compare(estimate);
  ASSERT_EQ(restored.expected().size(), sides.expected().size());
  bool less = false;
  for (std::size_t i = 0; i < sides.expected().size(); ++i) {
    EXPECT_EQ(restored.expected()[i].probability, sides.expected()[i].probability);
    less |= sides.expected()[i].index >= 64 && sides.expected()[i].probability < 1;
  }
  EXPECT_TRUE(less) << "the face of the object was seen, or the test compares nothing";
}

TEST(SideCells, RefuseTooManyCells) {
  ExplorationSettings settings = small_room();
  settings.side_cell_m = 0.001;
  EXPECT_THROW(SideCells{settings}, std::invalid_argument);
}

}  // namespace
}  // namespace incognita
