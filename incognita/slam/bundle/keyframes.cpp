#include "incognita/slam/bundle/keyframes.hpp"

#include <Eigen/Cholesky>

#include "incognita/slam/mapper/landmarks.hpp"

namespace incognita {
namespace {

BundleView view_of(const CameraState& camera) {
  return {camera.head<3>(), camera.segment<4>(3)};
}

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

/// Forgets landmarks that were deleted. Landmarks that are not determined by the keyframes are deleted.
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

void Keyframes::replace_belief(Estimate& estimate, BlockId body, const Bundle& bundle) {
  AnyBelief& belief = estimate.belief;
  Eigen::MatrixXd X;
  equations_.view_covariance_factor(X);
  const Eigen::Index last = X.rows() - 6;
  Eigen::MatrixXd Y = Eigen::MatrixXd::Zero(belief.errors(), X.cols());
  std::vector<BlockMatrix> own(static_cast<std::size_t>(belief.block_count()));
  // The camera: its velocities given its pose stay as in the belief
  CameraState camera = belief.mean(body);
  const Eigen::Matrix<double, 12, 12> P = belief.covariance(body);
  const Eigen::Matrix<double, 6, 6> P_pose = P.topLeftCorner<6, 6>();
  const Eigen::Matrix<double, 6, 6> gain =
      P_pose.ldlt().solve(P.topRightCorner<6, 6>()).transpose();
  CameraState moved = camera;
  moved.head<3>() = bundle.views.back().position;
  moved.segment<4>(3) = bundle.views.back().world_from_camera;
  Eigen::Matrix<double, 12, 1> shift;
  FreeCameraMotion::chart.minus({moved.data(), 13}, {camera.data(), 13}, {shift.data(), 12});
  moved.tail<6>() += gain * shift.head<6>();
  belief.set_mean(body, moved);
  const int at = belief.offset(body);
  Y.middleRows(at, 6) = X.middleRows(last, 6);
  Y.middleRows(at + 6, 6) = gain * X.middleRows(last, 6);
  BlockMatrix of_camera = BlockMatrix::Zero(12, 12);
  of_camera.bottomRightCorner<6, 6>() = P.bottomRightCorner<6, 6>() - gain * P.topRightCorner<6, 6>();
  own.front() = of_camera;

  std::map<int, std::size_t> order;  // of the blocks by their first error
  for (const auto& [id, landmark] : estimate.landmarks)
    if (!landmark.fixed) order.emplace(belief.offset(landmark.block), 0);
  std::size_t next = 1;
  for (auto& [offset, index] : order) index = next++;
  for (std::size_t i = 0; i < ids_.size(); ++i) {
    const Landmark& landmark = estimate.landmarks.at(ids_[i]);
    const BundlePoint& point = bundle.points[i];
    if (landmark.fixed) continue;
    const int offset = belief.offset(landmark.block);
    const BundleEquations::Regression regression = equations_.regression(static_cast<int>(i));
    const int own_rows = is_inverse_depth(landmark) ? 3 : 0;
    BlockMatrix noise = BlockMatrix::Zero(own_rows + 3, own_rows + 3);
    noise.bottomRightCorner(3, 3) = regression.noise;
    if (own_rows == 3) {
      // The initial position duplicates that of the host: regularization keeps the covariance positive definite
      noise.topLeftCorner(3, 3) = 1e-8 * Eigen::Matrix3d::Identity();
      Y.middleRows(offset, 3) = X.middleRows(6 * point.host, 3);
      Eigen::Matrix<double, 6, 1> mean;
      mean << bundle.views[static_cast<std::size_t>(point.host)].position, point.value;
      belief.set_mean(landmark.block, mean);
    } else {
      belief.set_mean(landmark.block, point.value);
    }
    for (const auto& [view, J] : regression.parts)
      Y.middleRows(offset + own_rows, 3).noalias() += J * X.middleRows(6 * view, 6);
    own[order.at(offset)] = noise;
  }
  belief.set_covariance(own, Y);
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
