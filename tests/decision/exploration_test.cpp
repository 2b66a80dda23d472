// The exploration prior: Figure 6.3.
#include "incognita/decision/exploration.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace incognita {
namespace {

ExplorationSettings room(int expected) {
  ExplorationSettings s;
  s.expected_landmarks = expected;
  return s;
}

bool nothing(const Eigen::Vector3d&) { return false; }

TEST(Exploration, ExpectsTheStatedNumberInsideTheVolume) {
  const Exploration e(room(27), 3);
  ASSERT_EQ(e.expected().size(), 27u);
  for (const ExpectedLandmark& l : e.expected()) {
    EXPECT_TRUE((l.position.array() >= Eigen::Array3d(-3, -3, 0)).all());
    EXPECT_TRUE((l.position.array() <= Eigen::Array3d(3, 3, 2.5)).all());
  }
  EXPECT_EQ(e.coverage(), 0);
  const Exploration same(room(27), 3), other(room(27), 4);
  for (std::size_t i = 0; i < 27; ++i) EXPECT_EQ(e.expected()[i].position, same.expected()[i].position);
  EXPECT_NE(e.expected()[0].position, other.expected()[0].position);
}

TEST(Exploration, SeenCellsExpectNoLandmarksAndOthersKeepThem) {
  Exploration e(room(20), 1);
  const auto east = [](const Eigen::Vector3d& p) { return p.x() > 0; };
  const auto count_east = [&] {
    int count = 0;
    for (const ExpectedLandmark& l : e.expected()) count += l.position.x() > 0.5;
    return count;
  };
  EXPECT_GT(count_east(), 0);
  for (int i = 0; i < 9; ++i) e.update(east, 0.1, 0);
  EXPECT_EQ(e.coverage(), 0) << "a cell counts as seen after one second";
  e.update(east, 0.1, 0);
  EXPECT_NEAR(e.coverage(), 0.5, 1e-12);
  EXPECT_EQ(e.expected().size(), 20u);
  EXPECT_EQ(count_east(), 0);
  const auto before = e.expected();
  e.update(nothing, 0.1, 0);
  for (std::size_t i = 0; i < before.size(); ++i) EXPECT_EQ(e.expected()[i].position, before[i].position);
  for (int i = 0; i < 10; ++i) e.update([](const Eigen::Vector3d&) { return true; }, 0.1, 0);
  EXPECT_EQ(e.coverage(), 1);
  EXPECT_TRUE(e.expected().empty()) << "no unseen cells remain";
}

TEST(Exploration, VolumeHasOneBitPerSeenCell) {
  ExplorationSettings settings = room(20);
  settings.min_m = {0, 0, 0};
  settings.max_m = {2, 1.5, 1};
  settings.cell_m = 0.6;  // shrunk to 4 x 3 x 2 cells of 0.5 m
  Exploration e(settings, 1);
  const auto first = e.volume();
  EXPECT_EQ(first->cells, Eigen::Vector3i(4, 3, 2));
  EXPECT_EQ(first->seen, std::vector<std::uint8_t>(3, 0));
  const auto upper_corner = [](const Eigen::Vector3d& p) { return p.x() > 1.5 && p.y() > 1 && p.z() < 0.5; };
  e.update(upper_corner, 0.6, 0);
  EXPECT_EQ(e.volume(), first) << "the same object until a cell becomes seen";
  e.update(upper_corner, 0.6, 0);
  EXPECT_EQ(e.volume()->seen, (std::vector<std::uint8_t>{0, 8, 0})) << "cell 11 of 24";
  EXPECT_EQ(first->seen, std::vector<std::uint8_t>(3, 0)) << "immutable";
  EXPECT_NEAR(e.coverage(), 1.0 / 24, 1e-12);
}

TEST(Exploration, MappedLandmarksReduceTheExpectedNumber) {
  Exploration e(room(10), 1);
  e.update(nothing, 0.1, 4);
  EXPECT_EQ(e.expected().size(), 6u);
  const std::vector<ExpectedLandmark> before = e.expected();
  e.update(nothing, 0.1, 12);
  EXPECT_TRUE(e.expected().empty());
  e.update(nothing, 0.1, 4);
  ASSERT_EQ(e.expected().size(), 6u) << "landmarks dropped from the map are expected again";
  for (std::size_t i = 0; i < 6; ++i)
    EXPECT_EQ(e.expected()[i].position, before[i].position) << "where it was before";
}

TEST(Exploration, ExpectsNothingByDefault) {
  Exploration e({}, 1);
  e.update([](const Eigen::Vector3d&) { return true; }, 10, 0);
  EXPECT_TRUE(e.expected().empty());
  EXPECT_EQ(e.coverage(), 0);
}

TEST(Exploration, EntropyOfUnmappedLandmarks) {
  const double each = 1.5 * (1 + std::log(2 * std::numbers::pi * 1.5));  // 3/2 (1 + log(2 pi variance))
  EXPECT_NEAR(entropy_of_unmapped(27, 1.5), 27 * each, 1e-9);
  EXPECT_EQ(entropy_of_unmapped(0, 1.5), 0);
  EXPECT_NEAR(entropy_of_unmapped(27, 1.5, 2), 27 * each * 2 / 3, 1e-9) << "on a plane";
}

TEST(Exploration, RefusesInvalidSettings) {
  ExplorationSettings s = room(5);
  s.max_m = s.min_m;
  EXPECT_THROW(Exploration(s, 1), std::invalid_argument);
  s = room(-1);
  EXPECT_THROW(Exploration(s, 1), std::invalid_argument);
  s = room(5);
  s.variance_expected_m2 = 0;
  EXPECT_THROW(Exploration(s, 1), std::invalid_argument);
  s = room(5);
  s.cell_m = 1e-3;
  EXPECT_THROW(Exploration(s, 1), std::invalid_argument);
}

}  // namespace
}  // namespace incognita
