#include "incognita/record/summary/map_survey.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace incognita {
namespace {

SnapshotLandmark mapped(std::int64_t id, double x, double y, bool anchor = false) {
  SnapshotLandmark landmark;
  landmark.id = id;
  landmark.anchor = anchor;
  landmark.position = {x, y, 0};
  return landmark;
}

Survey survey(bool identified) { return {{{1, {0, 0, 0}}, {2, {10, 0, 0}}, {3, {0, 5, 0}}}, identified}; }

TEST(MapSurvey, MatchesByIdentityAtAnyDistance) {
  const std::vector<SnapshotLandmark> map{mapped(1, 3, 0), mapped(2, 10, 4), mapped(9, 0, 5),
                                          mapped(3, 7, 7, true)};
  const auto error = surveyed_map_error(map, survey(true), {});
  EXPECT_EQ(error.matched, 2) << "one landmark is not surveyed, one is an anchor";
  EXPECT_NEAR(error.rms_m, std::sqrt((9.0 + 16) / 2), 1e-12);
}

TEST(MapSurvey, MatchesByPositionOneToOneWithinAGate) {
  const std::vector<SnapshotLandmark> map{mapped(7, 0.3, 0), mapped(8, 0.6, 0), mapped(9, 10, 2)};
  const auto error = surveyed_map_error(map, survey(false), {});
  EXPECT_EQ(error.matched, 1);
  EXPECT_NEAR(error.rms_m, 0.3, 1e-12);
  EXPECT_TRUE(std::isnan(surveyed_map_error({}, survey(false), {}).rms_m));
}

TEST(MapSurvey, IsComparedInTheFrameOfTheTruth) {
  Alignment a;
  a.scale = 2;
  a.rotation << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  a.translation = {1, 2, 0};
  std::vector<SnapshotLandmark> map;
  for (const SurveyedLandmark& s : survey(true).landmarks) {
    const Eigen::Vector3d p = a.rotation.transpose() * (s.position - a.translation) / a.scale;
    map.push_back(mapped(s.id, p.x(), p.y()));
  }
  EXPECT_NEAR(surveyed_map_error(map, survey(true), a).rms_m, 0, 1e-12);
  const auto fitted = align_to_survey(map, survey(true), AlignmentKind::sim3);
  ASSERT_TRUE(fitted);
  EXPECT_NEAR(fitted->scale, 2, 1e-9);
  EXPECT_NEAR(surveyed_map_error(map, survey(true), *fitted).rms_m, 0, 1e-9);
  map.pop_back();
  EXPECT_FALSE(align_to_survey(map, survey(true), AlignmentKind::se3)) << "two points fit anything";
  EXPECT_FALSE(align_to_survey(map, survey(false), AlignmentKind::se3));
}

}  // namespace
}  // namespace incognita
