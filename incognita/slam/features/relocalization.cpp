#include "incognita/slam/features/relocalization.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "incognita/slam/features/recognition.hpp"

namespace incognita {
namespace {

constexpr double rival_share =
    0.6;                     // of the matches of the best pose: another pose with more makes it ambiguous
constexpr double wider = 3;  // search about a pose of RANSAC: its inliers may be false

PoseLimits pose_limits(const MapSettings& map) {
  PoseLimits limits;
  limits.max_view_angle_rad = 1.1 * map.max_view_angle_rad;
  limits.max_scale = 1.1 * map.max_scale;
  return limits;
}

}  // namespace

std::optional<PoseEvidence> Relocalization::search(const SummedImage& image, const Estimate& estimate,
                                                   const TrackedCamera& camera) {
  const RelocalizationSettings& settings = camera.settings.relocalization;
  const std::vector<PointMatch> recognized =
      recognize_landmarks(image.image(), estimate, camera, RecognitionLimits{});
  const double sigma_px = std::max(1.0, std::sqrt(camera.pixel_var()));
  const std::vector<PoseHypothesis> hypotheses =
      find_poses(recognized, camera.camera, pose_limits(camera.settings.map), sigma_px, random_);
  struct Tried {
    PoseEvidence evidence;
    int distinctive;
  };
  std::vector<Tried> found;
  for (const PoseHypothesis& hypothesis : hypotheses)
    found.push_back(
        {gather_evidence(image, estimate, camera, hypothesis.camera, wider * wider * hypothesis.cov),
         hypothesis.distinctive});
  std::stable_sort(found.begin(), found.end(),
                   [](const Tried& a, const Tried& b) { return a.evidence.matched > b.evidence.matched; });
  if (found.empty() || found.front().distinctive < settings.min_distinctive) return std::nullopt;
  PoseEvidence& best = found.front().evidence;
  if (!refusal_of(best, camera.camera, camera.settings).empty()) return std::nullopt;
  const bool is_ambiguous = std::ranges::any_of(found, [&](const Tried& rival) {
    return rival.evidence.matched > rival_share * best.matched && !share_matches(best, rival.evidence);
  });
  if (is_ambiguous) return std::nullopt;
  return std::move(best);
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
