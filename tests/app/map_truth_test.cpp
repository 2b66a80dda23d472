// The true positions of landmarks and the mapped share, as the loop puts them into the snapshots.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "incognita/analysis/evaluation/mapped_share.hpp"
#include "incognita/app/loop/assembly.hpp"
#include "incognita/app/loop/body_models.hpp"
#include "incognita/app/loop/loop.hpp"
#include "incognita/record/summary/outcome_summary.hpp"
#include "incognita/world/rendered/room_layout.hpp"

namespace incognita {
namespace {

/// What a run showed of its map.
struct MapOfRun {
  std::vector<double> mapped;  ///< by frame; -1: unknown
  Snapshot last;
  OutcomeMeasures outcome;
};

MapOfRun map_of(const std::string& scenario, const std::vector<std::string>& settings) {
  Assembly assembly = assemble(load_scenario(scenario, settings));
  OutcomeSummary summary(same_frame_as_truth(assembly.info));
  MapOfRun run;
  run_loop(
      assembly.parts,
      [&](const Snapshot& s) {
        run.mapped.push_back(s.mapped.value_or(-1));
        summary.add(s);
        run.last = s;
      },
      [](const Tick&) { return true; });
  run.outcome = summary.measures();
  return run;
}

/// Distance from the nearest wall, floor or ceiling, or side of a box, m.
double distance_from_surfaces(const RoomLayout& room, const Eigen::Vector3d& p) {
  const auto from_box = [&](const Box& box) {
    double nearest = 1e9;
    for (int axis = 0; axis < 3; ++axis)
      for (const double side : {box.min[axis], box.max[axis]}) {
        Eigen::Vector3d on = p.cwiseMax(box.min).cwiseMin(box.max);
        on[axis] = side;
        nearest = std::min(nearest, (p - on).norm());
      }
    return nearest;
  };
  double nearest = from_box(room.inside);
  for (const Box& box : room.boxes) nearest = std::min(nearest, from_box(box));
  return nearest;
}

TEST(MapTruth, LandmarksOfTheRoomTrulyLieOnItsSurfaces) {
  const std::vector<std::string> settings{"run.duration_s=12", "run.seed=2", "decision.gaze=constant-rate"};
  const MapOfRun run = map_of("explore-room", settings);
  const RoomLayout room = room_layout(load_scenario("explore-room", settings).scenario.room, 2);
  int known = 0, near = 0;
  for (const SnapshotLandmark& landmark : run.last.landmarks) {
    if (landmark.anchor) {
      EXPECT_FALSE(landmark.truth);
      continue;
    }
    ASSERT_TRUE(landmark.truth) << landmark.id;
    EXPECT_LT(distance_from_surfaces(room, *landmark.truth), 1e-9);
    ++known;
    near += (landmark.position - *landmark.truth).norm() < 0.1;
  }
  EXPECT_GT(known, 20);
  EXPECT_GT(near, known / 2) << "the estimates are of these points";
  EXPECT_EQ(run.outcome.landmarks, known);
}

TEST(MapTruth, TheMappedShareGrowsAndIsTheSameForTheSameSeed) {
  const std::vector<std::string> settings{"run.duration_s=10", "run.seed=4"};
  const MapOfRun run = map_of("explore-room", settings), again = map_of("explore-room", settings);
  EXPECT_EQ(run.mapped.front(), 0);
  EXPECT_GT(run.mapped.back(), 0.02);
  EXPECT_LT(run.mapped.back(), 0.9);
  EXPECT_EQ(run.mapped, again.mapped);
  EXPECT_EQ(run.outcome.map_rms_m, again.outcome.map_rms_m);
  EXPECT_EQ(run.outcome.mapped, run.mapped.back());
  EXPECT_EQ(run.outcome.mapped_60_s, std::nullopt);
}

TEST(MapTruth, OnUnevenGroundToo) {
  const MapOfRun run = map_of("explore-terrain", {"run.duration_s=5"});
  EXPECT_GT(run.mapped.back(), 0);
  EXPECT_GT(run.outcome.landmarks, 5);
}

TEST(MapTruth, WithoutATargetThereIsNoFrameToCompare) {
  const MapOfRun run = map_of("room", {"run.duration_s=1", "start.from=free"});
  EXPECT_EQ(run.mapped.back(), -1);
  EXPECT_EQ(run.outcome.mapped, std::nullopt);
  EXPECT_EQ(run.outcome.diverged, std::nullopt);
}

/// Share of the points, without the anchors, that have a landmark within 5 cm, whatever its identity.
double share_of_points(const LoadedScenario& loaded, const Snapshot& s) {
  int unknown = 0, mapped = 0;
  for (const auto& [identity, point] : point_landmarks_of(loaded)) {
    const auto is_at = [at = Eigen::VectorXd(point)](const SnapshotLandmark& landmark, double limit_m) {
      return (landmark.position.head(at.size()) - at).norm() <= limit_m;
    };
    if (std::ranges::any_of(s.landmarks, [&](const auto& l) { return l.anchor && is_at(l, 1e-9); })) continue;
    ++unknown;
    mapped += std::ranges::any_of(s.landmarks,
                                  [&](const auto& l) { return !l.anchor && is_at(l, mapped_within_m); });
  }
  return static_cast<double>(mapped) / unknown;
}

TEST(MapTruth, OfAPointWorldTheShareOfItsUnknownPoints) {
  const std::vector<std::string> settings{"run.duration_s=8"};
  const MapOfRun run = map_of("free-camera", settings);
  EXPECT_GT(run.outcome.landmarks, 5);
  EXPECT_DOUBLE_EQ(run.mapped.back(), share_of_points(load_scenario("free-camera", settings), run.last));
  EXPECT_LT(run.outcome.map_rms_m.value(), 1);
}

TEST(MapTruth, WithoutIdentitiesALandmarkStandsForThePointThatInitializedIt) {
  const std::vector<std::string> settings{"run.duration_s=20", "association.method=nearest"};
  const MapOfRun run = map_of("circle", settings);
  EXPECT_GT(run.outcome.landmarks, 5);
  std::set<double> true_x;
  for (const SnapshotLandmark& landmark : run.last.landmarks)
    if (landmark.truth) {
      true_x.insert(landmark.truth->x());
      EXPECT_LT((landmark.position - *landmark.truth).norm(), 1);
    }
  EXPECT_GT(true_x.size(), 5u);
  EXPECT_DOUBLE_EQ(run.mapped.back(), share_of_points(load_scenario("circle", settings), run.last));
}

}  // namespace
}  // namespace incognita
