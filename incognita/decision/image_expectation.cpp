#include "incognita/decision/image_expectation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "incognita/decision/plan/expected_surface.hpp"
#include "incognita/slam/features/automatic_settings.hpp"
#include "incognita/slam/features/landmark_initialization.hpp"
#include "incognita/slam/features/predict_matches.hpp"

namespace incognita {

ImageExpectation::ImageExpectation(Camera camera, const CameraSlamSettings& slam, bool as_mapped,
                                   CameraOfBody carried)
    : camera_(std::move(camera)),
      slam_(with_automatic(slam, camera_)),
      R_((std::pow(slam.filter.sigma_pixel_px, 2) + std::pow(slam.filter.sigma_lasting_px, 2)) *
         Eigen::Matrix2d::Identity()),
      as_mapped_(as_mapped),
      carried_(std::move(carried)) {}

void ImageExpectation::prepare(const Estimate& estimate, const std::vector<ExpectedLandmark>& unseen,
                               double unseen_var_m2) {
  estimate_ = &estimate;
  unseen_ = &unseen;
  unseen_var_m2_ = unseen_var_m2;
  body_ = estimate.bodies.at(carried_.body).block;
  P_body_ = estimate.belief.covariance(body_);
  near_.clear();
  for (const auto& [id, landmark] : estimate.landmarks)
    if (landmark.camera == carried_.index && (landmark.fixed || landmark.mapped()))
      near_.push_back({&landmark, nominal_position(landmark, estimate.belief)});
  certainty_.assign(near_.size(), {});
}

Viewpoint ImageExpectation::from(const BlockVector& state) const {
  return viewpoint_of(state.head(chart_of(carried_.motion).ambient()), carried_.motion, carried_.mount,
                      body_);
}

bool ImageExpectation::in_view(const BlockVector& state, const Eigen::Vector3d& position) const {
  const Eigen::Vector3d c = PointLandmark::in_camera<double>(from(state).camera, position);
  if (c.z() <= 0 || c.norm() > slam_.initialization.max_depth_m) return false;
  const auto projected = camera_.project(c);
  return projected && camera_.contains(projected->pixel);
}

const ImageExpectation::Certainty& ImageExpectation::certainty_of(std::size_t near) const {
  Certainty& certainty = certainty_[near];
  if (certainty.known) return certainty;
  const BlockId block = near_[near].landmark->block;
  certainty.with_body = estimate_->belief.covariance(body_, block);
  certainty.own = estimate_->belief.covariance(block);
  certainty.known = true;
  return certainty;
}

/// Trace of H P H': a ranking heuristic (current covariance of the body), not the predicted innovation covariance.
double ImageExpectation::innovation_trace(const VisibleLandmark& visible) const {
  const auto& [near, Hv, Hl] = visible;
  const double trace = (Hv * P_body_).cwiseProduct(Hv).sum();
  if (near_[near].landmark->fixed)
    return slam_.search.anchors_first ? std::numeric_limits<double>::infinity() : trace;
  const Certainty& certainty = certainty_of(near);
  return trace + (Hl * certainty.own).cwiseProduct(Hl).sum() +
         2 * (Hv * certainty.with_body).cwiseProduct(Hl).sum();
}

/// Fills visible_ and in_camera_ with the mapped landmarks in view.
void ImageExpectation::find_visible(const Viewpoint& from) const {
  const Eigen::Vector3d at = free_camera::position(from.camera),
                        ahead = rotation_matrix<double>(free_camera::orientation(from.camera)).col(2);
  visible_.clear();
  in_camera_.clear();
  for (std::size_t i = 0; i < near_.size(); ++i) {
    if (ahead.dot(near_[i].position - at) <= 0) continue;
    const auto match = predict_pixel(*near_[i].landmark, estimate_->belief, camera_, from.camera, slam_);
    if (!match) continue;
    visible_.push_back({i, from.jacobian(match->Hv), match->Hl});
    in_camera_.push_back(PointLandmark::in_camera<double>(from.camera, near_[i].position));
  }
}

void ImageExpectation::add(const BlockVector& state, std::vector<PredictedMeasurement>& measurements) const {
  const Viewpoint view = from(state);
  find_visible(view);
  const auto most = static_cast<std::size_t>(most_searched(slam_));
  traces_.clear();
  if (visible_.size() > most)
    for (const VisibleLandmark& visible : visible_) traces_.push_back(innovation_trace(visible));
  const double least = least_of_the_best(traces_, static_cast<int>(most), sorted_);
  std::size_t added = 0;
  for (std::size_t i = 0; i < visible_.size() && added < most; ++i) {
    if (!traces_.empty() && traces_[i] < least) continue;
    const Landmark& landmark = *near_[visible_[i].near].landmark;
    measurements.push_back(
        {landmark.fixed ? PredictedMeasurement::Of::anchor : PredictedMeasurement::Of::mapped, landmark.block,
         0, 0, visible_[i].Hv, visible_[i].Hl, R_});
    ++added;
  }
  add_unseen(state, view, measurements);
}

void ImageExpectation::add_unseen(const BlockVector& state, const Viewpoint& view,
                                  std::vector<PredictedMeasurement>& measurements) const {
  auto counted = static_cast<std::ptrdiff_t>(unseen_->size());
  const bool fills_gaps = slam_.map.max_gap_m > 0;
  if (as_mapped_ && !fills_gaps)
    counted = slam_.map.wanted_visible - static_cast<std::ptrdiff_t>(visible_.size());
  for (const ExpectedLandmark& unseen : *unseen_) {
    if (counted <= 0) break;
    if (!sees_surface(free_camera::position(view.camera), unseen.position, unseen.normal)) continue;
    if (!in_view(state, unseen.position)) continue;
    const auto prediction = PointLandmark::predict_measurement(camera_, view.camera, unseen.position);
    if (!prediction) continue;
    if (as_mapped_ && fills_gaps &&
        is_covered(PointLandmark::in_camera<double>(view.camera, unseen.position), in_camera_,
                   slam_.map.max_gap_m))
      continue;
    measurements.push_back({PredictedMeasurement::Of::unseen, 0, unseen.index, unseen_var_m2_,
                            view.jacobian(prediction->Hv), prediction->Hl, R_});
    --counted;
  }
}

}  // namespace incognita
