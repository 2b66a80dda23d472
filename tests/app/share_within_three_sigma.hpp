// How many landmarks of a map lie where its covariance says.
#pragma once

#include <gtest/gtest.h>

#include "incognita/analysis/evaluation/pose_consistency.hpp"
#include "incognita/record/snapshot/snapshot.hpp"

namespace incognita {

/// Of the landmarks whose true position is known, the share whose error is within 3 sigma.
inline double share_within_three_sigma(const Snapshot& snapshot) {
  double known = 0, within = 0;
  for (const SnapshotLandmark& landmark : snapshot.landmarks) {
    if (landmark.anchor || !landmark.truth) continue;
    ++known;
    within += !beyond_three_sigma(*landmark.truth - landmark.position, landmark.covariance);
  }
  EXPECT_GT(known, 100);
  return within / known;
}

}  // namespace incognita
