#include "incognita/decision/camera_expectation.hpp"

#include <utility>

#include "incognita/slam/predict_looks.hpp"

namespace incognita {

CameraExpectation::CameraExpectation(Camera camera, const CameraSlamSettings& slam)
    : camera_(std::move(camera)),
      slam_(slam),
      R_(slam.filter.sigma_pixel_px * slam.filter.sigma_pixel_px * Eigen::Matrix2d::Identity()) {}

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
}

bool CameraExpectation::in_view(const CameraState& from, const Eigen::Vector3d& place) const {
  const Eigen::Vector3d c = PointLandmark::in_camera<double>(from, place);
  if (c.z() <= 0 || c.norm() > slam_.birth.max_depth_m) return false;
  const auto seen = camera_.project(c);
  return seen && camera_.contains(seen->pixel);
}

/// Of H P H', the camera as sure of itself as it is now: an order among looks, not a covariance to reckon
/// with.
double CameraExpectation::innovation_trace(const ExpectedLook& look) const {
  double trace = (look.Hv * P_camera_).cwiseProduct(look.Hv).sum();
  if (look.of != ExpectedLook::Of::mapped) return trace;
  const Belief& belief = estimate_->belief;
  trace += (look.Hl * belief.covariance(look.block)).cwiseProduct(look.Hl).sum();
  return trace + 2 * (look.Hv * belief.covariance(estimate_->camera, look.block)).cwiseProduct(look.Hl).sum();
}

void CameraExpectation::expect(const BlockVector& state, std::vector<ExpectedLook>& looks) const {
  const CameraState from = state.head<13>();
  const Eigen::Vector3d at = free_camera::position(from),
                        ahead = rotation_matrix<double>(free_camera::orientation(from)).col(2);
  looks.clear();
  traces_.clear();
  const auto most = static_cast<std::size_t>(slam_.search.max_measurements);
  for (const Near& near : near_) {
    if (ahead.dot(near.place - at) <= 0) continue;
    const auto seen = expect_pixel(*near.landmark, estimate_->belief, camera_, from, slam_);
    if (!seen) continue;
    ExpectedLook& look = looks.emplace_back();
    look.of =
        near.landmark->kind == Landmark::Kind::anchor ? ExpectedLook::Of::anchor : ExpectedLook::Of::mapped;
    look.block = near.landmark->block;
    look.Hv = seen->Hv;
    look.Hl = seen->Hl;
    look.R = R_;
  }
  const std::size_t mapped = looks.size();
  if (mapped > most)
    for (const ExpectedLook& look : looks) traces_.push_back(innovation_trace(look));
  for (const ExpectedLandmark& unseen : *unseen_) {
    if (!in_view(from, unseen.position)) continue;
    const auto seen = PointLandmark::look(camera_, from, unseen.position);
    if (!seen) continue;
    looks.push_back({ExpectedLook::Of::unseen, 0, unseen.index, unseen_var_m2_, seen->Hv, seen->Hl, R_});
  }
  keep_most_uncertain(looks, traces_, mapped, static_cast<int>(most));
}

}  // namespace incognita
