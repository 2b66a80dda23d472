#include "incognita/slam/features/relocalization.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "incognita/slam/features/recognition.hpp"

namespace incognita {
namespace {

// Another pose with more than this share of the matches of the best one makes it ambiguous, unless it predicts much in view that
// is not there
constexpr double rival_share = 0.6, less_share = 0.15;
constexpr double wider = 3;  // search about a pose of RANSAC: its inliers may be false

PoseLimits pose_limits(const MapSettings& map) {
  PoseLimits limits;
  limits.max_view_angle_rad = 1.1 * map.max_view_angle_rad;
  limits.max_scale = 1.1 * map.max_scale;
  return limits;
}

/// Whether another pose explains more matches, or nearly as many and nearly as large a share of what it predicts in view.
bool is_rival(const PoseEvidence& other, const PoseEvidence& best) {
  const auto share = [](const PoseEvidence& e) {
    return e.matched / std::max(1.0, static_cast<double>(e.matches.size()));
  };
  const bool is_similar =
      other.matched > rival_share * best.matched && share(other) > share(best) - less_share;
  return (is_similar || other.matched > best.matched) && !share_matches(best, other);
}

}  // namespace

/// The evidence for each pose by which the landmarks recognized in the image may be seen, the most matches first.
std::vector<Relocalization::Tried> Relocalization::poses_in_map(const SummedImage& image,
                                                                const Estimate& estimate,
                                                                const TrackedCamera& camera,
                                                                const std::vector<PointMatch>& recognized) {
  const double sigma_px = std::max(1.0, std::sqrt(camera.error_var()));
  std::vector<Tried> tried;
  for (const PoseHypothesis& hypothesis :
       find_poses(recognized, camera.camera, pose_limits(camera.settings.map), sigma_px, random_)) {
    Tried pose{gather_evidence(image, estimate, camera, hypothesis.camera, wider * wider * hypothesis.cov),
               {}};
    for (const int i : hypothesis.matches) pose.recognized.push_back(recognized[static_cast<std::size_t>(i)]);
    tried.push_back(std::move(pose));
  }
  std::stable_sort(tried.begin(), tried.end(),
                   [](const Tried& a, const Tried& b) { return a.evidence.matched > b.evidence.matched; });
  return tried;
}

/// Number of recognized landmarks that look like no other.
int Relocalization::distinctive_count(const Tried& tried) {
  return static_cast<int>(std::ranges::count_if(tried.recognized, &PointMatch::is_distinctive));
}

/// Whether the camera may as well be at another pose: active search finds about as much there, or the pose explains more of what is
/// recognized in the image, and more of what is distinctive. Where a building repeats, every feature in view may match at
/// the wrong place, while of the right one the map has few features.
bool Relocalization::is_elsewhere(const Tried& other, const Tried& best) {
  if (is_rival(other.evidence, best.evidence)) return true;
  const bool is_same_place =
      share_matches(best.evidence, other.evidence) || matches_most(best.evidence, other.recognized);
  return !is_same_place && other.recognized.size() > best.recognized.size() &&
         distinctive_count(other) > distinctive_count(best);
}

std::optional<PoseEvidence> Relocalization::search(const SummedImage& image, const Estimate& estimate,
                                                   const TrackedCamera& camera) {
  std::vector<Tried> tried = poses_in_map(
      image, estimate, camera, recognize_landmarks(image.image(), estimate, camera, RecognitionLimits{}));
  if (tried.empty() || distinctive_count(tried.front()) < camera.settings.relocalization.min_distinctive)
    return std::nullopt;
  Tried& best = tried.front();
  if (!refusal_of(best.evidence, camera.camera, camera.settings).empty()) return std::nullopt;
  if (std::ranges::any_of(tried, [&](const Tried& other) { return is_elsewhere(other, best); }))
    return std::nullopt;
  return std::move(best.evidence);
}

/// From the matches of the camera, unless the map holds another pose that explains the image as well.
std::optional<PoseEvidence> Relocalization::near_last_pose(const SummedImage& image, const Estimate& estimate,
                                                           const TrackedCamera& camera) {
  if (camera.matched == 0) return std::nullopt;
  Tried found{gather_evidence(image, estimate, camera), {}};
  if (!refusal_of(found.evidence, camera.camera, camera.settings).empty()) return std::nullopt;
  const std::vector<PointMatch> recognized =
      recognize_landmarks(image.image(), estimate, camera, RecognitionLimits{});
  found.recognized = matched_of(found.evidence, recognized);
  const std::vector<Tried> tried = poses_in_map(image, estimate, camera, recognized);
  if (std::ranges::any_of(tried, [&](const Tried& other) { return is_elsewhere(other, found); }))
    return std::nullopt;
  return std::move(found.evidence);
}

std::optional<PoseEvidence> Relocalization::confirm(const SummedImage& image, const Estimate& estimate,
                                                    const TrackedCamera& camera, double t) const {
  const RelocalizationSettings& settings = camera.settings.relocalization;
  const double dt = t - candidate_->t;
  PoseCov cov = candidate_->cov;
  cov.diagonal().head<3>().array() += std::pow(settings.sigma_velocity_m_s * dt, 2);
  cov.diagonal().tail<3>().array() += std::pow(settings.sigma_rate_rad_s * dt, 2);
  PoseEvidence evidence = gather_evidence(image, estimate, camera, candidate_->camera, cov);
  if (!refusal_of(evidence, camera.camera, camera.settings).empty()) return std::nullopt;
  return evidence;
}

std::optional<PoseEvidence> Relocalization::find(const SummedImage& image, const Estimate& estimate,
                                                 const TrackedCamera& camera, double t) {
  const RelocalizationSettings& settings = camera.settings.relocalization;
  std::optional<PoseEvidence> evidence;
  if (candidate_) evidence = confirm(image, estimate, camera, t);
  int frames = evidence ? candidate_->frames : 0;
  if (!evidence) {
    candidate_.reset();
    evidence = near_last_pose(image, estimate, camera);
  }
  if (!evidence) {
    if (frames_until_search_-- > 0) return std::nullopt;
    frames_until_search_ = settings.period_frames - 1;
    evidence = search(image, estimate, camera);
    if (!evidence) return std::nullopt;
  }
  candidate_ = Candidate{evidence->camera, evidence->cov, t, ++frames};
  if (frames < settings.confirmations) return std::nullopt;
  candidate_.reset();
  return evidence;
}

}  // namespace incognita
