#include "incognita/decision/camera_expectation.hpp"

#include <tuple>
#include <utility>

#include "incognita/slam/features/predict_looks.hpp"

namespace incognita {

CameraExpectation::CameraExpectation(Camera camera, const CameraSlamSettings& slam, bool as_mapped)
    : camera_(std::move(camera)),
      slam_(slam),
      R_(slam.filter.sigma_pixel_px * slam.filter.sigma_pixel_px * Eigen::Matrix2d::Identity()),
      as_mapped_(as_mapped) {}

void CameraExpectation::prepare(const Estimate& estimate, const std::vector<ExpectedLandmark>& unseen,
                                double unseen_var_m2) {
  estimate_ = &estimate;
  unseen_ = &unseen;
  unseen_var_m2_ = unseen_var_m2;
  P_camera_ = estimate.belief.covariance(estimate.camera);
  near_.clear();
  for (const Landmark& landmark : estimate.catalogue)
    if (landmark.kind != Landmark::Kind::line)
      near_.push_back({&landmark, nominal_position(landmark, estimate.belief)});
  certainty_.assign(near_.size(), {});
}

bool CameraExpectation::in_view(const CameraState& from, const Eigen::Vector3d& place) const {
  const Eigen::Vector3d c = PointLandmark::in_camera<double>(from, place);
  if (c.z() <= 0 || c.norm() > slam_.birth.max_depth_m) return false;
  const auto seen = camera_.project(c);
  return seen && camera_.contains(seen->pixel);
}

const CameraExpectation::Certainty& CameraExpectation::certainty_of(std::size_t near) const {
  Certainty& certainty = certainty_[near];
  if (certainty.known) return certainty;
  const BlockId block = near_[near].landmark->block;
  certainty.with_camera = estimate_->belief.covariance(estimate_->camera, block);
  certainty.own = estimate_->belief.covariance(block);
  certainty.known = true;
  return certainty;
}

/// Of H P H', the camera as sure of itself as it is now: an order among looks, not a covariance to reckon
/// with.
double CameraExpectation::innovation_trace(const Seen& seen) const {
  const auto& [Hv, Hl] = std::tie(seen.look.Hv, seen.look.Hl);
  const double trace = (Hv * P_camera_).cwiseProduct(Hv).sum();
  if (seen.look.kind == Landmark::Kind::anchor) return trace;
  const Certainty& certainty = certainty_of(seen.near);
  return trace + (Hl * certainty.own).cwiseProduct(Hl).sum() +
         2 * (Hv * certainty.with_camera).cwiseProduct(Hl).sum();
}

/// seen_ <- all of the map that would be in view.
void CameraExpectation::see(const CameraState& from) const {
  const Eigen::Vector3d at = free_camera::position(from),
                        ahead = rotation_matrix<double>(free_camera::orientation(from)).col(2);
  seen_.clear();
  for (std::size_t i = 0; i < near_.size(); ++i) {
    if (ahead.dot(near_[i].place - at) <= 0) continue;
    if (const auto look = expect_pixel(*near_[i].landmark, estimate_->belief, camera_, from, slam_))
      seen_.push_back({i, *look});
  }
}

void CameraExpectation::expect(const BlockVector& state, std::vector<ExpectedLook>& looks) const {
  const CameraState from = state.head<13>();
  see(from);
  const auto most = static_cast<std::size_t>(slam_.search.max_measurements);
  traces_.clear();
  if (seen_.size() > most)
    for (const Seen& seen : seen_) traces_.push_back(innovation_trace(seen));
  const double least = least_of_the_best(traces_, static_cast<int>(most), sorted_);
  looks.clear();
  for (std::size_t i = 0; i < seen_.size(); ++i) {
    if (!traces_.empty() && traces_[i] < least) continue;
    if (looks.size() == most) break;
    const Landmark& landmark = *near_[seen_[i].near].landmark;
    const bool known = landmark.kind == Landmark::Kind::anchor;
    looks.push_back({known ? ExpectedLook::Of::anchor : ExpectedLook::Of::mapped, landmark.block, 0, 0,
                     seen_[i].look.Hv, seen_[i].look.Hl, R_});
  }
  auto counted = static_cast<std::ptrdiff_t>(unseen_->size());
  if (as_mapped_) counted = slam_.map.wanted_visible - static_cast<std::ptrdiff_t>(seen_.size());
  for (const ExpectedLandmark& unseen : *unseen_) {
    if (counted <= 0) break;
    if (!in_view(from, unseen.position)) continue;
    const auto seen = PointLandmark::look(camera_, from, unseen.position);
    if (!seen) continue;
    looks.push_back({ExpectedLook::Of::unseen, 0, unseen.index, unseen_var_m2_, seen->Hv, seen->Hl, R_});
    --counted;
  }
}

}  // namespace incognita
