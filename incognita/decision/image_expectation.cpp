#include "incognita/decision/image_expectation.hpp"

#include <tuple>
#include <utility>

#include "incognita/slam/features/predict_matches.hpp"

namespace incognita {

ImageExpectation::ImageExpectation(Camera camera, const CameraSlamSettings& slam, bool as_mapped)
    : camera_(std::move(camera)),
      slam_(slam),
      R_(slam.filter.sigma_pixel_px * slam.filter.sigma_pixel_px * Eigen::Matrix2d::Identity()),
      as_mapped_(as_mapped) {}

void ImageExpectation::prepare(const Estimate& estimate, std::size_t,
                               const std::vector<ExpectedLandmark>& unseen, double unseen_var_m2) {
  estimate_ = &estimate;
  unseen_ = &unseen;
  unseen_var_m2_ = unseen_var_m2;
  P_camera_ = estimate.belief.covariance(estimate.body().block);
  near_.clear();
  for (const auto& [id, landmark] : estimate.landmarks)
    if (landmark.camera >= 0 && (landmark.fixed || landmark.mapped()))
      near_.push_back({&landmark, nominal_position(landmark, estimate.belief)});
  certainty_.assign(near_.size(), {});
}

bool ImageExpectation::in_view(std::size_t, const BlockVector& state, const Eigen::Vector3d& position) const {
  const CameraState from = state.head<13>();
  const Eigen::Vector3d c = PointLandmark::in_camera<double>(from, position);
  if (c.z() <= 0 || c.norm() > slam_.initialization.max_depth_m) return false;
  const auto projected = camera_.project(c);
  return projected && camera_.contains(projected->pixel);
}

const ImageExpectation::Certainty& ImageExpectation::certainty_of(std::size_t near) const {
  Certainty& certainty = certainty_[near];
  if (certainty.known) return certainty;
  const BlockId block = near_[near].landmark->block;
  certainty.with_camera = estimate_->belief.covariance(estimate_->body().block, block);
  certainty.own = estimate_->belief.covariance(block);
  certainty.known = true;
  return certainty;
}

/// Trace of H P H': a ranking heuristic (current camera covariance), not the predicted innovation covariance.
double ImageExpectation::innovation_trace(const VisibleLandmark& visible) const {
  const auto& [Hv, Hl] = std::tie(visible.measurement.Hv, visible.measurement.Hl);
  const double trace = (Hv * P_camera_).cwiseProduct(Hv).sum();
  if (visible.measurement.anchor) return trace;
  const Certainty& certainty = certainty_of(visible.near);
  return trace + (Hl * certainty.own).cwiseProduct(Hl).sum() +
         2 * (Hv * certainty.with_camera).cwiseProduct(Hl).sum();
}

/// Fills visible_ with the mapped landmarks in view.
void ImageExpectation::find_visible(const CameraState& from) const {
  const Eigen::Vector3d at = free_camera::position(from),
                        ahead = rotation_matrix<double>(free_camera::orientation(from)).col(2);
  visible_.clear();
  for (std::size_t i = 0; i < near_.size(); ++i) {
    if (ahead.dot(near_[i].position - at) <= 0) continue;
    if (const auto measurement = predict_pixel(*near_[i].landmark, estimate_->belief, camera_, from, slam_))
      visible_.push_back({i, *measurement});
  }
}

void ImageExpectation::expect(const BlockVector& state,
                              std::vector<PredictedMeasurement>& measurements) const {
  const CameraState from = state.head<13>();
  find_visible(from);
  const auto most = static_cast<std::size_t>(slam_.search.max_measurements);
  traces_.clear();
  if (visible_.size() > most)
    for (const VisibleLandmark& visible : visible_) traces_.push_back(innovation_trace(visible));
  const double least = least_of_the_best(traces_, static_cast<int>(most), sorted_);
  measurements.clear();
  for (std::size_t i = 0; i < visible_.size(); ++i) {
    if (!traces_.empty() && traces_[i] < least) continue;
    if (measurements.size() == most) break;
    const Landmark& landmark = *near_[visible_[i].near].landmark;
    measurements.push_back(
        {landmark.fixed ? PredictedMeasurement::Of::anchor : PredictedMeasurement::Of::mapped, landmark.block,
         0, 0, visible_[i].measurement.Hv, visible_[i].measurement.Hl, R_});
  }
  auto counted = static_cast<std::ptrdiff_t>(unseen_->size());
  if (as_mapped_) counted = slam_.map.wanted_visible - static_cast<std::ptrdiff_t>(visible_.size());
  for (const ExpectedLandmark& unseen : *unseen_) {
    if (counted <= 0) break;
    if (!in_view(0, state, unseen.position)) continue;
    const auto prediction = PointLandmark::predict_measurement(camera_, from, unseen.position);
    if (!prediction) continue;
    measurements.push_back({PredictedMeasurement::Of::unseen, 0, unseen.index, unseen_var_m2_, prediction->Hv,
                            prediction->Hl, R_});
    --counted;
  }
}

}  // namespace incognita
