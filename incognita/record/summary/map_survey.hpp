// Compares the map of a run with surveyed landmarks.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "incognita/analysis/evaluation/trajectory.hpp"
#include "incognita/record/snapshot/snapshot.hpp"

namespace incognita {

struct SurveyedLandmark {
  std::int64_t id = 0;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< m, in the frame of the truth
};

/// The true landmarks known before a run; used for evaluation only, never by the estimator.
struct Survey {
  std::vector<SurveyedLandmark> landmarks;
  bool identified = false;  ///< map landmarks have the same identities
};

struct SurveyedMapError {
  double rms_m = 0;  ///< NaN without matches
  int matched = 0;   ///< map landmarks matched one to one with surveyed ones; no anchors
};

/// Landmarks without identity are matched one to one in the plane, nearest first, within this distance.
inline constexpr double survey_reach_m = 1;

/// Map error after applying the trajectory alignment `truth_from_map`.
SurveyedMapError surveyed_map_error(const std::vector<SnapshotLandmark>& map, const Survey& survey,
                                    const Alignment& truth_from_map);

/// Alignment of the map with the survey; requires three or more common identities, else nullopt.
std::optional<Alignment> align_to_survey(const std::vector<SnapshotLandmark>& map, const Survey& survey,
                                         AlignmentKind kind);

}  // namespace incognita
