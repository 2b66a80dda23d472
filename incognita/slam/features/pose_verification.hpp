// Whether a camera can be at a pose: active search for the landmarks that it would see from there.
#pragma once

#include <string>
#include <vector>

#include "incognita/slam/features/feature.hpp"
#include "incognita/slam/features/pose_hypotheses.hpp"
#include "incognita/vision/search.hpp"

namespace incognita {

/// Of a match in a new view, at least: the plane of its patch is not known well there.
constexpr double least_sigma_px = 1;

/// The result of the search from one pose.
struct PoseEvidence {
  CameraState camera;                 ///< at rest, by the matches
  PoseCov cov = PoseCov::Identity();  ///< of that pose, landmarks taken as independent
  std::vector<FeatureMatch> matches;  ///< of all landmarks that were searched for, predicted at that pose
  int matched = 0;                    ///< jointly consistent ones, whose outcome is `matched`
  double nis = 0;                     ///< of their innovations at that pose, by map and noise in a new view
  double spread_px = 0;               ///< rms distance of their pixels from a line through them
};

/// Searches for all landmarks that a camera at `x`, with covariance `cov` (independent of the map), predicts in view, keeps
/// what is jointly consistent with the map, and estimates the pose from it; twice, so that the second search is about
/// the better pose. Neither the estimate nor the camera changes. `matched` is 0 when no pose follows.
PoseEvidence gather_evidence(const SummedImage& image, const Estimate& estimate, const TrackedCamera& camera,
                             const CameraState& x, const PoseCov& cov);

/// The same from the pose that the matches of the camera give by themselves.
PoseEvidence gather_evidence(const SummedImage& image, const Estimate& estimate, const TrackedCamera& camera);

/// The reason why the evidence does not suffice for these settings; empty when it does.
std::string refusal_of(const PoseEvidence& evidence, const Camera& camera,
                       const CameraSlamSettings& settings);

/// Whether most landmarks that `b` matched were matched by `a` at the same pixels: the poses are the same.
bool share_matches(const PoseEvidence& a, const PoseEvidence& b);

/// Those of these landmarks that the evidence matched at the same pixels; whether they are most.
std::vector<PointMatch> matched_of(const PoseEvidence& evidence, const std::vector<PointMatch>& landmarks);
bool matches_most(const PoseEvidence& evidence, const std::vector<PointMatch>& landmarks);

}  // namespace incognita
