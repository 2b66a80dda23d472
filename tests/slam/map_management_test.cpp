// What is counted of landmarks from frame to frame.
#include "incognita/slam/features/map_management.hpp"

#include <gtest/gtest.h>

namespace incognita {
namespace {

Estimate looked_at(const std::vector<LookOutcome>& outcomes) {
  Estimate estimate;
  for (const LookOutcome outcome : outcomes) {
    Landmark landmark;
    landmark.kind = Landmark::Kind::anchor;
    landmark.id = estimate.next_id++;
    Look look;
    look.landmark = estimate.catalogue.size();
    look.outcome = outcome;
    estimate.catalogue.push_back(landmark);
    estimate.looks.push_back(look);
  }
  return estimate;
}

TEST(CountFramesAway, OnlyWhatUpdatesTheFilterIsThere) {
  Estimate estimate = looked_at({LookOutcome::matched, LookOutcome::not_found, LookOutcome::not_tried,
                                 LookOutcome::inconsistent, LookOutcome::alone});
  Landmark out_of_view;
  estimate.catalogue.push_back(out_of_view);
  for (int frame = 1; frame <= 3; ++frame) {
    count_frames_away(estimate);
    EXPECT_EQ(estimate.catalogue[0].frames_away, 0);
    for (std::size_t i = 1; i < 6; ++i) EXPECT_EQ(estimate.catalogue[i].frames_away, frame) << i;
  }
  estimate.looks[4].outcome = LookOutcome::matched;
  count_frames_away(estimate);
  EXPECT_EQ(estimate.catalogue[4].frames_away, 0) << "it came back";
}

/// What nobody bore out says nothing of the landmark: nor does what was not searched for.
TEST(CountAttempts, LeavesOutWhatIsAloneAndWhatWasNotTried) {
  Estimate estimate = looked_at({LookOutcome::matched, LookOutcome::not_found, LookOutcome::not_tried,
                                 LookOutcome::inconsistent, LookOutcome::alone});
  count_attempts(estimate);
  const std::vector<int> attempts{1, 1, 0, 1, 0}, matches{1, 0, 0, 0, 0};
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(estimate.catalogue[i].attempts, attempts[i]) << i;
    EXPECT_EQ(estimate.catalogue[i].matches, matches[i]) << i;
  }
}

}  // namespace
}  // namespace incognita
