// What is counted of landmarks from frame to frame.
#include "incognita/slam/features/map_management.hpp"

#include <gtest/gtest.h>

namespace incognita {
namespace {

Estimate looked_at(const std::vector<MatchOutcome>& outcomes) {
  Estimate estimate;
  for (const MatchOutcome outcome : outcomes) {
    Landmark landmark;
    landmark.kind = Landmark::Kind::anchor;
    landmark.id = estimate.next_id++;
    FeatureMatch match;
    match.landmark = estimate.catalog.size();
    match.outcome = outcome;
    estimate.catalog.push_back(landmark);
    estimate.matches.push_back(match);
  }
  return estimate;
}

TEST(CountFramesAway, OnlyWhatUpdatesTheFilterIsThere) {
  Estimate estimate = looked_at({MatchOutcome::matched, MatchOutcome::not_found, MatchOutcome::not_searched,
                                 MatchOutcome::outlier, MatchOutcome::unconfirmed});
  Landmark out_of_view;
  estimate.catalog.push_back(out_of_view);
  for (int frame = 1; frame <= 3; ++frame) {
    count_frames_away(estimate);
    EXPECT_EQ(estimate.catalog[0].frames_away, 0);
    for (std::size_t i = 1; i < 6; ++i) EXPECT_EQ(estimate.catalog[i].frames_away, frame) << i;
  }
  estimate.matches[4].outcome = MatchOutcome::matched;
  count_frames_away(estimate);
  EXPECT_EQ(estimate.catalog[4].frames_away, 0) << "it came back";
}

/// What nobody bore out says nothing of the landmark: nor does what was not searched for.
TEST(CountAttempts, LeavesOutWhatIsAloneAndWhatWasNotTried) {
  Estimate estimate = looked_at({MatchOutcome::matched, MatchOutcome::not_found, MatchOutcome::not_searched,
                                 MatchOutcome::outlier, MatchOutcome::unconfirmed});
  count_attempts(estimate);
  const std::vector<int> attempts{1, 1, 0, 1, 0}, matches{1, 0, 0, 0, 0};
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(estimate.catalog[i].attempts, attempts[i]) << i;
    EXPECT_EQ(estimate.catalog[i].matches, matches[i]) << i;
  }
}

}  // namespace
}  // namespace incognita
