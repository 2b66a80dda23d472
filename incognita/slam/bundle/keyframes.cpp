#include "incognita/slam/bundle/keyframes.hpp"

#include <Eigen/Cholesky>
#include <algorithm>

namespace incognita {
namespace {

/// Matches of a landmark in fixed keyframes that an adjustment uses: its first, and the last of them.
constexpr int max_fixed_matches = 20;

/// Of a keyframe: fewer may not determine its pose, and the filter knows its motion.
constexpr int least_matches = 8;

constexpr double least_inverse_depth = 1e-6;

BundleView view_of(const CameraState& camera) { return {camera.head<3>(), camera.segment<4>(3)}; }

/// The vector from `from` to a point in inverse depth, times its inverse depth, world axes: finite at infinity.
Eigen::Vector3d scaled_vector(const BundlePoint& point, const Eigen::Vector3d& host,
                              const Eigen::Vector3d& from) {
  const Eigen::Vector3d ray =
      rotation_matrix<double>(point.initial_axes) * Eigen::Vector3d(point.value[0], point.value[1], 1);
  return ray + point.value[2] * (host - from);
}

void move_camera(AnyBelief& belief, BlockId body, const BundleView& to) {
  const Eigen::Matrix<double, 12, 12> P = belief.covariance(body);
  const Eigen::Matrix<double, 6, 6> gain =
      P.topLeftCorner<6, 6>().ldlt().solve(P.topRightCorner<6, 6>()).transpose();
  const CameraState before = belief.mean(body);
  CameraState after = before;
  after.head<3>() = to.position;
  after.segment<4>(3) = to.world_from_camera;
  Eigen::Matrix<double, 12, 1> shift;
  FreeCameraMotion::chart.minus({after.data(), 13}, {before.data(), 13}, {shift.data(), 12});
  after.tail<6>() += gain * shift.head<6>();
  belief.set_mean(body, after);
}

/// Moves a landmark to the point, if its parametrization can hold that. The initial position stays.
void move_landmark(AnyBelief& belief, const Landmark& landmark, const BundlePoint& point,
                   const Eigen::Vector3d& host) {
  if (landmark.form.kind == LandmarkParametrization::Kind::point) {
    if (point.value[2] <= least_inverse_depth) return;
    belief.set_mean(landmark.block, host + scaled_vector(point, host, host) / point.value[2]);
    return;
  }
  InverseDepthLandmark::State y = belief.mean(landmark.block);
  const Eigen::Vector3d along = rotation_matrix<double>(landmark.form.initial_axes).transpose() *
                                scaled_vector(point, host, y.head<3>());
  if (!(along.z() > 0.1 * along.norm())) return;
  y.tail<3>() << along.x() / along.z(), along.y() / along.z(), point.value[2] / along.z();
  belief.set_mean(landmark.block, y);
}

}  // namespace

void Keyframes::start(const CameraState& camera) {
  views_ = {view_of(camera)};
  tracks_.clear();
  frames_ = 0;
}

bool Keyframes::is_due(const std::vector<KeyframeMatch>& matches, const KeyframePolicy& policy) {
  if (++frames_ < policy.min_frames || static_cast<int>(matches.size()) < least_matches) return false;
  const int last = static_cast<int>(views_.size()) - 1;
  int in_last = 0;
  for (const auto& [id, track] : tracks_) in_last += track.seen.back().view == last;
  double squares = 0;
  int moved = 0;
  for (const KeyframeMatch& match : matches) {
    const auto known = tracks_.find(match.id);
    if (known == tracks_.end() || known->second.seen.back().view != last) continue;
    squares += (match.pixel - known->second.seen.back().pixel).squaredNorm();
    ++moved;
  }
  return static_cast<double>(matches.size()) < policy.min_matched_share * in_last ||
         squares > moved * policy.min_motion_px * policy.min_motion_px;
}

void Keyframes::add(const CameraState& camera, const std::vector<KeyframeMatch>& matches) {
  views_.push_back(view_of(camera));
  for (const KeyframeMatch& match : matches) add_match(match);
  frames_ = 0;
}

void Keyframes::add_match(const KeyframeMatch& match) {
  tracks_[match.id].seen.push_back({static_cast<int>(views_.size()) - 1, match.pixel, match.cov});
}

/// The landmark as seen from its first keyframe; nothing behind it.
std::optional<BundlePoint> Keyframes::point_of(const Track& track, const Landmark& landmark,
                                               const Estimate& estimate, const DepthPrior& prior) const {
  BundlePoint point;
  if (landmark.fixed) {
    point.kind = BundlePoint::Kind::fixed;
    point.value = landmark.position;
    return point;
  }
  if (landmark.form.kind == LandmarkParametrization::Kind::ray) return std::nullopt;
  point.kind = BundlePoint::Kind::inverse_depth;
  point.host = track.seen.front().view;
  const BundleView& host = views_[static_cast<std::size_t>(point.host)];
  point.initial_axes = host.world_from_camera;
  point.prior_inverse_depth = prior.mean;
  point.sigma_prior_inverse_depth = prior.sigma;
  const auto y = estimate.belief.mean(landmark.block);
  Eigen::Vector3d scaled;
  double scale = 1;
  if (landmark.form.kind == LandmarkParametrization::Kind::point) {
    scaled = Eigen::Vector3d(y) - host.position;
  } else {
    scale = y[5];
    scaled = y[5] * (Eigen::Vector3d(y.head<3>()) - host.position) +
             rotation_matrix<double>(landmark.form.initial_axes) * Eigen::Vector3d(y[3], y[4], 1);
  }
  const Eigen::Vector3d along = rotation_matrix<double>(host.world_from_camera).transpose() * scaled;
  if (!(along.z() > 0.1 * along.norm())) return std::nullopt;
  point.value << along.x() / along.z(), along.y() / along.z(), scale / along.z();
  return point;
}

/// The keyframes, those before `first_free` fixed, and the landmarks seen in the others. Forgets landmarks that were
/// deleted and are no longer seen in them.
Bundle Keyframes::bundle_of(const Estimate& estimate, const DepthPrior& prior, int first_free) {
  Bundle bundle;
  bundle.views = views_;
  for (int i = 0; i < first_free; ++i) bundle.views[static_cast<std::size_t>(i)].fixed = true;
  ids_.clear();
  for (auto next = tracks_.begin(); next != tracks_.end();) {
    const auto at = next++;
    Track& track = at->second;
    const auto landmark = estimate.landmarks.find(at->first);
    const bool known = landmark != estimate.landmarks.end();
    if (track.seen.back().view < first_free || (!known && !track.point)) {
      if (!known) tracks_.erase(at);
      continue;
    }
    if (track.seen.size() < 2) continue;
    if (!track.point) track.point = point_of(track, landmark->second, estimate, prior);
    if (!track.point) continue;
    int fixed = 0;
    for (const Seen& seen : track.seen) fixed += seen.view < first_free;
    int skipped = std::max(0, fixed - max_fixed_matches);
    for (std::size_t i = 0; i < track.seen.size(); ++i) {
      const Seen& seen = track.seen[i];
      if (i > 0 && skipped-- > 0) continue;
      bundle.observations.push_back(
          {seen.view, static_cast<int>(bundle.points.size()), seen.pixel, seen.cov});
    }
    bundle.points.push_back(*track.point);
    ids_.push_back(at->first);
  }
  return bundle;
}

void Keyframes::move_means(Estimate& estimate, BlockId body) const {
  move_camera(estimate.belief, body, views_.back());
  for (const std::int64_t id : ids_) {
    const auto landmark = estimate.landmarks.find(id);
    if (landmark == estimate.landmarks.end() || landmark->second.fixed) continue;
    const BundlePoint& point = *tracks_.at(id).point;
    move_landmark(estimate.belief, landmark->second, point,
                  views_[static_cast<std::size_t>(point.host)].position);
  }
}

AdjustmentReport Keyframes::adjust(Estimate& estimate, BlockId body, const Camera& camera,
                                   const AdjustmentSettings& settings, const DepthPrior& prior, int window) {
  const int first_free = std::max(1, static_cast<int>(views_.size()) - window);
  Bundle bundle = bundle_of(estimate, prior, first_free);
  const AdjustmentReport report = incognita::adjust(bundle, camera, settings, equations_);
  if (report.outcome == AdjustmentReport::Outcome::refused) return report;
  for (std::size_t i = static_cast<std::size_t>(first_free); i < views_.size(); ++i)
    views_[i] = bundle.views[i];
  for (std::size_t i = 0; i < ids_.size(); ++i) tracks_.at(ids_[i]).point = bundle.points[i];
  move_means(estimate, body);
  return report;
}

}  // namespace incognita
