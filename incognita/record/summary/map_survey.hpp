// The map of a run against surveyed landmarks.
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

/// What is known of the true landmarks before a run. Never for the estimator.
struct Survey {
  std::vector<SurveyedLandmark> landmarks;
  bool identified = false;  ///< landmarks of the map have the same identities
};

struct SurveyedMapError {
  double rms_m = 0;  ///< NaN without matches
  int matched = 0;   ///< landmarks of the map, each with a surveyed one of its own; no anchors
};

/// Landmarks without identities are matched on the plane, one to one, the nearest first, within this
/// distance.
inline constexpr double survey_reach_m = 1;

/// After `truth_from_map`, as the trajectory was aligned.
SurveyedMapError surveyed_map_error(const std::vector<SnapshotLandmark>& map, const Survey& survey,
                                    const Alignment& truth_from_map);

/// The alignment of a map with its survey, for landmarks with identities, three or more; else nothing.
std::optional<Alignment> align_to_survey(const std::vector<SnapshotLandmark>& map, const Survey& survey,
                                         AlignmentKind kind);

}  // namespace incognita
