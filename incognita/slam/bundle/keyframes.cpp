#include "incognita/slam/bundle/keyframes.hpp"

#include <Eigen/Cholesky>

#include "incognita/slam/mapper/landmarks.hpp"

namespace incognita {
namespace {

BundleView view_of(const CameraState& camera) { return {camera.head<3>(), camera.segment<4>(3)}; }

bool is_inverse_depth(const Landmark& landmark) {
  return !landmark.fixed && landmark.form.kind == LandmarkParametrization::Kind::inverse_depth;
}

}  // namespace

void Keyframes::start(const CameraState& camera, const Eigen::Matrix<double, 6, 6>& cov) {
  views_ = {view_of(camera)};
  first_view_ = views_.front();
  first_view_cov_ = cov;
  seen_.clear();
  frames_ = 0;
}

bool Keyframes::is_due(const std::vector<KeyframeMatch>& matches, const KeyframePolicy& policy) {
  if (++frames_ < policy.min_frames) return false;
  const int last = static_cast<int>(views_.size()) - 1;
  int in_last = 0;
  for (const auto& [id, seen] : seen_) in_last += seen.back().view == last;
  double squares = 0;
  int moved = 0;
  for (const KeyframeMatch& match : matches) {
    const auto known = seen_.find(match.id);
    if (known == seen_.end() || known->second.back().view != last) continue;
    squares += (match.pixel - known->second.back().pixel).squaredNorm();
    ++moved;
  }
  return static_cast<double>(matches.size()) < policy.min_matched_share * in_last ||
         squares > moved * policy.min_motion_px * policy.min_motion_px;
}

void Keyframes::add(const CameraState& camera, const std::vector<KeyframeMatch>& matches) {
  const int view = static_cast<int>(views_.size());
  views_.push_back(view_of(camera));
  for (const KeyframeMatch& match : matches)
    if (const auto known = seen_.find(match.id); known != seen_.end())
      known->second.push_back({view, match.pixel, match.cov});
  frames_ = 0;
}

void Keyframes::add_if_new(const KeyframeMatch& match) {
  const int last = static_cast<int>(views_.size()) - 1;
  seen_.try_emplace(match.id, std::vector<Seen>{{last, match.pixel, match.cov}});
}

const BundleView* Keyframes::host_of(std::int64_t id) const {
  const auto known = seen_.find(id);
  return known == seen_.end() ? nullptr : &views_[static_cast<std::size_t>(known->second.front().view)];
}

/// The keyframes, and the landmarks at the means of the belief. Forgets landmarks that were deleted.
Bundle Keyframes::bundle_of(Estimate& estimate, const DepthPrior& prior) {
  Bundle bundle;
  bundle.views = views_;
  bundle.first_view = first_view_;
  bundle.first_view_cov = first_view_cov_;
  ids_.clear();
  for (auto next = seen_.begin(); next != seen_.end();) {
    const auto at = next++;
    const auto landmark = estimate.landmarks.find(at->first);
    if (landmark == estimate.landmarks.end()) {
      seen_.erase(at);
      continue;
    }
    const Landmark& known = landmark->second;
    BundlePoint point;
    if (known.fixed) {
      point.kind = BundlePoint::Kind::fixed;
      point.value = known.position;
    } else if (is_inverse_depth(known)) {
      point.kind = BundlePoint::Kind::inverse_depth;
      point.value = estimate.belief.mean(known.block).tail<3>();
      point.initial_axes = known.form.initial_axes;
      point.host = at->second.front().view;
      point.prior_inverse_depth = prior.mean;
      point.sigma_prior_inverse_depth = prior.sigma;
    } else {
      point.value = estimate.belief.mean(known.block);
    }
    for (const Seen& seen : at->second)
      bundle.observations.push_back(
          {seen.view, static_cast<int>(bundle.points.size()), seen.pixel, seen.cov});
    bundle.points.push_back(point);
    ids_.push_back(at->first);
  }
  return bundle;
}

/// Moves the camera to the last keyframe. Its velocities given its pose stay as in the belief: they follow the pose by the
/// regression `gain`.
void Keyframes::replace_camera(AnyBelief& belief, BlockId body, const BundleView& last,
                               Errors& errors) const {
  const Eigen::Matrix<double, 12, 12> P = belief.covariance(body);
  const Eigen::Matrix<double, 6, 6> gain =
      P.topLeftCorner<6, 6>().ldlt().solve(P.topRightCorner<6, 6>()).transpose();
  const CameraState before = belief.mean(body);
  CameraState after = before;
  after.head<3>() = last.position;
  after.segment<4>(3) = last.world_from_camera;
  Eigen::Matrix<double, 12, 1> shift;
  FreeCameraMotion::chart.minus({after.data(), 13}, {before.data(), 13}, {shift.data(), 12});
  after.tail<6>() += gain * shift.head<6>();
  belief.set_mean(body, after);
  const int first = belief.offset(body);
  const auto X_last = errors.X.bottomRows<6>();
  errors.Y.middleRows<6>(first) = X_last;
  errors.Y.middleRows<6>(first + 6) = gain * X_last;
  BlockMatrix own = BlockMatrix::Zero(12, 12);
  own.bottomRightCorner<6, 6>() = P.bottomRightCorner<6, 6>() - gain * P.topRightCorner<6, 6>();
  errors.own[first] = own;
}

/// Point `index` of the bundle. In inverse depth the position of its host precedes its own three errors.
void Keyframes::replace_landmark(AnyBelief& belief, const Landmark& landmark, const Bundle& bundle,
                                 std::size_t index, Errors& errors) const {
  const BundlePoint& point = bundle.points[index];
  const BundleEquations::Regression regression = equations_.regression(static_cast<int>(index));
  const int first = belief.offset(landmark.block), of_host = is_inverse_depth(landmark) ? 3 : 0;
  BlockVector mean(of_host + 3);
  BlockMatrix own = BlockMatrix::Zero(of_host + 3, of_host + 3);
  if (of_host > 0) {
    mean.head<3>() = bundle.views[static_cast<std::size_t>(point.host)].position;
    errors.Y.middleRows<3>(first) = errors.X.middleRows<3>(6 * point.host);
    // The initial position duplicates that of the host: regularization keeps the covariance positive definite
    own.topLeftCorner<3, 3>() = 1e-8 * Eigen::Matrix3d::Identity();
  }
  mean.tail<3>() = point.value;
  own.bottomRightCorner<3, 3>() = regression.noise;
  for (const auto& [view, J] : regression.parts)
    errors.Y.middleRows<3>(first + of_host).noalias() += J * errors.X.middleRows<6>(6 * view);
  belief.set_mean(landmark.block, mean);
  errors.own[first] = own;
}

void Keyframes::replace_belief(Estimate& estimate, BlockId body, const Bundle& bundle) const {
  Errors errors;
  equations_.view_covariance_factor(errors.X);
  errors.Y.setZero(estimate.belief.errors(), errors.X.cols());
  replace_camera(estimate.belief, body, bundle.views.back(), errors);
  for (std::size_t i = 0; i < ids_.size(); ++i) {
    const Landmark& landmark = estimate.landmarks.at(ids_[i]);
    if (!landmark.fixed) replace_landmark(estimate.belief, landmark, bundle, i, errors);
  }
  std::vector<BlockMatrix> own;
  for (const auto& [first, block] : errors.own) own.push_back(block);
  estimate.belief.set_covariance(own, errors.Y);
}

AdjustmentReport Keyframes::adjust(Estimate& estimate, BlockId body, const Camera& camera,
                                   const AdjustmentSettings& settings, const DepthPrior& prior) {
  Bundle bundle = bundle_of(estimate, prior);
  const AdjustmentReport report = incognita::adjust(bundle, camera, settings, equations_);
  if (report.outcome == AdjustmentReport::Outcome::refused) return report;
  views_ = bundle.views;
  replace_belief(estimate, body, bundle);
  return report;
}

}  // namespace incognita
