// What is counted of landmarks from frame to frame.
#include "incognita/slam/features/map_management.hpp"

#include <gtest/gtest.h>

#include "tests/slam/synthetic_scene.hpp"

namespace incognita {
namespace {

using namespace synthetic;

/// One landmark with each of these outcomes, by id from 0.
Tracking with_outcomes(const std::vector<MatchOutcome>& outcomes) {
  Tracking t(camera_at({0, 0, 0}), CameraCov::Identity());
  for (const MatchOutcome outcome : outcomes) {
    FeatureMatch match;
    match.id = new_id(t.estimate);
    match.outcome = outcome;
    t.estimate.landmarks[match.id].fixed = true;
    t.tracked.features.try_emplace(match.id);
    t.tracked.matches.push_back(match);
  }
  return t;
}

const std::vector<MatchOutcome> one_of_each{MatchOutcome::matched, MatchOutcome::not_found,
                                            MatchOutcome::not_searched, MatchOutcome::outlier,
                                            MatchOutcome::unconfirmed};

TEST(CountFrames, AMatchThatUpdatesTheFilterStartsAnew) {
  Tracking t = with_outcomes(one_of_each);
  const std::int64_t out_of_view = 5;
  t.tracked.features.try_emplace(out_of_view);
  for (int frame = 1; frame <= 3; ++frame) {
    count_frames(t.tracked);
    EXPECT_EQ(t.feature(0).frames_away, 0);
    for (std::int64_t id = 1; id < 6; ++id) EXPECT_EQ(t.feature(id).frames_away, frame) << id;
  }
  t.tracked.matches[4].outcome = MatchOutcome::matched;
  count_frames(t.tracked);
  EXPECT_EQ(t.feature(4).frames_away, 0) << "it came back";
}

TEST(CountFrames, OfAVisitBeginWhenItComesIntoView) {
  Tracking t = with_outcomes({MatchOutcome::not_found});
  const std::vector<FeatureMatch> in_view = t.tracked.matches;
  for (int frame = 1; frame <= 3; ++frame) {
    count_frames(t.tracked);
    EXPECT_EQ(t.feature(0).frames_since_return(), frame);
  }
  t.tracked.matches.clear();
  for (int frame = 0; frame < 2; ++frame) count_frames(t.tracked);
  EXPECT_EQ(t.feature(0).frames_since_return(), 0);
  t.tracked.matches = in_view;
  count_frames(t.tracked);
  EXPECT_EQ(t.feature(0).frames_since_return(), 1);
  EXPECT_EQ(t.feature(0).frames_known, 6);
}

/// A landmark that returns beside where it is expected may be right, and the camera wrong.
TEST(DeleteBadLandmarks, KeepsThoseThatMayBeRight) {
  const CameraState from = camera_at({0, 0, 0});
  const Wall wall(2);
  Tracking t(from, 1e-6 * CameraCov::Identity());
  const Image image = wall.seen_from(from);
  const std::vector<Eigen::Vector3d> corners = wall.corners_in_view(from);
  for (const int away : {40, 10}) {
    const Eigen::Vector3d& at = corners[static_cast<std::size_t>(away)];
    Feature& feature = t.feature(t.add_point(image, from, at, at, 0.01));
    feature.attempts = 50;
    feature.frames_known = 100;
    feature.frames_away = away;
    t.tracked.matches.emplace_back().id = t.tracked.features.rbegin()->first;
    t.tracked.matches.back().outcome = MatchOutcome::not_found;
  }
  delete_bad_landmarks(t.estimate, t.tracked);
  ASSERT_EQ(t.tracked.features.size(), 1u);
  EXPECT_EQ(t.tracked.features.begin()->second.frames_away, 40);
}

/// An unconfirmed match carries no information about the landmark, nor does a search that was not made.
TEST(CountAttempts, LeavesOutUnconfirmedMatchesAndThoseNotSearched) {
  Tracking t = with_outcomes(one_of_each);
  count_attempts(t.estimate, t.tracked);
  const std::vector<int> attempts{1, 1, 0, 1, 0}, matches{1, 0, 0, 0, 0};
  for (std::size_t id = 0; id < 5; ++id) {
    EXPECT_EQ(t.feature(static_cast<std::int64_t>(id)).attempts, attempts[id]) << id;
    EXPECT_EQ(t.landmark(static_cast<std::int64_t>(id)).detection_count, matches[id]) << id;
  }
}

}  // namespace
}  // namespace incognita
