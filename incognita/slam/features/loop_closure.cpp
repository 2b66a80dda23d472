#include "incognita/slam/features/loop_closure.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "incognita/math/gaussian.hpp"
#include "incognita/math/median.hpp"
#include "incognita/math/quaternion.hpp"

namespace incognita {
namespace {

constexpr int away_frames = 30;  // without a match before it came into view, after which a landmark returns
constexpr int kept_frames = 60;  // in view, in which landmarks that are missed are not deleted
constexpr int frames_between = 15;  // failed searches: each takes as long as several frames
constexpr double most_found =
    0.25;  // times the missed, of the landmarks known before: of more, these are right
// Larger differences are more probably of another place that looks alike
constexpr double most_drift_depths = 0.3, most_turn_rad = 0.3;
// The filter corrects smaller drifts by itself, and better than the pose of a few landmarks shows them
constexpr double least_drift_rad = 0.02;
constexpr double least_missed_share = 0.5,
                 most_lost_share = 0.1;  // of the missed found, of the tracked lost by the correction
constexpr double least_searched_share =
    0.5;  // of the tracked: the missed, less certain, are searched for first

/// Not found in this frame, or not searched for in it after it was in view in earlier ones: failed searches make further ones less
/// urgent.
bool is_missed(const FeatureMatch& match, const TrackedCamera& camera) {
  const Feature& feature = camera.features.at(match.id);
  const bool was_searched = match.outcome == MatchOutcome::not_searched && feature.frames_since_return() > 0;
  if (match.outcome != MatchOutcome::not_found && !was_searched) return false;
  return feature.frames_away - feature.frames_since_return() >= away_frames;
}

/// The camera with the landmarks only that were known then.
TrackedCamera with_landmarks_known(const TrackedCamera& camera, int frames_ago) {
  TrackedCamera out{
      .camera = camera.camera, .settings = camera.settings, .index = camera.index, .body = camera.body};
  for (const auto& [id, feature] : camera.features)
    if (feature.frames_known > frames_ago) out.features.emplace(id, feature);
  out.view = camera.view;
  out.sigma_pixel_px = camera.sigma_pixel_px;
  out.settings.relocalization.period_frames = 1;  // frames_between here
  return out;
}

using PoseErrors = Eigen::Matrix<double, 6, 1>;  ///< translation, turn after it; world axes

/// Variance of the drift, rad^2, of which the pose is typical: the normalized square of the offset is as large as its degrees of
/// freedom. `shape`: covariance of the drift per variance. Nothing if the errors of the pose explain the offset.
std::optional<double> drift_var(const PoseErrors& offset, const PoseCov& pose_cov, const PoseCov& shape) {
  constexpr double significance = 0.99, degrees = 6;
  const auto square = [&](double var) {
    return offset.dot(PoseCov(var * shape + pose_cov).llt().solve(offset));
  };
  if (square(0) < chi_square_quantile(significance, 6)) return std::nullopt;
  double low = 0, high = most_turn_rad * most_turn_rad;
  if (square(high) > degrees) return std::nullopt;
  constexpr int halvings = 40;
  for (int i = 0; i < halvings; ++i) {
    const double middle = (low + high) / 2;
    (square(middle) > degrees ? low : high) = middle;
  }
  return high;
}

/// The correction of a drift that is as likely as the pose asks for and no larger. In directions in which few landmarks at the rim
/// of an image hardly determine the pose, turn against translation, it leaves the estimate where it is.
std::optional<DriftCorrection> correction_to(const PoseEvidence& pose, const TrackedCamera& camera) {
  const CameraState& now = camera.view.camera;
  const Eigen::Vector4d before = free_camera::orientation(now), after = free_camera::orientation(pose.camera);
  PoseErrors offset;
  offset << free_camera::position(pose.camera) - free_camera::position(now),
      quaternion_log(quaternion_product<double>(after, quaternion_conjugate(before)));
  PoseCov in_world = PoseCov::Identity();  // the rotation errors of the pose are in the axes of the camera
  in_world.bottomRightCorner<3, 3>() = rotation_matrix<double>(after);
  const PoseCov pose_cov = in_world * pose.cov * in_world.transpose();
  // In the image a translation by this share of the depth is as large as a turn by as many rad
  PoseCov shape = PoseCov::Identity();
  shape.topLeftCorner<3, 3>() *= camera.median_depth_m * camera.median_depth_m;
  const std::optional<double> var = drift_var(offset, pose_cov, shape);
  if (!var || *var < least_drift_rad * least_drift_rad) return std::nullopt;
  const PoseErrors likely = *var * shape * PoseCov(*var * shape + pose_cov).llt().solve(offset);
  DriftCorrection out;
  out.center = free_camera::position(now);
  out.translation = likely.head<3>();
  out.turn = likely.tail<3>();
  out.cov.topLeftCorner<6, 6>() = *var * shape;
  out.cov(6, 6) = *var;
  return out;
}

bool is_plausible(const DriftCorrection& correction, const TrackedCamera& camera) {
  return correction.translation.norm() < most_drift_depths * camera.median_depth_m &&
         correction.turn.norm() < most_turn_rad;
}

/// Landmarks that began since then, each with the share of the time that had passed when it was seen last.
std::vector<DriftingLandmark> drifting(const Estimate& estimate, const TrackedCamera& camera,
                                       int frames_ago) {
  std::vector<DriftingLandmark> out;
  for (const auto& [id, feature] : camera.features)
    if (feature.frames_known <= frames_ago && estimate.landmarks.at(id).mapped())
      out.push_back({id, 1 - static_cast<double>(feature.frames_away) / frames_ago});
  return out;
}

/// Not searched for unless it is among the matches.
MatchOutcome outcome_of(std::int64_t id, const TrackedCamera& camera) {
  const auto match = std::ranges::find(camera.matches, id, &FeatureMatch::id);
  return match == camera.matches.end() ? MatchOutcome::not_searched : match->outcome;
}

}  // namespace

bool MissedLandmarks::may_be_right(std::int64_t id) const {
  return std::ranges::find(new_ids, id) != new_ids.end();
}

MissedLandmarks missed_landmarks(const TrackedCamera& camera) {
  MissedLandmarks out;
  if (!camera.settings.relocalization.close_loops) return out;
  std::vector<double> gone;
  for (const FeatureMatch& match : camera.matches) {
    if (!is_missed(match, camera)) continue;
    const Feature& feature = camera.features.at(match.id);
    out.ids.push_back(match.id);
    if (feature.frames_since_return() < kept_frames) out.new_ids.push_back(match.id);
    gone.push_back(feature.frames_away);
  }
  if (out.ids.empty()) return out;
  out.frames_gone = static_cast<int>(median(gone));
  const auto found = std::ranges::count_if(camera.matches, [&](const FeatureMatch& match) {
    return match.outcome == MatchOutcome::matched &&
           camera.features.at(match.id).frames_known > out.frames_gone;
  });
  if (static_cast<double>(found) > most_found * static_cast<double>(out.ids.size())) return {};
  return out;
}

std::optional<ClosedLoop> LoopClosure::find(const SummedImage& image, const Estimate& estimate,
                                            const TrackedCamera& camera, double t) {
  const int least = camera.settings.relocalization.min_matches;
  if (frames_until_search_ > 0) --frames_until_search_;
  MissedLandmarks missed = missed_landmarks(camera);
  if (frames_until_search_ > 0 || static_cast<int>(missed.ids.size()) < least || camera.matched < least) {
    restart();
    return std::nullopt;
  }
  const auto found = known_.find(image, estimate, with_landmarks_known(camera, missed.frames_gone), t);
  if (!known_.has_candidate()) frames_until_search_ = frames_between;
  if (!found) return std::nullopt;
  const std::optional<DriftCorrection> correction = correction_to(*found, camera);
  if (!correction || !is_plausible(*correction, camera)) return std::nullopt;
  return ClosedLoop{*correction, drifting(estimate, camera, missed.frames_gone), std::move(missed.ids),
                    missed.frames_gone};
}

void move_views(TrackedCamera& camera, const ClosedLoop& loop) {
  for (const auto& [id, share] : loop.landmarks) {
    const PartialCorrection by(loop.correction, share);
    Feature& feature = camera.features.at(id);
    PatchView& view = feature.view;
    view.camera_position = by.moved(view.camera_position);
    view.world_from_camera = by.turned(view.world_from_camera);
    turn(view.plane, by.rotation());
    view.plane.estimated_from = by.moved(view.plane.estimated_from);
    for (DescribedView& described : feature.described) {
      described.camera_position = by.moved(described.camera_position);
      described.world_from_camera = by.turned(described.world_from_camera);
    }
  }
  for (const std::int64_t id : loop.missed) {
    Feature& feature = camera.features.at(id);
    feature.attempts = 0;
    feature.recent_attempts = feature.recent_matches = 0;
  }
}

bool confirms(const ClosedLoop& loop, const TrackedCamera& corrected, const TrackedCamera& before) {
  const auto returned = std::ranges::count_if(
      loop.missed, [&](std::int64_t id) { return outcome_of(id, corrected) == MatchOutcome::matched; });
  if (returned < corrected.settings.relocalization.min_matches ||
      static_cast<double>(returned) < least_missed_share * static_cast<double>(loop.missed.size()))
    return false;
  int tracked = 0, searched = 0, lost = 0;
  for (const FeatureMatch& match : before.matches) {
    if (match.outcome != MatchOutcome::matched) continue;
    const MatchOutcome now = outcome_of(match.id, corrected);
    const bool is_lost = now == MatchOutcome::not_found || now == MatchOutcome::outlier;
    if (match.anchor && is_lost) return false;  // its position is known
    const bool drifted =
        std::ranges::find(loop.landmarks, match.id, &DriftingLandmark::id) != loop.landmarks.end();
    tracked += drifted;
    searched += drifted && (is_lost || now == MatchOutcome::matched);
    lost += drifted && is_lost;
  }
  return searched >= least_searched_share * tracked && lost <= most_lost_share * searched;
}

}  // namespace incognita
