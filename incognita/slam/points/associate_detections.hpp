// The front end of the point sensors: detections become gated measurements of landmarks, anchors and other bodies, and
// candidates for new landmarks.
#pragma once

#include <vector>

#include "incognita/messages/observation.hpp"
#include "incognita/slam/mapper/estimate.hpp"
#include "incognita/slam/mapper/settings.hpp"

namespace incognita {

/// The matches of a tick that passed the gate, and the candidates for new landmarks.
struct Inliers {
  std::vector<std::size_t> indices;                 ///< into FrameReport::matches
  std::vector<std::size_t> candidates;              ///< of landmarks to initialize, into FrameReport::matches
  std::vector<LinearizedMeasurement> measurements;  ///< linearized about the means before the update
  Eigen::MatrixXd S;                                ///< workspace: innovation covariance of one match

  void clear() {
    indices.clear();
    candidates.clear();
    measurements.clear();
  }
};

/// Associates and gates all detections of the tick, by identity or by position as the settings ask. Fills
/// `estimate.last.matches`.
void associate_detections(Estimate& estimate, const Observation& observation,
                          const EstimatorSettings& settings, Inliers& inliers);

/// The inliers linearized at the belief's current means; without parts where a measurement is not defined.
void append_relinearized(const Estimate& estimate, const Inliers& inliers, const EstimatorSettings& settings,
                         std::vector<LinearizedMeasurement>& measurements);

/// Adds the candidates to the map or, of a camera, those that are chosen: choose_candidates.hpp.
void initialize_candidates(Estimate& estimate, const Inliers& inliers, const EstimatorSettings& settings);

}  // namespace incognita
