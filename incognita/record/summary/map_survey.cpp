#include "incognita/record/summary/map_survey.hpp"

#include <limits>
#include <map>

#include "incognita/analysis/evaluation/map_error.hpp"

namespace incognita {
namespace {

/// Aligned landmarks of the map without anchors, whose positions are given.
std::vector<SurveyedLandmark> aligned_map(const std::vector<SnapshotLandmark>& map, const Alignment& a) {
  std::vector<SurveyedLandmark> mapped;
  for (const SnapshotLandmark& landmark : map)
    if (!landmark.anchor)
      mapped.push_back({landmark.id, a.scale * a.rotation * landmark.position + a.translation});
  return mapped;
}

/// Pairs of mapped and surveyed positions with the same identity.
MatchedTrajectories matched_by_identity(const std::vector<SurveyedLandmark>& mapped, const Survey& survey) {
  std::map<std::int64_t, Eigen::Vector3d> surveyed;
  for (const SurveyedLandmark& landmark : survey.landmarks) surveyed.emplace(landmark.id, landmark.position);
  MatchedTrajectories pairs;
  for (const SurveyedLandmark& landmark : mapped) {
    const auto found = surveyed.find(landmark.id);
    if (found == surveyed.end()) continue;
    pairs.estimate.push_back({0, landmark.position});
    pairs.truth.push_back({0, found->second});
  }
  return pairs;
}

SurveyedMapError by_identity(const std::vector<SurveyedLandmark>& mapped, const Survey& survey) {
  const MatchedTrajectories pairs = matched_by_identity(mapped, survey);
  if (pairs.truth.empty()) return {std::numeric_limits<double>::quiet_NaN(), 0};
  return {absolute_trajectory_error(pairs).rmse, static_cast<int>(pairs.truth.size())};
}

SurveyedMapError by_position(const std::vector<SurveyedLandmark>& mapped, const Survey& survey) {
  const auto on_plane = [](const std::vector<SurveyedLandmark>& landmarks) {
    std::vector<Eigen::Vector2d> positions;
    for (const SurveyedLandmark& landmark : landmarks) positions.push_back(landmark.position.head<2>());
    return positions;
  };
  const MapError error = map_error(on_plane(mapped), on_plane(survey.landmarks), survey_reach_m);
  return {error.rms_m, static_cast<int>(error.matches.size())};
}

}  // namespace

SurveyedMapError surveyed_map_error(const std::vector<SnapshotLandmark>& map, const Survey& survey,
                                    const Alignment& truth_from_map) {
  const std::vector<SurveyedLandmark> mapped = aligned_map(map, truth_from_map);
  return survey.identified ? by_identity(mapped, survey) : by_position(mapped, survey);
}

std::optional<Alignment> align_to_survey(const std::vector<SnapshotLandmark>& map, const Survey& survey,
                                         AlignmentKind kind) {
  constexpr std::size_t fewest = 3;  // two points can always be aligned
  if (!survey.identified) return std::nullopt;
  const MatchedTrajectories pairs = matched_by_identity(aligned_map(map, {}), survey);
  return pairs.truth.size() < fewest ? std::nullopt : align(pairs, kind);
}

}  // namespace incognita
