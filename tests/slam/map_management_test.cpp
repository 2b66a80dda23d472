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

TEST(CountFramesAway, AMatchThatUpdatesTheFilterStartsAnew) {
  Tracking t = with_outcomes(one_of_each);
  const std::int64_t out_of_view = 5;
  t.tracked.features.try_emplace(out_of_view);
  for (int frame = 1; frame <= 3; ++frame) {
    count_frames_away(t.tracked);
    EXPECT_EQ(t.feature(0).frames_away, 0);
    for (std::int64_t id = 1; id < 6; ++id) EXPECT_EQ(t.feature(id).frames_away, frame) << id;
  }
  t.tracked.matches[4].outcome = MatchOutcome::matched;
  count_frames_away(t.tracked);
  EXPECT_EQ(t.feature(4).frames_away, 0) << "it came back";
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
